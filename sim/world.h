/* The solver: make a world from a def (sim/def.h), step the world, and read its state.

     Error error = {{0}};
     World *world = world_create(&def, &error);
     while (world && world_step(world, NULL, &error)) ...
     world_read(world, &(ParticleArrays){.position = position});
     world_destroy(world);

   The file begins with ids, scalars and vectors of particles; stages and the clock; forces on box and solids.
   Then come the finger, limits and troubles of a step, figures of a world, and the functions. A function
   that can fail returns false or NULL with a message in `error`. The library prints nothing and never
   exits. */
#ifndef SIM_WORLD_H
#define SIM_WORLD_H

#include "sim/def.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Identity of a particle: its index in the initial state, or the number of particles born before. Ids are
   never reused, so emitters may count beyond 2^32. GPUs have the low 32 bits only. So GPU backends reject
   particles beyond, and views identify particles by these bits. */

typedef uint64_t ParticleId;

/* Upper bounds of ids: so that doubles count ids exactly (WorldNumbers); for GPUs. */
#define PARTICLE_IDS     (UINT64_C(1) << 53)
#define PARTICLE_IDS_GPU (UINT64_C(1) << 31)

/* Scalars and vectors of particles for pictures, slices and snapshots: the only list of names and units. */

/* Scalars of a state, written by each backend. X(ENUM, name, unit) */
#define STATE_SCALAR_LIST(X)                                                                                 \
    X(SPEED, "speed", "m/s")                                                                                 \
    X(DENSITY, "density", "kg/m3")                                                                           \
    X(PRESSURE, "pressure", "Pa")                                                                            \
    X(COMPRESSION, "compression", "")                                                                        \
    X(FLUID, "fluid", "")                                                                                    \
    X(ID, "id", "")

/* Components of saved columns of some methods or terms: NAME, or adjacent NAME_x, NAME_y and NAME_z. A
   state has the scalars of its scene's columns; a test compares names and units with the column rows.
   X(ENUM, name, unit) */
#define OWN_SCALAR_LIST(X)                                                                                   \
    X(RATE, "rate", "1/s")                                                                                   \
    X(BOUNDARY_PART, "boundary_part", "")                                                                    \
    X(BOUNDARY_RATE, "boundary_rate", "1/s")                                                                 \
    X(BOUNDARY_MEAN, "boundary_mean", "")                                                                    \
    X(KEPT_TERM, "kept_term", "Pa")                                                                          \
    X(TERM, "term", "Pa")                                                                                    \
    X(BEFORE, "before", "")                                                                                  \
    X(FRICTION_BEFORE_X, "friction_before_x", "m/s2")                                                        \
    X(FRICTION_BEFORE_Y, "friction_before_y", "m/s2")                                                        \
    X(FRICTION_BEFORE_Z, "friction_before_z", "m/s2")                                                        \
    X(FRICTION_LEFT_X, "friction_left_x", "m/s")                                                             \
    X(FRICTION_LEFT_Y, "friction_left_y", "m/s")                                                             \
    X(FRICTION_LEFT_Z, "friction_left_z", "m/s")                                                             \
    X(ACCELERATION_X, "acceleration_x", "m/s2")                                                              \
    X(ACCELERATION_Y, "acceleration_y", "m/s2")                                                              \
    X(ACCELERATION_Z, "acceleration_z", "m/s2")

/* Of some backends alone (`scalars` of Backend), in no file. `lost`: 1 of a particle without a place in
   the grid of backend fragment, else 0. X(ENUM, name, unit) */
#define BACKEND_SCALAR_LIST(X) X(LOST, "lost", "")

/* Numbers of files of other programs, under names of their own (app/files/foreign). X(ENUM, name, unit) */
#define FILE_SCALAR_LIST(X)                                                                                  \
    X(COLUMN_1, "column_1", "")                                                                              \
    X(COLUMN_2, "column_2", "")                                                                              \
    X(COLUMN_3, "column_3", "")                                                                              \
    X(COLUMN_4, "column_4", "")

