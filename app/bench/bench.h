/* Measurements by `slosh bench` and `slosh validate`: the stages of a scene's frames, the parts of a
   substep, sampled points, published tables, cases with a theory, and tables of probes. */
#ifndef APP_BENCH_BENCH_H
#define APP_BENCH_BENCH_H

#include "app/base/program.h"
#include "app/bench/cases/case.h"
#include "app/cli/args/args.h"
#include "app/run/measure/measure.h"
#include "app/run/offscreen.h"
#include "app/run/session.h"
#include "app/scene/scene.h"
#include "sim/gpu/gl.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <stdio.h>

/* Stages of a scene's frames. docs/manual/measuring.md describes the JSON. */

typedef struct StageFigure {
    bool ran;
    const char *clock; /* "cpu", "gl" or "finish" */
    double median_ms, p95_ms;
    double share; /* fraction of the time of all stages */
} StageFigure;

enum { BENCH_PROGRAMS = 96 };

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
    GlCalls sim_calls, picture_calls;    /* of the last frames of the warm-up, without a clock */
    uint64_t called_substeps, called_pictures; /* of the same frames; 0: no calls of the driver */
    GlProgramTime programs[BENCH_PROGRAMS];    /* a frame's means, after the measured frames */
    int program_count;                         /* 0: the clock is not the GPU's */
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

/* Draws a chart of the stages, FILE.svg or FILE.png: a bar per case without failure, at least one. */
bool bench_stages_draw(const BenchResult *results, size_t count, const char *path, Error *error);

/* Published tables, measured again: the runs of each table, and a print of measured beside published
   figures. */

enum { BENCH_TABLE_SWEEPS = 3, BENCH_TABLE_SETTINGS = 3, BENCH_TABLE_COLUMNS = 5 };

/* A column sums up stages. A column with stages = 0 takes all stages of no other column. */
typedef struct BenchTableColumn {
    const char *title; /* also the title of the reference's column */
    unsigned stages;   /* bits 1 << STAGE_... */
} BenchTableColumn;

typedef struct BenchTable {
    const char *name, *help;
    const char *scene;     /* path; NULL: see scenes */
    const char *scenes[5]; /* paths of several scenes, by the index of particles; or NULL */
    double seconds;        /* simulated time spanned by the frames; 0: frames follow at once */
    const char *settings[BENCH_TABLE_SETTINGS]; /* applied before the settings of the command line */
    const char *particles[8]; /* each count runs with each view and each backend; ended by NULL */
    const char *asked[8];     /* for several scenes: --particles of each scene with poured fluid, whose mean
                                 count is `particles`; NULL: use `particles` */
    const char *substeps[3];  /* combined with the above; ended by NULL */
    const char *reference;    /* CSV file of the published figures, or NULL */
    const char *view;         /* the only view, drawn for one backend; NULL: all views with all backends */
    bool backends;            /* with a view: run all backends */
    const char *sweep,
        *values[9]; /* with a view: a setting and its values, ended by NULL, one row per value; or NULL */
    bool percent;   /* the paper published shares, and frames per second as `rate` */
    bool shares;    /* true: the chart shows the first column's share; false: times */
    bool points;    /* points per second of the view pbsr; columns are unused */
    bool ratios;    /* a further column: the total over that of the first of `substeps`; published alone, as
                       `ratio` and `substeps` */
    BenchTableColumn columns[BENCH_TABLE_COLUMNS]; /* ended by a NULL title */
} BenchTable;

/* Finds a table by name. Returns NULL with the reason, which lists all names, if there is no such table. */
const BenchTable *bench_table_find(const char *name, Error *error);

/* Returns the name at `index`, or NULL past the end of the list. */
const char *bench_table_choice(int index);

/* Returns the count of scenes, and their paths in *scenes. */
size_t bench_table_scenes(const BenchTable *table, const char *const **scenes);

/* Returns the --particles of scene `scene` of several, used if the command line gives none. */
size_t bench_table_particles(const BenchTable *table, size_t scene);

/* Fills in the sweeps of the table's runs, views and backends as available in this program; returns their
   count. */
int bench_table_sweeps(const BenchTable *table, Sweep sweeps[BENCH_TABLE_SWEEPS + 1]);

/* Prints the table for people. Returns false if the reference cannot be read. */
bool bench_table_print(const BenchTable *table, const BenchResult *results, size_t count, FILE *file,
                       Error *error);

/* Draws the chart as FILE.svg or FILE.png. */
bool bench_table_draw(const BenchTable *table, const BenchResult *results, size_t count, const char *path,
                      Error *error);

/* Times each part of a substep alone, and compares with the limits of the machine. See sim/step/method.h
   for the counting. */

/* Lower bounds of a part's time: copying its bytes through memory, or from a cache; its operations as
   fused multiply-adds. */
typedef enum MicroLimit { MICRO_MEMORY, MICRO_CACHE, MICRO_FLOPS, MICRO_LIMIT_COUNT } MicroLimit;

