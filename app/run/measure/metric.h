/* Measurements of a fluid: particles read back (Cloud), curves (Curve), pure functions of both (metric_*),
   statistics over states (Compression), and the list of a scene's metrics (MetricKind). Lengths in m. */
#ifndef APP_RUN_MEASURE_METRIC_H
#define APP_RUN_MEASURE_METRIC_H

#include "slosh/def.h"
#include "slosh/world.h"

#include <stddef.h>

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
   (side: one spacing) in a box of the given width; cells at the walls are left out. `points` (may be NULL)
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

/* Fraction of the kinetic energy of every `stride`-th particle in common motion with neighbours nearer
   than h: sum v . u over sum v . v, with u the weighted mean velocity of the neighbours. 1 without motion
   or in uniform motion; 0 for a gas. Returns false if memory is short. */
bool metric_common_motion(const Cloud *cloud, double h, size_t stride, double *together);

/* Compression of particles above their rest density over several states: a comparison for all methods. */

enum { COMPRESSION_BINS = 1280 };

/* Zero-initialise before use. */
typedef struct CompressionTally {
    uint64_t states, particles; /* of all states */
    double sum, most;
    double thinned; /* greatest relative deficit of density below rest density */
    uint64_t bins[COMPRESSION_BINS];
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

#endif
