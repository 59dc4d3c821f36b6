/* Measurements of a run: metrics of particles read back, the probes of a scene, and the outcome. */
#ifndef APP_RUN_MEASURE_MEASURE_H
#define APP_RUN_MEASURE_MEASURE_H

#include "app/base/file.h"
#include "app/run/measure/measure_def.h"
#include "sim/def.h"
#include "sim/world.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Measurements of a fluid: particles read back (Cloud), curves (Curve), pure functions of both (metric_*),
   statistics over states (Compression), and the list of a scene's metrics (MetricKind). Lengths in m. */

/* The particles of a world, read back for the metrics. */

/* Pure data: tests can fill in a cloud by hand. */
typedef struct Cloud {
    size_t count;
    double spacing, support_radius; /* m */
    float *position, *velocity;     /* 4 per particle: x y z 0; m, m/s */
    float *density, *pressure;      /* kg/m3, Pa */
    uint32_t *fluid;
} Cloud;

/* Reads the present state of `world`, replacing the contents of `cloud`. Zero-initialise `cloud` before
   the first call. Returns false if memory is short. */
bool cloud_read(Cloud *cloud, World *world);
void cloud_free(Cloud *cloud);

/* A series of points (x, y), made by metrics and drawn by charts. */

/* Zero-initialise before use. */
typedef struct Curve {
    size_t count, capacity;
    double (*at)[2]; /* x, y */
} Curve;

/* Adds a point. Ends the program if memory is short: a curve has a few thousand points at most. */
void curve_add(Curve *curve, double x, double y);
void curve_free(Curve *curve);

/* Returns y at x by linear interpolation; x must ascend. NaN outside the points. */
double curve_at(const Curve *curve, double x);

/* Returns the slope of the least-squares line; NaN for less than two points. */
double curve_slope(const Curve *curve);

/* Returns the period of y: the mean distance in x between every second zero crossing, by linear
   interpolation. NaN for less than three crossings. */
double curve_period(const Curve *curve);

/* Finds the peaks of |y|, one between each two zero crossings: x and the natural logarithm of the height,
   by a parabola through the highest point and its neighbours. Omits peaks before the first and after the
   last crossing. */
void curve_log_peaks(const Curve *curve, Curve *peaks);

/* Measurements for the cases of `slosh validate`: pure functions of particles. Lengths in m. */

/* Front of a flow along a floor y = 0, in direction x: the highest x of particles below two spacings with
   at least five neighbours (nearer than the support radius), plus half a spacing. NaN if there is none. */
double metric_front(const Cloud *cloud);

/* Height of the fluid at the wall x = `wall`, above the floor y = 0. Of the particles less than three
   spacings from the wall, the mean height of the topmost half spacing, plus half a spacing. */
double metric_wall_height(const Cloud *cloud, double wall);

/* Height of the flat surface of a fluid at rest: the mean height of particles less than half a spacing
   below the highest, plus half a spacing. */
double metric_surface(const Cloud *cloud);

/* rms of p - density gravity (surface - y), over density gravity surface, of a fluid at rest on a floor y
   = 0. `points` (may be NULL) gets each particle's height and pressure. */
double metric_hydrostatic(const Cloud *cloud, double density, double gravity, Curve *points);

/* Slope of height over r^2 = x^2 + z^2, by least squares over the highest particle of each square cell
   (side: one spacing) in a box of the given width. Cells at the walls are left out. `points` (may be NULL)
   gets r and height. */
double metric_paraboloid(const Cloud *cloud, double width, Curve *points);

/* The centre of mass of the particles with low <= x < high (m), equal masses. */
void metric_centre(const Cloud *cloud, double low, double high, double centre[3]);

/* Semi-axes along x and y of the ellipse with the same second moments as the particles in the plane: 2
   sqrt(<(x - mean)^2>). The particles' own extent, spacing^2 / 12, is added to the moments. */
void metric_axes(const Cloud *cloud, double axes[2]);

/* Mean pressure of the particles within `radius` of `centre`; NaN without particles. */
double metric_mean_pressure(const Cloud *cloud, const double centre[3], double radius);

typedef struct Energies {
    double kinetic, potential, elastic; /* J; potential over y = 0; elastic: of compression */
} Energies;

/* Energies of the particles in the box's frame, with the masses and the equation of state of `def`. */
void metric_energies(const Cloud *cloud, const WorldDef *def, Energies *energies);

/* Velocity at a point in 2D, by moving least squares (Shepard interpolation, linear in space) with the
   cubic kernel of the support radius. Returns false if fewer than six particles are near. */
