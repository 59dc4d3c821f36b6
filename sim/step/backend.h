/* Backends: numbering of cells, contributions of a particle to sums and gauges, columns on the host, and
   the table of a backend's operations. */
#ifndef SIM_STEP_BACKEND_H
#define SIM_STEP_BACKEND_H

#include "shaders/sim/step/coarse_rule.h"
#include "sim/base/key.h"
#include "sim/box/box.h"
#include "sim/flow/flow.h"
#include "sim/solids/solid.h"
#include "sim/state.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <math.h>

/* Numbering of cells for counting particles. With few cells per particle, each cell has its own place: the
   cell number. In a mostly empty box, cells share a table with some places per particle, as in Teschner et
   al., "Optimized spatial hashing for collision detection of deformable objects", 2003. So empty space
   costs neither time nor memory.

   Cells of a row along x stay contiguous in the table, and no two cells of a walk share a place. So a walk
   meets each particle once, and some particles of distant cells, further away than h. Sums over neighbours
   have the same terms in the same order as without a table. */

typedef struct CellFold {
    uint32_t y, z, mask; /* cell (i, j, k) of the grid is at ((y j + z k) & mask) + i */
    size_t count;        /* of places */
    bool shared;         /* cells share places */
} CellFold;

/* A fold for `particles` particles. */
CellFold cell_fold(const Constants *constants, size_t particles);

static inline uint32_t cell_fold_at(const CellFold *fold, uint32_t x, uint32_t y, uint32_t z)
{
    return ((fold->y * y + fold->z * z) & fold->mask) + x;
}

/* Place of a cell number; one past all places for a number past all cells. */
static inline uint32_t cell_fold_of(const CellFold *fold, const CellGrid *cells, uint32_t cell)
{
    const uint32_t width = (uint32_t)cells->size[0], height = (uint32_t)cells->size[1];
    if (!fold->shared)
        return cell;
    if (cell >= cells->count)
        return (uint32_t)fold->count;
    return cell_fold_at(fold, cell % width, cell / width % height, cell / width / height);
}

/* A coarse level for a solver whose iterations move short waves only: trilinear functions on cells of
   several cells of the grid, with a value per node. A correction adds to a value per particle the smooth
   function v with the least
     sum weight |h grad v|^2 + hold v^2 - 2 residual v
   over the fluid particles, h the support radius. Thin fluid is left to iterations. The rules
   are in shaders/sim/step/coarse_rule.h. */

typedef struct CoarseShape {
    int inner[3], wide, count[3]; /* along an axis: cells of the grid; cells in a coarse cell; coarse cells.
                                     The last coarse cell may be wider */
    int along[3];                 /* nodes along an axis: as many as cells across a periodic side */
    size_t cells, nodes;          /* of the box */
} CoarseShape;

/* Coarse cells of two cells of the grid along each axis; wider in a box of more than `most` such cells. */
CoarseShape coarse_shape(const Constants *constants, size_t most);

/* Particles next to a cell of the grid, also across periodic sides. */

/* Particles [begin, end), as seen from x + shift; m. */
typedef struct CellRow {
    uint32_t begin, end;
    float shift[3]; /* 0 except across a periodic side */
} CellRow;

enum { CELL_ROWS = 18 };

/* Fills rows with all particles in `cell` and the cells around, for particles sorted by cell. `start`:
   first particle of each place of `fold`, plus an extra entry. Particles of distant cells that share a
   place are included. Returns the number of rows. */
int cell_rows(const Constants *constants, const CellFold *fold, const uint32_t *start, uint32_t cell,
              CellRow rows[CELL_ROWS]);

/* The cell at x (m) or next to x with the given place: for particles that have moved since the grid was
   made. */
uint32_t cell_near(const Constants *constants, const CellFold *fold, size_t place, const float x[3]);

/* True if a further row has the same particles: along a periodic axis of two cells, both neighbours of a
   cell are the same cell. For callers that take the nearest image of a pair and ignore the row's shift. */
bool cell_row_repeats(const Constants *constants, const CellRow *row);

/* Contribution of a particle to a world's sums, for the backends. */

