/* One measurement: a scene's frames, stage by stage. Its JSON is in docs/measuring.md. */
#ifndef SLOSH_BENCH_H
#define SLOSH_BENCH_H

#include "app/base/progress.h"
#include "app/outcome/outcome.h"
#include "app/scene/scene.h"
#include "app/session/studio.h"
#include "sim/gl/timer.h"
#include "sim/world/world.h"

#include <stdio.h>

typedef struct StageFigure {
    bool ran;
    const char *clock; /* "cpu", "gl" or "finish" */
    double median_ms, p95_ms;
    double share; /* of the time of all stages */
} StageFigure;

/* Times are per frame: `substeps` substeps and one picture. */
typedef struct BenchResult {
    Outcome outcome; /* how the frames went; what failed and is OUTCOME_NONE is no matter of the fluid */
    Error failure;   /* why there are no figures but what the scene has; "": there are */
    char scene[1024];
    char backend[NAME_SIZE], method[NAME_SIZE], view[NAME_SIZE];
    char swept[256];    /* "key=value" of each sweep, joined by ", "; "" without sweeps */
    char renderer[256]; /* "" when no context was needed */
    const char *simd;   /* NULL: none is chosen */
    int threads, width, height, frames;
    int substeps;      /* of a frame, as they ran: trouble halves the step */
    size_t particles;  /* the mean of the frames */
    unsigned troubles; /* that the sentinel found, the warming up included */
    size_t unlisted;   /* bytes of lists of neighbours that a GPU has no memory for */
    size_t lost;       /* of them, without a place in the grid, at most in one frame */
    double neighbours_mean;
    double time;           /* simulated when the first frame began, s */
    double dt, dt_substep; /* s */
    StageFigure stages[STAGE_COUNT];
    double sim_ms, upload_ms, render_ms; /* medians of the sums over each part's stages */
    double frame_ms;                     /* median wall time from picture to picture */
    double particle_steps_per_second;    /* particles * substeps * frames / wall time of all sim stages */
    double real_time_factor;             /* simulated over wall time */
    double bytes_per_particle;           /* of the solver's state */
    SolveFigures solved;                 /* of the frames' steps */
    ViewCounts counts;                   /* of one more picture behind the frames */
} BenchResult;

typedef struct BenchSetup {
    const Scene *scene;
    const char *swept; /* as in BenchResult; NULL: "" */
    Headless *context; /* current; NULL: neither solver nor pictures need one */
    bool draws;
    int width, height, frames;
    double from;    /* simulated time at which to begin, s */
    double seconds; /* simulated time over which the frames are spread: what is between them is not measured;
                       0: they follow at once */
    const char *device, *mapping; /* as hand_replay_open takes them; no device: the hand is at rest */
    GlClock clock;
} BenchSetup;

/* Simulates up to `from`, runs a few frames to warm up, then measures; before and behind it looks for the
   outcome. `progress` goes from `done` to `done + part`. Ends early, with the frames that it has, when a
   signal came. False when the simulation or the drawing failed, or not even one frame was measured: the
   result then says why. */
bool bench_measure(const BenchSetup *setup, Progress *progress, double done, double part,
                   BenchResult *result);

/* What measured times are of: the processor's name as the system has it, "" where it has none; the compiler
   with its version, and the options that the program was built with. */
const char *bench_processor(void);
extern const char bench_compiler[], bench_options[];

/* The table for people. */
void bench_print(const BenchResult *result, FILE *file);

/* An array of all results, one that failed with its "error" in place of figures; false with the reason when
   the file can't be written. */
bool bench_write_json(const BenchResult *results, size_t count, const char *path, Error *error);

#endif