bool metric_velocity(const Cloud *cloud, const double at[2], double velocity[2]);

/* Closeness of particles: counts of particles too near to a neighbour (pairs and clumps); coherence of
   motion. */

/* Counts, among every `stride`-th particle, particles with a neighbour of any fluid nearer than `limit`
   (m, more than 0). Neighbours are searched among all particles. Pairs across periodic sides are ignored;
   positions with NaN or infinity are skipped. Returns false if memory is short. */
bool metric_close(const Cloud *cloud, double limit, size_t stride, size_t *close);

/* Common motion of every `stride`-th particle with neighbours nearer than h: `common` is the sum of v . u,
   with u the weighted mean velocity of the neighbours, and `kinetic` the sum of v . v, m2/s2. Their ratio is
   1 in uniform motion, 0 for a gas. Returns false if memory is short. */
bool metric_common_motion(const Cloud *cloud, double h, size_t stride, double *common, double *kinetic);

/* Compression of particles above their rest density over several states: a comparison for all methods. */

enum { COMPRESSION_BINS = 1280, COMPRESSION_SUMS = COMPRESSION_BINS + 2 };

/* Zero-initialise before use. */
typedef struct CompressionTally {
    uint64_t states;
    double most, thinned; /* greatest compression; greatest relative deficit of density below rest density */
    double particles, sum, bins[COMPRESSION_BINS]; /* COMPRESSION_SUMS sums over all states: particles,
                                                      compression, particles in each bin */
} CompressionTally;

/* Fractions of the rest density, over all particles of all states. Densities below rest count as 0, except
   in `least`, the least density. */
typedef struct CompressionFigures {
    double mean, p999, most, least; /* p999: 99.9 % of particles are at or below p999; accurate to 1 % */
} CompressionFigures;

void compression_add(CompressionTally *tally, const Cloud *cloud, const WorldDef *def);
CompressionFigures compression_figures(const CompressionTally *tally);

/* The metrics of a scene: `slosh chart` compares two runs by them. This is the only list of their names,
   used by the scene key `metrics`, `slosh info` and the documentation. */

enum { METRIC_NUMBERS = 3, METRIC_PROBES = 16 }; /* greatest count of numbers of a metric; of probes */

/* A state, input of the metrics. */
typedef struct MetricState {
    const WorldDef *def;
    WorldInfo info;
    WorldSums sums;
    Cloud cloud; /* empty if no metric reads particles */
    /* First number of each of the scene's probes; the caller fills in both after metric_state_read. */
    int probe_count;
    double probe[METRIC_PROBES];
} MetricState;

typedef struct MetricKind {
    const char *name, *unit, *help;
    int numbers;    /* 1; or 3: x y z, compared as a vector, over the greatest range of the three; 0: one
                       per probe, each compared over its own range, then averaged */
    bool particles; /* needs MetricState.cloud */
    void (*of)(const MetricState *state, double out[]); /* NaN if the state has no value */
} MetricKind;

/* Ended by a NULL name. */
extern const MetricKind metric_kinds[];

/* Returns the count of numbers of a metric in a scene with `probe_count` probes. */
int metric_numbers(int metric, int probe_count);

/* Fills in the indices of the default metrics; returns their count. */
int metric_defaults(int metrics[]);

/* Fills in `state` for the given metrics. Zero-initialise `state` before the first call; call
   metric_state_free at the end. Returns false if memory is short. */
bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count);
void metric_state_free(MetricState *state);

/* Probes of a scene (measure_def.h): sensors among the particles (Sensors), the numbers of all probes
   (Probes), means over time (ProbeWindow), and the table of a run (ProbeTable). */

/* Sensors: fluid properties at places in the box, from the particles around.

   The value at a place is a weighted sum over the particles in a ball, with weights w falling to 0 at the
   rim, after Shepard, "A two-dimensional interpolation function for irregularly-spaced data", 1968.
   Weighted least squares make the sum exact for fields linear in space (Lancaster and Salkauskas,
   "Surfaces generated by moving least squares methods", 1981). The reason: at a wall all particles are on
   one side.
   If the particles determine the slope badly, the result falls back towards Shepard's. */

typedef struct Sensors Sensors;

/* Requested values, besides the filling; unrequested values cost nothing, and are 0 or NaN. */
enum { SENSOR_PRESSURE = 1, SENSOR_DENSITY = 2, SENSOR_VELOCITY = 4 };