/* Adds a particle of mass m (kg) at x (m) with velocity v (m/s). `centre` is not yet divided by the mass. */
static inline void sums_add(WorldSums *sums, double m, const double x[3], const double v[3])
{
    double speed2 = 0, l2 = 0;
    sums->mass += m;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double l = m * (x[a] * v[b] - x[b] * v[a]);
        sums->momentum[k] += m * v[k];
        sums->angular_momentum[k] += l;
        sums->centre[k] += m * x[k];
        speed2 += v[k] * v[k];
        l2 += l * l;
    }
    sums->momentum_scale += m * sqrt(speed2);
    sums->angular_scale += sqrt(l2);
    sums->kinetic_energy += 0.5 * m * speed2;
    sums->max_speed = fmax(sums->max_speed, sqrt(speed2));
}

/* A particle's contribution to a world's gauge (sim/world.h), for the backends. A gauge needs
   nothing else of the state. */

/* Adds a particle at x (m) with velocity v (m/s) and `compression` to the sums; the mean is not yet divided
   by the count. `gravity` in the box's frame, m/s2. */
static inline void gauge_add(WorldGauge *gauge, const Constants *constants, const double gravity[3],
                             int fluid, double compression, const float x[3], const float v[3])
{
    const double m = constants_mass(constants, fluid), c = (double)constants->sound_speed;
    const double pressed = compression > 0 ? compression : 0;
    double speed2 = 0, height = 0;
    for (int k = 0; k < 3; k++) {
        speed2 += (double)v[k] * (double)v[k];
        height -= gravity[k] * (double)x[k];
    }
    gauge->density_error_mean += pressed;
    gauge->density_error_max = fmax(gauge->density_error_max, pressed);
    gauge->kinetic_energy += 0.5 * m * speed2;
    gauge->potential_energy += m * height;
    if (constants->method->energy)
        gauge->compression_energy +=
            m * c * c * constants->method->energy(constants->negative_pressure ? compression : pressed);
}

/* The same for EnergySums; `turning`: with the sums for a turning box. */
static inline void energy_add(EnergySums *sums, const Constants *constants, int fluid, double compression,
                              const float at[3], const float velocity[3], bool turning)
{
    const double m = constants_mass(constants, fluid), c = (double)constants->sound_speed;
    double x[3], v[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (double)at[k];
        v[k] = (double)velocity[k];
    }
    energy_sums_add(sums, m, x, v);
    if (turning)
        energy_sums_add_turning(sums, m, x, v);
    if (constants->method->energy && (compression > 0 || constants->negative_pressure))
        sums->own += m * c * c * constants->method->energy(compression);
}

/* Host-side column functions shared by all backends: initial state and reading. */

/* Writes an initial state to zeroed columns; ids count from 0. */
void particles_set(const ParticleColumns *to, const Constants *constants, const InitialState *initial);

/* rho / rho0 - 1: carried, or calibrated to p = c^2 (rho - rho0). */
static inline float particle_compression(const ParticleColumns *p, const Constants *constants, size_t i)
{
    if (p->compression)
        return p->compression[i];
    return constants->stiffness_scale * (1 / (p->volume[i] * constants->rest_number_density) - 1);
}

/* Fills entries [begin, end) of `out` with particles at[k], or particles k if `at` is NULL. */
void particles_read(const ParticleColumns *p, const Constants *constants, const uint32_t *at, size_t begin,
                    size_t end, const ParticleArrays *out);

/* Sums over particles 0 to count - 1, in sequence; without `neighbours_mean`. */
void particles_sums(const ParticleColumns *p, const Constants *constants, size_t count, WorldSums *sums);

/* A backend: holds the particles and computes. A backend is a const table of coarse operations; no
   operation is called per particle. */

struct BackendMicro;    /* sim/step/method.h */
struct Iteration;       /* sim/step/substep.h */
struct IterationFound;  /* sim/step/substep.h */
struct Substep;         /* sim/step/substep.h */
struct Forces;          /* sim/world.h */
struct ParticleBuffers; /* sim/gpu/particle_buffers.h */

/* The positive part of a column. */
typedef struct Excess {
    double mean;    /* over all particles, negative values as 0; NaN if a value is NaN */
    float greatest; /* at least 0 */
} Excess;