/* In every state, but not as a column: sim/state.h. X(ENUM, name, unit) */
#define BIRTH_SCALAR_LIST(X) X(BORN, "born", "s")

/* Derived by pictures from a state, of any backend or file: render/derived has a formula for each. */
#define DERIVED_SCALAR_LIST(X)                                                                               \
    X(VELOCITY_X, "velocity_x", "m/s")                                                                       \
    X(VELOCITY_Y, "velocity_y", "m/s")                                                                       \
    X(VELOCITY_Z, "velocity_z", "m/s")                                                                       \
    X(ACCELERATION, "acceleration", "m/s2")                                                                  \
    X(KINETIC_ENERGY, "kinetic_energy", "J/m3")                                                              \
    X(VORTICITY, "vorticity", "1/s")                                                                         \
    X(VORTICITY_X, "vorticity_x", "1/s")                                                                     \
    X(VORTICITY_Y, "vorticity_y", "1/s")                                                                     \
    X(VORTICITY_Z, "vorticity_z", "1/s")                                                                     \
    X(DIVERGENCE, "divergence", "1/s")                                                                       \
    X(STRAIN_RATE, "strain_rate", "1/s")                                                                     \
    X(EDDY_VISCOSITY, "eddy_viscosity", "m2/s")                                                              \
    X(TRAPPED_AIR, "trapped_air", "m/s")                                                                     \
    X(PRESSURE_GRADIENT, "pressure_gradient", "Pa/m")                                                        \
    X(PRESSURE_GRADIENT_X, "pressure_gradient_x", "Pa/m")                                                    \
    X(PRESSURE_GRADIENT_Y, "pressure_gradient_y", "Pa/m")                                                    \
    X(PRESSURE_GRADIENT_Z, "pressure_gradient_z", "Pa/m")                                                    \
    X(NEIGHBOURS, "neighbours", "")                                                                          \
    X(AGE, "age", "s")

#define SCALAR_LIST(X)                                                                                       \
    STATE_SCALAR_LIST(X)                                                                                     \
    OWN_SCALAR_LIST(X)                                                                                       \
    BACKEND_SCALAR_LIST(X)                                                                                   \
    FILE_SCALAR_LIST(X)                                                                                      \
    BIRTH_SCALAR_LIST(X)                                                                                     \
    DERIVED_SCALAR_LIST(X)

typedef enum Scalar {
#define X(NAME, name, unit) SCALAR_##NAME,
    SCALAR_LIST(X)
#undef X
        SCALAR_COUNT
} Scalar;

/* Order: scalars of a state, then OWN_SCALAR_LIST, BACKEND_SCALAR_LIST, FILE_SCALAR_LIST, the birth time. */
enum { SCALAR_OWN = SCALAR_ID + 1, SCALAR_OWN_END = SCALAR_LOST, SCALAR_STATE_COUNT = SCALAR_BORN + 1 };

/* In the order of Scalar, ended by a NULL name. */
typedef struct ScalarRow {
    const char *name, *unit;
} ScalarRow;

extern const ScalarRow scalar_list[];

const char *scalar_name(Scalar scalar);
const char *scalar_unit(Scalar scalar);

/* Vectors in the box's axes. All except the velocity are derived. X(ENUM, name, unit) */
#define VECTOR_LIST(X)                                                                                       \
    X(VELOCITY, "velocity", "m/s")                                                                           \
    X(VORTICITY, "vorticity", "1/s")                                                                         \
    X(PRESSURE_GRADIENT, "pressure_gradient", "Pa/m")                                                        \
    X(BOX_VELOCITY, "box_velocity", "m/s")                                                                   \
    X(FRICTION_BEFORE, "friction_before", "m/s2")                                                            \
    X(ACCELERATION, "acceleration", "m/s2")

typedef enum Vector {
#define X(NAME, name, unit) VECTOR_##NAME,
    VECTOR_LIST(X)
#undef X
        VECTOR_COUNT
} Vector;

/* In the order of Vector, ended by a NULL name. */
extern const ScalarRow vector_list[];