typedef struct Sensor {
    double at[3], radius; /* m, in the box's frame; radius of the ball */
    unsigned wants;       /* bits SENSOR_... */
} Sensor;

/* Fluid at a sensor. The filling is the fluid's fraction of the ball inside the box and outside solids at
   rest, weighted by w: one half at a flat surface. */
typedef struct SensorReading {
    double filling;
    double pressure;    /* Pa; falls to 0 with fillings below one half, like on a half dry sensor */
    double density;     /* kg/m3; NaN for fillings below one half */
    double velocity[3]; /* m/s; NaN likewise */
} SensorReading;

/* Creates the sensors; NULL if memory is short. `def` is not kept. */
Sensors *sensors_create(const Sensor *sensors, int count, const WorldDef *def);
void sensors_destroy(Sensors *sensors); /* NULL is allowed */

/* Returns false if x (m) is in no ball. */
bool sensors_cover(const Sensors *sensors, const float x[3]);

/* Reads all sensors, from particles in the given order. */
void sensors_read(Sensors *sensors, const Cloud *cloud, SensorReading *out);

/* The probes of a scene: compute a row of numbers from the particles, one per column. */

typedef struct Probes Probes;

enum {
    PROBES_PLOTTED = 16, /* probes of a list with a small plot: the first */
    PROBE_SHOWN = 3,     /* most plotted columns of a probe; of all probes: */
    PROBES_SHOWN = PROBES_PLOTTED * PROBE_SHOWN
};

typedef struct ProbeColumn {
    char name[PROBE_NAME_SIZE + 32]; /* "wall.pressure", "column_3.velocity_x", "tank.height" */
    const char *unit;
    double average; /* averaging time of the probe, s: ProbeDef.average */
} ProbeColumn;

/* probe_columns: count of columns of a probe. probe_column: describes column `index`. */
int probe_columns(const ProbeDef *def);
void probe_column(const ProbeDef *def, int index, ProbeColumn *out);

/* Chooses the columns for a small plot, and returns their count: at most three, the first, the middle and
   the last; of a force its three components. */
int probe_shown(const ProbeDef *def, int index[PROBE_SHOWN]);

/* Creates the probes of the list in a world of `def`; NULL if memory is short. Neither argument is kept. */
Probes *probes_create(const ProbeList *list, const WorldDef *def);
void probes_destroy(Probes *probes); /* NULL is allowed */

int probes_columns(const Probes *probes);
const ProbeColumn *probes_column(const Probes *probes, int column);

/* Returns false if no probe reads particles at x, m. */
bool probes_cover(const Probes *probes, const float x[3]);

/* Reads all probes, one number per column; NaN without fluid. Exceptions: pressure and height are then 0.
   `forces`: means of world_forces since the last reading; with 0 seconds the last forces stay, and before
   the first step the numbers are NaN. NULL is allowed if no probe is a force (probe_list_has_forces); else
   the world must sum forces (world_enable_forces). */
void probes_read(Probes *probes, const Cloud *cloud, const Forces *forces, float out[]);

/* Means over the last seconds, from earlier rows. */

/* Zero-initialise all but `columns` and `longest`. */
typedef struct ProbeWindow {
    int columns;
    double longest;                /* s: how long rows are kept */
    size_t first, count, capacity; /* kept rows and capacity */
    double *time;                  /* s, */
    float *value;                  /* `columns` per row */
} ProbeWindow;

/* Adds a row, later than the last; returns false if memory is short. */
bool probe_window_add(ProbeWindow *window, double time, const float value[]);
void probe_window_free(ProbeWindow *window);

/* Returns the mean of a column over the last `seconds` up to the last row. Each row stands for the time
   since the row before; NaN is skipped. Without an earlier row, returns the last row's value. */
double probe_window_mean(const ProbeWindow *window, int column, double seconds);

/* Table of probe readings over a run: CSV, one row per step, growing with the run. Columns: `time [s]`,
   then the columns of the probes with units, "wall.pressure [Pa]". With an averaging time, each column is
   followed by its mean, "wall.pressure_mean [Pa]". A field without a number is empty. */

/* Statistics of a column over the whole table. */
typedef struct ProbeFigures {
    size_t rows; /* rows with a number */
    double sum, least, most;
} ProbeFigures;

/* Zero-initialise before use. */
typedef struct ProbeTable {
    FILE *file; /* NULL: no table */
    OutputLock lock;
    char path[1024];
    const Probes *probes;
    int columns;              /* count of probe columns */
    double last;              /* time of the last row, s; less than 0: no rows */
    ProbeWindow window;       /* of written rows */
    ProbeFigures *figures;    /* one per probe column */
    size_t waiting, capacity; /* rows not written yet, and their capacity */
    double *time;             /* s, */
    float *value;             /* `columns` per row */
} ProbeTable;