enum { FLOWS_MAX = 256 };
#define FLOW_LATER SIZE_MAX

/* A save without waiting for the GPU. */
typedef struct BackendCopy {
    /* Starts to copy the particles for the columns `to`; an earlier copy is lost. *copy: NULL at first, then
       kept from call to call. Returns false if memory is short. */
    bool (*begin)(void *state, const ParticleColumns *to, void **copy);
    /* Reads a part after the arrival, or `waits` for the whole. Needs no state. Returns false without an
       answer of the device. */
    bool (*go_on)(void *copy, const ParticleColumns *to, bool waits, bool *whole);
    void (*free)(void *copy); /* NULL is allowed */
} BackendCopy;

typedef struct Backend {
    const char *name, *help;
    const Key *keys; /* of the backend's settings, ended by a row without a path; NULL: none */
    const void *def; /* struct of the settings, with defaults */
    size_t def_size; /* bytes; at most BACKEND_DEF_SIZE */
    /* Steps run asynchronously in a GL context, which must be current for every use of a world; `watch` is
       called once per frame. */
    bool gpu;
    uint32_t scalars; /* of BACKEND_SCALAR_LIST: those that the backend shares with views, a bit each */
    int *(*threads)(const WorldDef *def); /* the def's number of threads; NULL: not chosen by a def */
    /* True if the backend supports everything that the def names; false with the reason. Needs no context.
       NULL: supports all. */
    bool (*can)(const WorldDef *def, Error *error);
    /* Creates the state of `initial->count` particles with room for `capacity`; NULL with the reason on
       failure. The constants outlive the state, the def does not. */
    void *(*create)(const Constants *constants, const WorldDef *def, const InitialState *initial,
                    size_t capacity, Error *error);
    void (*destroy)(void *state);
    /* Call after constants_change. Returns false with the reason if resources of new terms are not
       available. */
    bool (*adapt)(void *state, Error *error);
    /* Call after constants_vary: only viscosities changed in the constants. NULL: the backend reads the
       constants in each pass. */
    void (*vary)(void *state);
    /* Reloads the shaders; on false the old shaders stay. NULL: no shaders. */
    bool (*reload)(void *state, Error *error);
    /* Sets the solids' poses, one per solid. In a world with solids, call before everything else. */
    void (*pose)(void *state, const SolidPose *pose);
    /* Called around the passes of a step. NULL: nothing to do. */
    void (*enter)(void *state);
    void (*leave)(void *state);
    /* Call before a step that can start again from `mark`: the backend may guess the ends of solvers, and
       `finish` checks. NULL: no guesses. */
    void (*guess)(void *state);
    /* Free flight over `step`, then the last guard of walls and solids; solids move to their end poses. */
    void (*drift)(void *state, const BoxStep *step);
    /* Sorts the particles by cell; within a cell by id, on compute only if the def is reproducible. */
    void (*grid)(void *state);
    /* Runs a pass of the method. */
    void (*run)(void *state, const Pass *pass, const PassInput *input);
    /* Excess of a column with a single component, over the fluid particles, in an order independent of
       threads. NULL: the backend has `iterate`, or runs no iterating method. */
    Excess (*excess)(void *state, const ColumnDef *column);
    /* Sum of such a column, in the same order. NULL: a backend with `iterate` sums by itself. */
    double (*sum)(void *state, const ColumnDef *column);
    /* substep_iterate of solver `which` on the device. Returns false after a guess: `finish`
       writes the report. NULL: substep_iterate asks for the excess after each iteration. */
    bool (*iterate)(const struct Substep *step, const struct Iteration *iteration, int which,
                    const PassInput *input, struct IterationFound *found);
    /* v += (acceleration + gravity) dt. */
    void (*kick)(void *state, const float gravity[3], float dt);
    /* Findings of the kicks since the last call or `load`; waits for the kicks. */
    StepWatch (*watch)(void *state);
    /* Applies sim/world.h to all fluid particles. */
    void (*touch)(void *state, const FingerStep *finger);
    /* Sets particles in each guide to the guide's velocity; returns the work, J, if `energy` exists. */
    double (*guide)(void *state, const Guide *guides, int count);
    void (*sums)(void *state, WorldSums *sums);           /* all members except those for the box's pose */
    bool (*read)(void *state, const ParticleArrays *out); /* false if memory is short */
    size_t (*held)(const void *state); /* number of particles given by `read`; NULL: all particles of the
                                          world */
    /* `gauge` starts to gather, with gravity in the box's frame, m/s2; false if
       impossible. `gauged` is true once the gauge is ready, and with `waits` waits for the gauge: sums,
       with the mean divided. */
    bool (*gauge)(void *state, const double gravity[3]);
    bool (*gauged)(void *state, WorldGauge *gauge, bool waits);
    /* Sums for sim/step/world.h, at once; `second` and `turn` only for turning boxes. NULL: the
       backend has the gauge instead. */
    void (*energy)(void *state, bool turning, EnergySums *sums);
    /* Call before `finish` of a step, if `energy` is likely to follow: sums arrive with the step's results.
       NULL: without gain. */
    void (*energy_ahead)(void *state);
    /* From now on, steps add forces on box and solids to `to`; `to` NULL: stop. Returns false if memory is
       short. NULL: the backend sums no forces. */
    bool (*enable_forces)(void *state, struct Forces *to, Error *error);
    /* `forces_send` starts to bring sums of `enable_forces` since the last call from the device.
       `forces_take` adds the oldest sums sent, and waits; at most two may be sent before. Returns false
       without an answer of the device. NULL: the sums are always up to date. `mark` includes these sums;
       `back` and `load` forget sums under way. */
    void (*forces_send)(void *state);
    bool (*forces_take)(void *state);
    /* Call after each step: brings forces, flows and reports of solvers from the device, with a single wait
       at most. `forces`: sent and taken. `flowed`: number of particles of each FLOW_LATER, in order, with
       room for FLOWS_MAX. Returns false after a wrong guess: the step must start again. NULL: all is known
       already. */
    bool (*finish)(void *state, bool forces, size_t *flowed);
    /* Called between steps. `emit` adds at most `most` particles of a layer: particles in the box and not
       next to present particles. `drain` removes particles in a region. Both return the number of
       particles, or FLOW_LATER: `finish` brings the number. In a step at most FLOWS_MAX calls. */
    size_t (*emit)(void *state, const EmitLayer *layer, size_t most);
    size_t (*drain)(void *state, const Fill *regions, int count);
    /* `save` copies the particles into columns of the same count. `load` takes `count` particles, at most
       the capacity, in any order; `pose`, `grid` and the method's `settle` must follow. Both return false,
       with nothing done, if memory is short. */
    bool (*save)(void *state, const ParticleColumns *to);
    bool (*load)(void *state, const ParticleColumns *from, size_t count, size_t guarded);
    const BackendCopy *copies; /* NULL: `save` does not wait for long */
    /* `mark` keeps a copy of the particles on the device, `back` restores the copy like `load`. Both NULL:
       use `save` and `load`. */
    bool (*mark)(void *state, Error *error);
    void (*back)(void *state, size_t count, size_t guarded);
    /* Shares the particles in the backend's GL buffers, at least PARTICLE_* of `attributes`, valid until
       the next step or call. NULL: no such buffers. */
    void (*share)(void *state, unsigned attributes, struct ParticleBuffers *out);
    void (*info)(const void *state, WorldInfo *info); /* threads, state_bytes, guarded */
    /* Names the backend settings, with values, to raise when the grid loses particles. NULL: the grid loses
       none. */
    void (*to_raise)(const void *state, char text[128]);
    const struct BackendMicro *micro; /* for `slosh bench --micro`; NULL: passes cannot run alone */
} Backend;

extern const Backend backend_cpu;

/* Appends a backend to the list, unless present: for backends beyond sim, before the first scene is read.
   The backend must outlive all worlds. Not thread-safe. */
void backend_add(const Backend *backend);

/* All backends, ended by NULL. */
const Backend *const *backend_list(void);

/* NULL if no backend has the name. */
const Backend *backend_find(const char *name);

/* The backend's settings in a def, writable like memchr's result; NULL if the backend is not in the list. */
void *backend_def(const WorldDef *def, const Backend *backend);

/* Fills in the defaults of all backends' settings. */
void backends_default(WorldDef *def);

#endif
