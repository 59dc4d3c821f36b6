/* Benchmark: measures a scene's frames stage by stage. docs/measuring.md describes the JSON. */
#ifndef APP_BENCH_BENCH_H
#define APP_BENCH_BENCH_H

#include "app/base/program.h"
#include "app/run/measure/outcome.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "sim/gpu/timer.h"
#include "slosh/world.h"

#include <stdio.h>

typedef struct StageFigure {
    bool ran;
    const char *clock; /* "cpu", "gl" or "finish" */
    double median_ms, p95_ms;
    double share; /* fraction of the time of all stages */
} StageFigure;

/* Times are per frame: `substeps` substeps and one picture. */
typedef struct BenchResult {
    Outcome outcome; /* judgement of the frames; with a failure and OUTCOME_NONE the fluid is not to blame */
    Error failure;   /* why there are no figures, only the scene's names; "" on success */
    char scene[1024];
    char backend[NAME_SIZE], method[NAME_SIZE], view[NAME_SIZE];
    char swept[256];    /* "key=value" of each swept setting, joined by ", "; "" without sweeps */
    char renderer[256]; /* "" without a GL context */
    const char *simd;   /* NULL: no SIMD variant is chosen */
    int threads, width, height, frames;
    int substeps;      /* per frame, as they ran: the sentinel halves a step after trouble */
    size_t particles;  /* mean over the frames */
    unsigned troubles; /* count found by the sentinel, including the warm-up */
    size_t unlisted;   /* bytes of neighbour lists without room in GPU memory */
    size_t lost;       /* particles without a place in the grid: the greatest count of a frame */
    double neighbours_mean;
    double time;           /* simulated time at the start of the first frame, s */
    double dt, dt_substep; /* s */
    StageFigure stages[STAGE_COUNT];
    double sim_ms, upload_ms, render_ms; /* medians of the sums over each part's stages */
    double frame_ms;                     /* median wall time from picture to picture */
    double particle_steps_per_second;    /* particles * substeps * frames / wall time of all sim stages */
    double real_time_factor;             /* simulated over wall time */
    double bytes_per_particle;           /* of the solver's state */
    SolveFigures solved;                 /* of the measured steps */
    ViewCounts counts;                   /* of one more picture, drawn after the measured frames */
} BenchResult;

typedef struct BenchSetup {
    const Scene *scene;
    const char *swept; /* as in BenchResult; NULL: "" */
    Headless *context; /* current GL context; NULL if neither solver nor pictures need GL */
    bool draws;
    int width, height, frames;
    double from;    /* simulated time at the start of the measurement, s */
    double seconds; /* simulated time over which the frames are spread; steps between frames are not
                       measured; 0: frames follow at once */
    const char *device, *mapping; /* arguments of device_replay_open; without a device the hand is at rest */
    GlClock clock;
} BenchSetup;

/* Simulates up to `from`, runs WARM_UP_FRAMES frames, then measures. Looks for the outcome before and
   after. `progress` goes from `done` to `done + part`. A signal ends the measurement early, with the
   frames so far. Returns false if the simulation or the drawing failed, or no frame was measured;
   result->failure has the reason. */
bool bench_measure(const BenchSetup *setup, Progress *progress, double done, double part,
                   BenchResult *result);

/* Machine and build of the measurement: the system's name of the processor ("" if unknown), the compiler
   with its version, and the options of the build. */
const char *bench_processor(void);
extern const char bench_compiler[], bench_options[];

/* Prints the table for people. */
void bench_print(const BenchResult *result, FILE *file);

/* Writes an array of all results; a failed result has "error" in place of figures. Returns false with the
   reason if the file can't be written. */
bool bench_write_json(const BenchResult *results, size_t count, const char *path, Error *error);

#endif