/* Returns true if a table may be written to the path: no file, an empty file, or a table of any scene's
   probes. Returns false with the reason. */
bool probe_table_check(const char *path, Error *error);

/* Opens the table of the given probes, which must outlive the table. Starts a new table; or with `keep`
   (s) at least 0, keeps the rows up to time `keep` of an existing table. Returns false with the reason:
   the file cannot be written, another slosh writes the file, or the file has other contents, which stay. */
bool probe_table_open(ProbeTable *table, const char *path, const Probes *probes, double keep, Error *error);

/* Adds a waiting row, as the step may be taken back. Returns false if memory is short. */
bool probe_table_add(ProbeTable *table, double time, const float value[]);

void probe_table_drop(ProbeTable *table);                /* drops waiting rows */
bool probe_table_write(ProbeTable *table, Error *error); /* writes waiting rows to the file */

/* Closes the table; does nothing if not open. */
bool probe_table_close(ProbeTable *table, Error *error);

/* Returns {"wall.pressure": {"unit", "rows", "mean", "min", "max"}, ...}: means over rows. Returns NULL if
   memory is short. */
json_t *probe_table_json(const ProbeTable *table);

void probe_table_free(ProbeTable *table); /* call after probe_table_close */

/* Outcome of a run: the only definition of each kind of failure. All commands running a fluid report these
   words in the terminal, the panel, the table and the JSON. */

/* X(ENUM, word, help): from best to worst; a run gets the worst applicable kind. */
#define OUTCOMES(X)                                                                                          \
    X(NONE, "not run", "something else than the fluid failed")                                               \
    X(HOLDS, "holds", "none of the others")                                                                  \
    X(BOILS, "boils", "neighbours move in all directions, as in a gas")                                      \
    X(NOISY, "noisy", "energy grows without work done")                                                      \
    X(FAST, "too fast", "particles are faster than sound")                                                   \
    X(SQUEEZED, "squeezed", "fluid has lost volume")                                                         \
    X(CLUMPS, "clumps", "particles lie on each other")                                                       \
    X(LEAKS, "leaks", "particles cross walls, or have no place in a grid")                                   \
    X(DIVERGES, "does not converge", "a solver ends far from what it was asked for")                         \
    X(BLOWN_UP, "blown up", "particles move too far in a step, or are pressed too hard")

typedef enum OutcomeKind {
#define X(NAME, word, help) OUTCOME_##NAME,
    OUTCOMES(X)
#undef X
        OUTCOME_COUNT
} OutcomeKind;

const char *outcome_word(OutcomeKind kind);

/* Returns the kind of a word; OUTCOME_COUNT if unknown. */
OutcomeKind outcome_of_word(const char *word);

/* Energy has grown without work if the energy exceeds its earlier minimum by this fraction of the sum of
   kinetic, compression and available potential energy. The greatest gain of any scene is 2.2 %
   (docs/labbook/failures.md). */
#define OUTCOME_GAIN 0.05

/* Fluid in a box at rest boils if two conditions hold. The fraction of kinetic energy in common motion
   with neighbours is less than OUTCOME_TOGETHER. Particles jump higher than OUTCOME_JUMP spacings under
   gravity, or are faster than OUTCOME_OF_SOUND of the sound speed. Calm or splashing scenes have a
   fraction of a half and more. */
#define OUTCOME_TOGETHER 0.2
#define OUTCOME_JUMP     0.5
#define OUTCOME_OF_SOUND 0.05

/* Fluid has lost volume if the mean compression above rest density exceeds this fraction. Calm scenes have
   less than 0.02 with all methods. */
#define OUTCOME_PRESSED 0.05

/* Particles lie on each other if the fraction with a neighbour nearer than OUTCOME_NEAR spacings has grown
   by OUTCOME_CLOSE since the start. */
#define OUTCOME_NEAR  0.2
#define OUTCOME_CLOSE 0.1

/* Fluid leaks if the fraction OUTCOME_OUT of its particles is beyond a wall by OUTCOME_BEYOND spacings, or
   without a place in the grid. */
#define OUTCOME_BEYOND 0.5
#define OUTCOME_OUT    0.001

