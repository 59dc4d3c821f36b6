/* A backend: where the particles live and who computes. One const table of coarse operations a backend;
   nothing here is called per particle. */
#ifndef SLOSH_BACKEND_H
#define SLOSH_BACKEND_H

#include "sim/base/key.h"
#include "sim/box/box_step.h"
#include "sim/matter/flow.h"
#include "sim/matter/solid_step.h"
#include "sim/touch/finger.h"
#include "sim/world/constants.h"
#include "sim/world/method.h"
#include "sim/world/reading.h"
#include "sim/world/step_control.h"

struct BackendMicro;    /* sim/world/micro.h */
struct Iteration;       /* sim/world/iterate.h */
struct Forces;          /* sim/matter/forces.h */
struct ParticleBuffers; /* sim/gl/particle_buffers.h */

/* What of a column's values is above 0. */
typedef struct Excess {
    double mean;    /* over all particles, those below 0 counted as 0; NaN where one is */
    float greatest; /* 0 at least */
} Excess;

typedef struct Backend {
    const char *name, *help;
    const Key *keys; /* of its own settings, ended by a row without a path; NULL: it has none */
    const void *def; /* the struct of these settings with its defaults */
    size_t def_size; /* bytes; at most BACKEND_DEF_SIZE */
    /* Its steps run behind the caller's back in a GL context, current wherever a world of it is used, and
       `watch` is asked once a frame. */
    bool gpu;
    /* Whether it has all that the def names, or the reason; needs no context. NULL: it has all. */
    bool (*can)(const WorldDef *def, Error *error);
    /* The state of `initial->count` particles, with room for `capacity`; NULL with the reason. The constants
       outlive it, the def does not. */
    void *(*create)(const Constants *constants, const WorldDef *def, const InitialState *initial,
                    size_t capacity, Error *error);
    void (*destroy)(void *state);
    /* After constants_change; false with the reason when what its new terms need is not to be had. */
    bool (*adapt)(void *state, Error *error);
    /* After constants_vary: of the constants only the viscosities have changed. NULL: the backend reads them
       there in each pass. */
    void (*vary)(void *state);
    /* Reads its shaders again; false: the shaders of before stay. NULL: it has no shaders. */
    bool (*reload)(void *state, Error *error);
    /* Puts the solids into their poses, one pose a solid. In a world with solids this comes before all else.
     */
    void (*pose)(void *state, const SolidPose *pose);
    /* Around the passes of a step. NULL: nothing is to be done. */
    void (*enter)(void *state);
    void (*leave)(void *state);
    /* Free flight over `step`, then the last guard of walls and solids, which come to their end poses. */
    void (*drift)(void *state, const BoxStep *step);
    /* Sorts the particles by cell; in a cell by id, but on compute only where the def says reproducible. */
    void (*grid)(void *state);
    /* A pass of the method. */
    void (*run)(void *state, const Pass *pass, const PassInput *input);
    /* Of a column of one component, over the fluids' particles, in an order that no thread count changes.
       NULL: it has `iterate`, or runs no method that iterates. */
    Excess (*excess)(void *state, const ColumnDef *column);
    /* The sum of such a column, in the same order. NULL: a backend with `iterate` has its own. */
    double (*sum)(void *state, const ColumnDef *column);
    /* The loop of substep_iterate where the particles are; `solve` has what the solver did in the step
       before, then what it did in this one. NULL: that loop asks for the excess after each iteration. */
    void (*iterate)(void *state, const struct Iteration *iteration, const PassInput *input, StepSolve *solve);
    /* v += (acceleration + gravity) dt. */
    void (*kick)(void *state, const float gravity[3], float dt);
    /* What the kicks since the last call or `load` found; waits for them. */
    StepWatch (*watch)(void *state);
    /* What sim/touch/finger.h says, to all particles of fluids. */
    void (*touch)(void *state, const FingerStep *finger);
    /* Gives the particles in each guide the guide's velocity; the work that takes, J, where `energy` is. */
    double (*guide)(void *state, const Guide *guides, int count);
    void (*sums)(void *state, WorldSums *sums);           /* all members but those that need the box's pose */
    bool (*read)(void *state, const ParticleArrays *out); /* false when memory is short */
    size_t (*held)(const void *state); /* particles that `read` gives; NULL: all of the world's */
    /* Begins to gather what sim/world/gauge.h says, with the gravity in the box's frame, m/s2; false when it
       cannot. Then whether it has come, or, where somebody `waits`, once it has: sums of the gauge, the mean
       divided. */
    bool (*gauge)(void *state, const double gravity[3]);
    bool (*gauged)(void *state, WorldGauge *gauge, bool waits);
    /* For sim/world/energy_watch.h, at once; `second` and `turn` for boxes that turn alone. NULL: it has
       the gauge. */
    void (*energy)(void *state, bool turning, EnergySums *sums);
    /* From now on steps add to `to` what box and solids feel; NULL: no more. False when memory is short.
       NULL: it sums no forces. */
    bool (*feel)(void *state, struct Forces *to, Error *error);
    /* What steps since then have left elsewhere is there; waits for it. False when memory is short. NULL: it
       is. `mark` and `back` have it with the particles. */
    bool (*felt)(void *state);
    /* Between steps: adds those particles of a layer that are in the box and not next to
       others, at most `most`, and returns how many; takes out what is in a region, and returns how many. */
    size_t (*emit)(void *state, const EmitLayer *layer, size_t most);
    size_t (*drain)(void *state, const Fill *regions, int count);
    /* Copies the particles into columns of as many; takes `count` of them, no more than its capacity, in any
       order, whereupon `pose`, `grid` and the method's `settle` must follow. False, and nothing done, when
       memory is short. */
    bool (*save)(void *state, const ParticleColumns *to);
    bool (*load)(void *state, const ParticleColumns *from, size_t count, size_t guarded);
    /* Keeps the particles where they are, on the device, and goes back to those, as `load` does; both NULL:
       by `save` and `load`. */
    bool (*mark)(void *state, Error *error);
    void (*back)(void *state, size_t count, size_t guarded);
    /* The particles in GL buffers of its own, PARTICLE_* of `attributes` among them; they stay until the next
       step or call. NULL: the backend has none. */
    void (*share)(void *state, unsigned attributes, struct ParticleBuffers *out);
    void (*info)(const void *state, WorldInfo *info); /* threads, state_bytes, guarded */
    /* Which of its settings to raise when its grid loses particles, with their values. NULL: it loses none.
     */
    void (*to_raise)(const void *state, char text[128]);
    const struct BackendMicro *micro; /* of `slosh bench --micro`; NULL: its passes cannot run alone */
} Backend;

extern const Backend backend_cpu;

/* Adds one to the list, unless it is there: those that need more than sim has, before the first scene is
   read. It outlives all worlds. Not for several threads at once. */
void backend_add(const Backend *backend);

/* All backends, ended by NULL. */
const Backend *const *backend_list(void);

/* NULL when there is none of that name. */
const Backend *backend_find(const char *name);

/* The backend's own settings in a def; not const, as memchr's result is not. NULL where the backend is not in
   the list. */
void *backend_def(const WorldDef *def, const Backend *backend);

/* Fills in the defaults of all backends' settings. */
void backends_default(WorldDef *def);

#endif
