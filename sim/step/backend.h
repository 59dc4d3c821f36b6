/* A backend: holds the particles and computes. A backend is a const table of coarse operations; no
   operation is called per particle. */
#ifndef SIM_STEP_BACKEND_H
#define SIM_STEP_BACKEND_H

#include "sim/base/key.h"
#include "sim/box/box_step.h"
#include "sim/flow/flow.h"
#include "sim/solids/solid.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"
#include "sim/step/step_control.h"
#include "slosh/state.h"
#include "slosh/world.h"

struct BackendMicro;    /* sim/step/method.h */
struct Iteration;       /* sim/step/iterate.h */
struct Forces;          /* include/slosh/world.h */
struct ParticleBuffers; /* sim/gpu/particle_buffers.h */

/* The positive part of a column. */
typedef struct Excess {
    double mean;    /* over all particles, negative values as 0; NaN if a value is NaN */
    float greatest; /* at least 0 */
} Excess;

typedef struct Backend {
    const char *name, *help;
    const Key *keys; /* of the backend's settings, ended by a row without a path; NULL: none */
    const void *def; /* struct of the settings, with defaults */
    size_t def_size; /* bytes; at most BACKEND_DEF_SIZE */
    /* Steps run asynchronously in a GL context, which must be current for every use of a world; `watch` is
       called once per frame. */
    bool gpu;
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
    /* The loop of substep_iterate on the device. `solve`: on entry the solver's result of the last step, on
       return of the current step. NULL: substep_iterate asks for the excess after each iteration. */
    void (*iterate)(void *state, const struct Iteration *iteration, const PassInput *input, StepSolve *solve);
    /* v += (acceleration + gravity) dt. */
    void (*kick)(void *state, const float gravity[3], float dt);
    /* Findings of the kicks since the last call or `load`; waits for the kicks. */
    StepWatch (*watch)(void *state);
    /* Applies include/slosh/world.h to all fluid particles. */
    void (*touch)(void *state, const FingerStep *finger);
    /* Sets particles in each guide to the guide's velocity; returns the work, J, if `energy` exists. */
    double (*guide)(void *state, const Guide *guides, int count);
    void (*sums)(void *state, WorldSums *sums);           /* all members except those for the box's pose */
    bool (*read)(void *state, const ParticleArrays *out); /* false if memory is short */
    size_t (*held)(const void *state); /* number of particles given by `read`; NULL: all particles of the
                                          world */
    /* `gauge` starts to gather sim/step/backend_sums.h, with gravity in the box's frame, m/s2; false if
       impossible. `gauged` is true once the gauge is ready, and with `waits` waits for the gauge: sums,
       with the mean divided. */
    bool (*gauge)(void *state, const double gravity[3]);
    bool (*gauged)(void *state, WorldGauge *gauge, bool waits);
    /* Sums for sim/step/sentinel.h, at once; `second` and `turn` only for turning boxes. NULL: the
       backend has the gauge instead. */
    void (*energy)(void *state, bool turning, EnergySums *sums);
    /* From now on, steps add forces on box and solids to `to`; `to` NULL: stop. Returns false if memory is
       short. NULL: the backend sums no forces. */
    bool (*feel)(void *state, struct Forces *to, Error *error);
    /* Brings sums of `feel` from the device; waits. Returns false if memory is short. NULL: the sums are
       always up to date. `mark` and `back` include these sums. */
    bool (*felt)(void *state);
    /* Between steps. `emit` adds at most `most` particles of a layer: particles in the box and not next to
       present particles. `drain` removes particles in a region. Both return the number of particles. */
    size_t (*emit)(void *state, const EmitLayer *layer, size_t most);
    size_t (*drain)(void *state, const Fill *regions, int count);
    /* `save` copies the particles into columns of the same count. `load` takes `count` particles, at most
       the capacity, in any order; `pose`, `grid` and the method's `settle` must follow. Both return false,
       with nothing done, if memory is short. */
    bool (*save)(void *state, const ParticleColumns *to);
    bool (*load)(void *state, const ParticleColumns *from, size_t count, size_t guarded);
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