/* Stages: names, and the clock for stages on the CPU. A stage belongs to a part of the program; times are
   summed over a frame, since a frame runs a stage once per substep. sim/gpu/gl.h times GL stages, under
   the same names.

   People read the names in tables and JSON. All methods and views share the names. A new method or view uses
   fitting names, or adds rows here. */

/* X(ENUM, name, part): in the order of a frame */
#define STAGE_LIST(X)                                                                                        \
    X(GRID, "grid", PART_SIM)                                                                                \
    X(DENSITY, "density", PART_SIM)                                                                          \
    X(FORCE, "force", PART_SIM)                                                                              \
    X(SOLVE, "solve", PART_SIM)                                                                              \
    X(INTEGRATE, "integrate", PART_SIM)                                                                      \
    X(UPLOAD, "upload", PART_UPLOAD)                                                                         \
    X(SCALARS, "scalars", PART_RENDER)                                                                       \
    X(SHADOW, "shadow", PART_RENDER)                                                                         \
    X(SOLIDS, "solids", PART_RENDER)                                                                         \
    X(VOXELIZE, "voxelize", PART_RENDER)                                                                     \
    X(RAYCAST, "raycast", PART_RENDER)                                                                       \
    X(VISIBILITY, "visibility", PART_RENDER)                                                                 \
    X(BLEND, "blend", PART_RENDER)                                                                           \
    X(THICKNESS, "thickness", PART_RENDER)                                                                   \
    X(FILTER, "filter", PART_RENDER)                                                                         \
    X(SHADE, "shade", PART_RENDER)                                                                           \
    X(ANTIALIAS, "antialias", PART_RENDER)                                                                   \
    X(FOAM, "foam", PART_RENDER)                                                                             \
    X(BACKDROP, "backdrop", PART_RENDER)                                                                     \
    X(OVERLAY, "overlay", PART_RENDER)

typedef enum StagePart { PART_SIM, PART_UPLOAD, PART_RENDER } StagePart;

typedef enum Stage {
#define X(NAME, name, part) STAGE_##NAME,
    STAGE_LIST(X)
#undef X
        STAGE_COUNT
} Stage;

const char *stage_name(Stage stage);
StagePart stage_part(Stage stage);
const char *part_name(StagePart part);

/* Milliseconds of each stage in a frame; `ran` separates a stage with zero time from a stage not in the
   frame. */
typedef struct StageTimes {
    double ms[STAGE_COUNT];
    bool ran[STAGE_COUNT];
} StageTimes;

/* The CPU clock; zero-initialise. A NULL clock measures nothing and costs nothing. */
typedef struct StageClock {
    StageTimes frame; /* of the current frame; the owner clears it between frames */
    double began_ms;  /* begin of the running stage; stages do not nest */
    void *gpu;        /* the clock of a GPU; if not NULL, gpu_begin and gpu_end are called instead:
                         sim/gpu/gl.h */
    void (*gpu_begin)(void *gpu);
    void (*gpu_end)(void *gpu, Stage stage);
} StageClock;

void stage_begin(StageClock *clock);
void stage_end(StageClock *clock, Stage stage);

/* STAGE(clock, STAGE_GRID) statement; */
#define STAGE(clock, stage)                                                                                  \
    for (int stage_once = (stage_begin(clock), 1); stage_once; stage_once = (stage_end(clock, stage), 0))

/* Monotonic wall time in milliseconds. */
double wall_ms(void);

/* Forces of the fluid on the box and on each solid, summed over steps, on request (world_enable_forces).
   Without a request there is no cost. */

/* In the box's axes. Summed over time: N s and N m s; as a mean: N and N m. */
typedef struct Push {
    double force[3], torque[3]; /* the torque about the box's origin; for a solid about the solid's own
                                   origin */
} Push;

/* The box's push is the whole push of the fluid, without that on solids: on walls, and by guards. Emitters
   and drains do not count. A solid's push is the reaction to the push of the solid's boundary particles on
   fluid: pressure and explicit friction. Implicit friction counts in the box's push. */
typedef struct Forces {
    double seconds; /* summed time */
    Push box, solid[SOLIDS_MAX];
} Forces;