typedef struct MicroFigure {
    const char *name;
    bool pairs;
    PairCost pair;
    double bytes_per_particle, bytes_per_pair; /* through memory; and from a cache, with a list entry */
    double ms;                                 /* least of all rounds */
    double particle_steps_per_second, pairs_per_second, bytes_per_second, flops_per_second;
    double flops_share; /* of the fused ceiling */
    MicroLimit limit;   /* the binding limit */
    double share;       /* of the limit: lower bound of the time over measured time */
} MicroFigure;

typedef struct MicroResult {
    char scene[1024], method[NAME_SIZE];
    char swept[256];
    char left_out[512]; /* why there are no figures; "" on success */
    int threads, rounds;
    size_t particles;
    double neighbours_mean;
    double time;     /* simulated time of the state, s */
    double asked;    /* s: `time` is less if the wall time limit came first */
    double least_ms; /* least wall time: making the world and the fewest rounds */
    int count;
    MicroFigure figures[MICRO_PARTS_MAX];
} MicroResult;

typedef struct MicroSetup {
    const Scene *scene;
    int rounds;     /* 0: as many as needed for a good figure */
    double seconds; /* limit of wall time */
    double from;    /* s: simulated time of a second state; 0: none */
} MicroSetup;

/* Measures the state at the start and the second state: *count results. Measures `ceilings` if not yet
   done. */
bool micro_measure(const MicroSetup *setup, Ceilings *ceilings, MicroResult results[2], int *count,
                   Error *error);

void micro_print_ceilings(const Ceilings *ceilings, int threads, FILE *file);
void micro_print(const MicroResult *result, FILE *file);

/* Writes an array of all results, each with the ceilings. A left out result has "left_out" in place of
   figures. */
bool micro_write_json(const MicroResult *results, size_t count, const Ceilings *ceilings, const char *path,
                      Error *error);

/* Points per second: sampling of surfaces, and rendering by the view pbsr. Compared with: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, section 5. */

enum { POINTS_RATES_MAX = 16 };

typedef struct PointsRate {
    const char *field, *sampler;
    double points, ms;
} PointsRate;

typedef struct PointsFigures {
    int threads, count;
    PointsRate rates[POINTS_RATES_MAX];
    BenchResult rendering; /* counts has the points of a picture */
} PointsFigures;

/* Times each sampler on each kind of field, on all processors: about `points` points of formulas and
   volumes, a tenth as many of particles. Returns false with the reason if memory is short or a signal
   came. */
bool points_sampling(double points, PointsFigures *figures, Error *error);

/* Returns the count of points in the measured picture. */
double points_shown(const BenchResult *result);

void points_print(const PointsFigures *figures, const Reference *published, FILE *file);

/* Writes "sampling" and "rendering". Returns false with the reason if the file cannot be written. */
bool points_write_json(const PointsFigures *figures, const char *path, Error *error);

/* Watches a case during its run to judge the outcome (app/run/measure/measure.h). */

typedef struct CaseWatch {
    OutcomeHistory history;
    bool looked;
    double every, next; /* s */
} CaseWatch;

CaseWatch case_watch_begin(const Case *of);

/* CaseSetup.watch callback; watcher is a CaseWatch. Looks at some of the case's states. */
void case_watch(void *watcher, const WorldDef *def, World *world);

/* Fills in the outcome; after a broken run, with the reason. */
void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome);

/* Reports of `slosh validate`: a table, JSON, one plot per case. */

/* Prints the head line of the table. */
void validate_print_head(FILE *file);

/* Prints one row per metric: value, reference, error, tolerance, seconds; the reason of a miss. If the
   outcome is not OUTCOME_HOLDS, its word and a line with its details follow. */
void validate_print(const CaseResult *result, const Outcome *outcome, FILE *file);

/* Writes {"cases": [...], "error": failure}, one entry per case, metric, method and backend. Unmeasured
   values are null; "failure" says why a run broke, "why" gives the known cause of a miss, "outcome" the
   outcome (outcome_json). `outcomes`: one per result. `failure`: why results are missing, or NULL. */
bool validate_write_json(const CaseResult *results, const Outcome *outcomes, size_t count,
                         const char *failure, const char *path, Error *error);

/* Plots the measured and reference curves of one case, all methods together. All `results` must be of one
   case. */
bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error);

/* --probes of a run: the table, and a plot with one panel per unit. `probes`: the file of --probes; with NULL
   all functions do nothing. */

/* Returns true if the scene has probes and the file can be written. Prints a hint on standard error if the
   scene has probes but --probes is missing. */
bool run_probes_check(const Session *session, const char *probes, bool quiet, Error *error);

/* Returns true if an existing file may be replaced, or is resumed. */
bool run_probes_check_table(const char *probes, bool resumed, Error *error);

/* As probe_series_begin. */
bool run_probes_begin(ProbeSeries *series, Session *session, const char *probes, bool resumed, Error *error);

/* Draws the plot; of a broken run, from the rows so far. */
bool run_probes_draw(const ProbeSeries *series, const Session *session, const char *probes, Error *error);

#endif
