/* Data read from a world: structs filled in by the backends. */
#ifndef SLOSH_READING_H
#define SLOSH_READING_H

#include "sim/base/particle_id.h"
#include "sim/base/scalar.h"
#include "sim/matter/world_def.h"
#include "sim/world/step_types.h"

#include <stdint.h>

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
enum { BARRED_LAYERS = 20 };

/* Data of a world besides the particles. */
typedef struct WorldInfo {
    double time;                   /* simulated, s */
    uint64_t step;                 /* substeps since the start */
    size_t count, capacity;        /* particles; limit for emitters */
    uint64_t emitted, drained;     /* particles since the start */
    bool full;                     /* emitters wait: the world has its limit of particles */
    uint64_t barred;               /* gates of emitters without room for BARRED_LAYERS consecutive layers */
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

#endif