/* Adds `times` push to `to`. */
void push_add(Push *to, double times, const Push *push);

/* Adds a force (N) at x, m from the point of the torque. */
static inline void push_at(Push *push, const double x[3], const double force[3])
{
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        push->force[k] += force[k];
        push->torque[k] += x[next] * force[last] - x[last] * force[next];
    }
}

/* Moves the torque to another point, at `to` (m) from the old point. */
void push_about(Push *push, const double to[3]);

/* Adds sums to sums. */
void forces_add(Forces *to, const Forces *sum);

/* Adds a mean over some time to sums. */
void forces_add_mean(Forces *to, const Forces *mean);

/* Turns sums into means over the summed time; all 0 without time. */
void forces_mean(Forces *forces);

/* A user's finger in the fluid: stirs, pulls or pushes in a ball around a point, or pours fluid from a disk
   (sim/step/world_flow.c). The point follows the user's input in simulated time; without a finger there is
   no pass and no branch.

   With q = |x - point| / radius and w = (1 - q^2)^2 inside, 0 outside, over a step of dt:
     stir: v += (1 - exp(-strength w dt)) (V - v), exact for a fixed w, so never overshoots.
     Pull, push: v -+= strength dt w q / max(w q) along x - point, so that the centre feels nothing. */

typedef enum FingerWay {
    FINGER_NONE,
    FINGER_STIR,
    FINGER_PULL,
    FINGER_PUSH,
    FINGER_POUR, /* pours the first fluid; the next numbers pour further fluids */
    FINGER_WAYS
} FingerWay;

enum { FINGER_FLUIDS = 8 };

/* The user's input. Doubles only, as in all of the saved state. */
typedef struct Finger {
    double way;      /* a FingerWay; for pouring FINGER_POUR plus the number of the fluid */
    double at[3];    /* box's frame, m */
    double radius;   /* of the ball or disk, m */
    double strength; /* stir: 1/s; pull, push: greatest acceleration of a particle, m/s2; pour: speed, m/s */
} Finger;

/* Zero: no finger. */
typedef struct FingerState {
    Finger wanted;
    double point[3]; /* present position, box's frame, m */
} FingerState;

/* The finger in a step. Zero: no effect on present fluid. */
typedef struct FingerStep {
    bool on;
    float at[3], velocity[3];      /* at the middle of the step, m; of the point, m/s */
    float radius, inverse_radius2; /* m, 1/m2 */
    float grip;                    /* stir: strength dt */
    float kick;                    /* pull, push: velocity gain per metre from the point at w = 1, 1/s */
} FingerStep;

/* Bounds of a step's effect on a particle. */
typedef struct FingerLimits {
    double speed; /* of the point, m/s: the sentinel treats faster particles as trouble */
    double gain;  /* by pull and push in a step, m/s */
} FingerLimits;

/* Takes the input; returns false, with nothing changed, if invalid. A new finger starts at its position at
   once; in two dimensions the finger stays in the plane. */
bool finger_take(FingerState *state, const Finger *wanted, int dimensions);

/* True if the numbers of a saved state are a valid finger. */
bool finger_sound(const FingerState *state);

static inline bool finger_on(const FingerState *state)
{
    return state->wanted.way != (double)FINGER_NONE;
}

/* Number of the fluid that a finger pours; -1: does not pour. */
static inline int finger_fluid(const Finger *finger)
{
    return (int)finger->way - FINGER_POUR >= 0 ? (int)finger->way - FINGER_POUR : -1;
}

/* Greatest acceleration of a particle by pull and push, m/s2, as a bound for the step. */
double finger_acceleration(const FingerState *state);

/* Moves the point over `dt` (s). */
void finger_step(FingerState *state, const FingerLimits *limits, double dt, FingerStep *step);

/* 1 - exp(-x), relative error 1e-6, practically 1 from 16 on. Uses only the four basic operations and no
   library, so the bits are the same everywhere. The formula is Padé (2, 2) of x / 32, doubled five times,
   as in shaders/sim/finger.glsl. */