/* Properties of a run at one time. */
typedef struct OutcomeSample {
    double time;     /* s */
    size_t count;    /* particles */
    size_t close;    /* particles nearer than OUTCOME_NEAR spacings to a neighbour */
    size_t beyond;   /* particles beyond a wall of the box, or inside a solid, by OUTCOME_BEYOND spacings, or
                        at NaN */
    size_t lost;     /* particles without a place in the grid */
    double pressed;  /* mean compression above rest density, a fraction */
    double together; /* fraction of kinetic energy in common motion with neighbours; 1 at rest */
    double jump;     /* mean speed over the threshold of OUTCOME_JUMP or OUTCOME_OF_SOUND */
    double fastest;  /* greatest speed of any particle so far, m/s */
    double sound;    /* m/s; 0 without sound */
    bool stuck;      /* a solver of the last step failed to converge */
    double energy; /* kinetic, potential and compression energy, J; NaN: unknown, or external work is done */
    double scale;  /* reference for growth of energy, J */
} OutcomeSample;

enum { OUTCOME_SAMPLES_MAX = 64 };

typedef struct OutcomeHistory {
    int count;
    OutcomeSample look[OUTCOME_SAMPLES_MAX]; /* ordered by time */
    WorldTrouble trouble;                    /* `ended`: the trouble ended the run */
} OutcomeHistory;

enum { OUTCOME_WORDS = 192 };

typedef struct Outcome {
    OutcomeKind kind;
    double time;               /* time of first detection, s; NaN if the run holds or was not run */
    char words[OUTCOME_WORDS]; /* details on one line; "" if the run holds */
} Outcome;

/* Judges a run by its looks and its trouble; a failure only between two looks goes unseen. */
void outcome_judge(const OutcomeHistory *history, Outcome *outcome);

/* Makes the outcome of a failure outside the fluid. */
void outcome_not_run(const char *why, Outcome *outcome);

enum { OUTCOME_TEXT = OUTCOME_WORDS + 64 };

/* "blown up at t = 0.31 s: a particle moves further than the support radius in one step"; "holds" */
const char *outcome_text(const Outcome *outcome, char text[OUTCOME_TEXT]);

/* Adds "outcome" to an object (may be NULL): the kind's word; unless the run holds, also "outcome_time"
   (s, or null) and "outcome_words". */
void outcome_json(json_t *object, const Outcome *outcome);

/* Takes looks at a world, to judge its outcome. */

/* Adds a look at the present state, which must be sound; a full history's last look is replaced. `def`:
   definition of the world; `moved`: the box is moved by other means than the scene. Reads the particles:
   takes about ten steps' time. Returns false if memory is short. */
bool outcome_sample(OutcomeHistory *history, const WorldDef *def, bool moved, World *world);

/* Records the trouble that ended the run, if any. */
void outcome_end(OutcomeHistory *history, const World *world);

/* Watches a running fluid for failures outside the sentinel's reach: lost volume, particles lying on each
   other or beyond walls, boiling, too fast motion, slow growth of energy. On a
   GPU each look would wait for the GPU: there only speeds are checked. */

/* Steps from one look to the next: as many as there have been so far, within these bounds. Most failing
   runs fail early; later a look, of up to two thirds of a step's time, takes less than a hundredth of the
   time. */
enum { FLUID_WATCH_STEPS = 50, FLUID_WATCH_LATER = 200, FLUID_WATCH_WORDS = OUTCOME_WORDS + 192 };

/* Adds up each value over all MPI ranks. */
typedef void OutcomeSum(double *values, int count);

/* Zero-initialise all but `closed`, `resumed` and `sum`; again whenever the scene restarts. */
typedef struct FluidWatch {
    bool closed;         /* only the scene acts, no hand, no changes: energy is checked */
    bool resumed;        /* continues from a later state: no close particles are normal */
    OutcomeSum *sum;     /* for a world on MPI ranks, where pairs of particles across two ranks go unseen;
                            NULL: a single process */
    bool looked;         /* true after the first look */
    OutcomeSample start; /* normal values: close particles at the first look; least energy so far; remaining
                          members 0 */
    Outcome worst;       /* of all looks */
    unsigned reported;   /* reported kinds: bit k stands for OutcomeKind k */
    uint64_t next;       /* step of the next look */
} FluidWatch;

/* Call after a sound step, at the end of a frame: looks if a look is due. Returns true if a kind of
   failure is found for the first time; `words` gets its word, details, and advice. Of several kinds the
   worst is reported first, the next kind at the next look. */
bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS]);

/* Fills in the outcome of the run, including the trouble that ended the run. Returns false if there was no
   look. */
bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome);

#endif