static inline float finger_share(float x)
{
    const float y = (x < 16 ? x : 16) * (1 / 32.0F);
    float share = 12 * y / (12 + 6 * y + y * y);
    for (int k = 0; k < 5; k++)
        share *= 2 - share;
    return share;
}

/* Changes the velocity v of a particle at distance vector `d` from the point. */
static inline void finger_apply(const FingerStep *step, const float d[3], float v[3])
{
    const float q2 = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * step->inverse_radius2;
    if (!(q2 < 1))
        return;
    const float w = (1 - q2) * (1 - q2), share = finger_share(step->grip * w), kick = step->kick * w;
    for (int k = 0; k < 3; k++)
        v[k] += share * (step->velocity[k] - v[k]) + kick * d[k];
}

/* Bounds, state and troubles of a step, and its solvers, as callers of a world read them. */

/* Number of columns that a method may own (sim/state.h). */
enum { COLUMNS_OWN = 46 };

/* X(ENUM, name, help): bounds of a step */
#define STEP_LIMITS(X)                                                                                       \
    X(DT, "dt", "the scene's fixed step")                                                                    \
    X(COURANT, "courant", "number h / (c + greatest speed)")                                                 \
    X(FORCE, "force", "number sqrt(h / greatest acceleration); without sound sqrt(number h / it)")           \
    X(VISCOUS, "viscous", "2 number, at most 0.7, of the longest step that friction stands")                 \
    X(MAX_DT, "max_dt", "the scene's greatest step")                                                         \
    X(GROWTH, "growth", "a tenth more than the step before")                                                 \
    X(PRESSURE, "pressure",                                                                                  \
      "without sound: 0.25 h / sqrt(gravity times depth); in leaps sqrt(0.4 spacing / gravity)")             \
    X(TENSION, "tension", "half of sqrt(density spacing^3 / (2 pi surface tension))")

typedef enum StepLimit {
#define X(NAME, name, help) STEP_LIMIT_##NAME,
    STEP_LIMITS(X)
#undef X
        STEP_LIMIT_COUNT
} StepLimit;

const char *step_limit_name(StepLimit limit);

/* Solvers of a step by number: the method's solvers, then implicit viscosity. */
enum { SOLVES_OF_METHOD = 2, SOLVE_VISCOSITY = SOLVES_OF_METHOD, SOLVES_MAX };

/* An iterating solver of a method (sim/step/substep.h). */
typedef struct MethodSolver {
    const char *name;                   /* for messages: "density"; NULL: no solver with this number */
    const char *tolerance, *iterations; /* paths of the solver's keys */
} MethodSolver;

/* Step state of a world. Doubles only: part of the saved state. */
typedef struct StepState {
    double dt;                  /* of the current or last step, s */
    double wanted;              /* dt before division by `refine` and before fitting to a frame's end, s */
    double limit;               /* a StepLimit: the bound of the step */
    double max_speed;           /* m/s, after the last step */
    double max_acceleration;    /* m/s2, in the last step */
    double frame_left;          /* steps to the end of the frame; -1: the frame begins again */
    double refine;              /* 1, 2, 4, ...: divisor of the step after trouble */
    double tries;               /* halvings not yet taken back */
    double steps_since_trouble; /* steps since the last trouble or relief */
} StepState;

/* Result of an iterating solver in a step. */
typedef struct StepSolve {
    double iterations; /* 0: did not run */
    double mean, most; /* residual left, as measured by the solver: mean over all particles, maximum */
    double tolerance;  /* for the mean */
    bool failed;       /* ended far above the tolerance */
} StepSolve;

/* X(ENUM, words): trouble found by the sentinel */
#define STEP_TROUBLES(X)                                                                                     \
    X(NONE, "")                                                                                              \
    X(SPEED, "a particle moves further than the support radius in one step")                                 \
    X(SOLID, "a solid that floats moves further than the support radius in one step")                        \
    X(DENSITY, "fluid is pressed to more than five times its density")                                       \
    X(ENERGY, "energy grows by a tenth without work done")                                                   \
    X(SOLVE, "a solver does not converge")                                                                   \
    X(MEMORY, "there is no memory for the lists of neighbours")                                              \
    X(LOST, "particles found no place in the grid of backend fragment")

typedef enum StepTrouble {
#define X(NAME, words) STEP_TROUBLE_##NAME,
    STEP_TROUBLES(X)
#undef X
        STEP_TROUBLE_COUNT
} StepTrouble;

const char *step_trouble_words(StepTrouble trouble);

/* Data read from a world: structs filled in by the backends. */

/* The last trouble found. The world then went back to the begin of the frame, with half the step. */
typedef struct WorldTrouble {
    unsigned count; /* total number of times the sentinel went back */
    bool ended;     /* halving did not help, or there is no sentinel: the step failed. Then what, time, solver
                       and left describe the final trouble */
    StepTrouble what;
    double time;                /* time of detection, s */
    double back_to;             /* time of the state after going back, s */
    int tries, retries;         /* halvings in force; allowed halvings */
    const MethodSolver *solver; /* for STEP_TROUBLE_SOLVE: the solver */
    StepSolve left;             /* and its result */
} WorldTrouble;

/* Statistics of the iterating solvers over a world's steps, without steps that ended in trouble. Counts
   from the start or the last load; not in the saved state. */
typedef struct SolveFigures {
    uint64_t steps;                         /* 0, like all below: a method without solvers */
    double iterations_mean, iterations_p95; /* per step, all solvers together; the 95th percentile is exact
                                               to an eighth above 64 */
    double density_error_mean, density_error_max; /* left by the density solver, as fractions: mean over
                                                     steps and particles; maximum over particles and steps */
    bool projects, rubs; /* the method has such solvers: see above; implicit viscosity has a solver: see
                            below */
    double viscosity_iterations_mean, viscosity_residual_mean; /* per step; mean residual left, a fraction */
} SolveFigures;

/* Number of consecutive layers of an emitter without room for any particle that means an obstacle. Fluid
   that leaves as intended makes room for at least every second layer. */
enum { BLOCKED_LAYERS = 20 };

/* Data of a world besides the particles. */
typedef struct WorldInfo {
    double time;                   /* simulated, s */
    uint64_t step;                 /* substeps since the start */
    size_t count, capacity;        /* particles; limit for emitters */
    uint64_t emitted, drained;     /* particles since the start */
    bool full;                     /* emitters wait: the world has its limit of particles */
    uint64_t blocked;              /* gates of emitters without room for BLOCKED_LAYERS consecutive layers */
    int threads;                   /* threads of the backend */
    const char *simd;              /* instruction set of pair sums; NULL: no choice */
    double support_radius;         /* h, m */
    double spacing;                /* m */
    double box_size[3];            /* m */
    BoxState box;                  /* at the state read by world_read */
    BoxState floating[SOLIDS_MAX]; /* poses of floating solids in the box's frame; indexed like the
                                      def's solids */
    BoxTarget hand;                /* the hand's part of the pose, filtered */
    double gravity[3];             /* in the box's frame, m/s2 */
    size_t state_bytes;            /* bytes held by the backend for particles and grid */
    bool touched;                  /* a finger is in the fluid */
    bool within_frame;             /* steps of the frame are left */
    double dt;                     /* of the last step, s */
    StepLimit limit;               /* bound of the step */
    uint64_t limited[STEP_LIMIT_COUNT]; /* steps by bound, since the start */
    WorldTrouble trouble;
    StepSolve solves[SOLVES_MAX]; /* of the last step; 0 without solvers */
    SolveFigures solved;          /* of all steps */
    size_t lost;     /* backend fragment: particles without a place in the grid, in the last known step */
    size_t unlisted; /* backend compute: bytes of neighbour lists beyond the limit of the driver or GPU
                        memory, so that steps take longer; 0: lists in use, or not wanted */
    size_t guarded;  /* number of times the last wall guard held a particle back, since the start */
    double fastest;  /* greatest particle speed at the end of any sound step, on a GPU of any frame, since
                        the start or the last load, m/s */
    double courant;  /* dt (c + greatest speed) / h of the last step, for any bound; on a GPU with the
                        previous frame's speed */
} WorldInfo;

/* Sums over all particles in double, in an order independent of threads. Momenta and energies refer to
   motion in the box's frame; angular momentum is about the box's origin. */
typedef struct WorldSums {
    double mass;                /* kg */
    double momentum[3];         /* kg m/s */
    double momentum_scale;      /* sum |m v| */
    double angular_momentum[3]; /* kg m2/s */
    double angular_scale;       /* sum |m x v| */
    double kinetic_energy;      /* J */
    double centre[3];           /* of mass, m */
    double max_speed;           /* m/s */
    double neighbours_mean;     /* neighbours with r < h, in the grid of the last substep */
} WorldSums;

/* Plotted quantities of a state. The density error is compression above rest density, max(rho / rho0 - 1,
   0) (Bender and Koschier 2015): missing density at a free surface is no error. Energies as in WorldSums;
   the compression energy is the integral of p / rho^2 dm. */
typedef struct WorldGauge {
    double time;                                  /* time of the state, s */
    double density_error_mean, density_error_max; /* fractions of the rest density */
    double kinetic_energy;                        /* J */
    double potential_energy;                      /* in gravity, over the box's origin, J */
    double compression_energy;                    /* J */
    bool total_known; /* the sum is the total energy; false with surface tension, whose energy is unknown */
} WorldGauge;

/* Output arrays of world_read; NULL if not wanted. All arrays hold `count` particles in a common order,
   which changes between steps; `id` identifies particles. Density (calibrated to p = c^2 (rho - rho0)),
   pressure and volume are those used by the last substep, at its middle (at time 0: of the initial state).
   Values carried by particles are at the end of the substep. */
typedef struct ParticleArrays {
    float *position; /* 4 per particle: x y z (box frame, m), volume 1 / number density (m3) */
    float *velocity; /* 4 per particle: x y z (box frame, m/s), 0 */
    float *scalar[SCALAR_STATE_COUNT]; /* 1 per particle; NaN: the state lacks the column */
    uint32_t *fluid;                   /* index into WorldDef.fluids */
    ParticleId *whole_id;              /* particle id */
    uint32_t *id;                      /* the low 32 bits of the id, for views */
    float *own[COLUMNS_OWN];           /* 1 per particle: the method's columns; on a GPU only kept columns */
} ParticleArrays;

/* A world: the state of a fluid in its box, and the time step. The WorldDef names backend and method; both
   come from lists printed by `slosh info`. All functions of a world must be called from a single thread at
   a time. */

typedef struct World World;

/* Creates a world at time 0 with densities and pressures evaluated. Returns NULL with the reason in
   `error`: unknown method or backend, def out of range, or too many particles or cells for the memory. */
World *world_create(const WorldDef *def, Error *error);
void world_destroy(World *world); /* NULL is allowed */

/* True if backend and method exist and support everything that the def names; needs no context.
   world_create also checks. */
bool world_can(const WorldDef *def, Error *error);

/* True if a world of the def can be made here: allocates buffers and compiles shaders, without computing. */
bool world_fits(const WorldDef *def, Error *error);

/* True if the def's backend runs on a GPU. A GL context must then be current for every use of a world of
   the def: the same context from before world_create until after world_destroy. */
bool world_on_gpu(const WorldDef *def);

/* Advances the world to the end of the frame (mode fixed: dt, in `substeps` steps; cfl: a single step).
   Adds stage times to `clock` (NULL: not measured). On trouble the sentinel goes back and halves the step,
   and WorldInfo.trouble describes the trouble. Returns false with a message if `retries` halvings did not
   help: the world then holds the last good state, but without retries an invalid state. */
bool world_step(World *world, StageClock *clock, Error *error);

/* The same for a single step of the frame's `substeps`, for callers that act in between. */
bool world_substep(World *world, StageClock *clock, Error *error);

/* In mode cfl, steps before `time` (s) are shortened so that a state falls on `time`; other modes ignore
   the call. Not in the saved state: call again after a resume. */
void world_stop_at(World *world, double time);

/* True if the present state has no known trouble. A GPU backend otherwise checks only at the begin of the
   next frame, which then goes back. So call this before keeping a state. Waits for the GPU's steps. */
bool world_is_valid(World *world);

/* Sets the hand's target for the box from the next step on. The box follows through the filter, on top of
   the prescribed motion (sim/def.h). The orientation is normalised; a non-finite target is
   ignored. */
void world_set_target(World *world, const BoxTarget *target);

/* Puts the box at the target at once, at rest; the fluid comes along unchanged and feels no force. */
void world_carry_box(World *world, const BoxTarget *target);

/* Makes room for fluid poured by a finger, up to WorldDef.most; nothing to do if the room exists. Takes as
   long as making the world, and replaces *world. Returns false with the reason: the backend cannot add
   particles, or memory is short. */
bool world_make_room(World **world, Error *error);

/* Sets a finger in the fluid from the next step on, or none. Ignores an invalid finger, and a pouring
   finger without room for particles. Poured fluid is limited to 0.3 of the sound speed and to a quarter of
   the support radius per step. */
void world_set_finger(World *world, const Finger *finger);

/* Sets the shut gates of emitters and drains from the next step on: bits of sim/flow/flow.h; unknown
   gates are ignored. An open emitter emits the layers due at its time, as if it had never been shut. */
void world_close_gates(World *world, uint64_t gates);
uint64_t world_closed_gates(const World *world);

/* Takes the live settings from `def`: gravity, viscosities, sound speed, negative pressure, dt, substeps,
   number and max_dt of mode cfl, the hand's limits, live keys of methods. The rest of `def` must be
   unchanged. Takes effect with the next step and belongs to the world's history like a target. Returns
   false with the reason, with nothing changed. */
bool world_change(World *world, const WorldDef *def, Error *error);

/* Reloads the shaders of a GPU backend. Returns false with the reason if a shader is wrong: the old shaders
   stay. */
bool world_reload(World *world, Error *error);

/* Describes the sentinel's finding in a line. */
void world_trouble_words(const WorldTrouble *trouble, char words[160]);

/* Restarts the counts of WorldInfo.solved. */
void world_solved_restart(World *world);

void world_info(const World *world, WorldInfo *info);

void world_sums(World *world, WorldSums *sums);

/* Starts to gather the gauge of the present state: queued after a GPU's steps, without waiting. No effect
   while an earlier gauge is under way. A world that is never asked has no pass and no buffer for the
   gauge. */
void world_gauge_request(World *world);

/* True once per question, as soon as the answer is ready; never waits. On the CPU the answer is ready at
   once. */
bool world_gauge(World *world, WorldGauge *gauge);

/* From now on, steps sum the fluid's forces on box and solids; without this call there is no cost. Returns
   false with the reason: the backend cannot sum forces, or memory is short. */
bool world_enable_forces(World *world, Error *error);

/* From now on, the world keeps the particles' acceleration, as with WorldDef.acceleration. Before the next
   step the acceleration is unknown. No effect if already kept. Returns false with the reason: the backend
   cannot, or memory is short. */
bool world_keep_acceleration(World *world, Error *error);

/* Mean forces since the last call or since world_enable_forces; `seconds` is 0 if there was no step. Steps
   taken back by the sentinel do not count. */
void world_forces(World *world, Forces *forces);

/* Returns false, with unusable arrays, if memory is short. */
bool world_read(World *world, const ParticleArrays *out);

/* A hash of id, position and velocity of every particle in the order of ids, and of pose and motion of
   floating solids. Equal states have equal hashes; 0 if memory is short. */
uint64_t world_hash(World *world);

/* Lists of names, ended by a NULL name. */
typedef struct Named {
    const char *name, *help;
} Named;

/* Defaults of every field except the box, the spacing and the fluids, for scenes without a value. The
   reason for each number is in sim/step/world_start.c. */
WorldDef world_def_default(void);

const Named *world_methods(void);
const Named *world_backends(void);

/* The def's number of threads for backend cpu, to read and set; 0: a thread per processor. */
int *world_threads(const WorldDef *def);

/* Processors of this machine. */
int world_processors(void);

#endif
