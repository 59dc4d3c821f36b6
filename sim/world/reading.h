/* What is read of a world: structs that its backends fill in. */
#ifndef SLOSH_READING_H
#define SLOSH_READING_H

#include "sim/base/scalar.h"
#include "sim/box/box_filter.h"
#include "sim/matter/energy_sums.h"
#include "sim/world/column.h"
#include "sim/world/step_control.h"
#include "sim/world/step_parts.h"

#include <stdint.h>

/* The last trouble that was found. The world then went back to the begin of the frame, with half the step. */
typedef struct WorldTrouble {
    unsigned count; /* of times that the sentinel went back, in all */
    bool ended; /* it did not help, or there is no sentinel: the step failed. Then what, time, solver, left
                   are of the trouble that ended it */
    StepTrouble what;
    double time;                /* when it was found, s */
    double back_to;             /* time of the state that the world went back to, s */
    int tries, retries;         /* halvings in force, and how many there may be */
    const MethodSolver *solver; /* of STEP_TROUBLE_SOLVE: which one, */
    StepSolve left;             /* and what it came to */
} WorldTrouble;

/* What the solvers that iterate did in a world's steps, those apart that ended in trouble. A world counts
   from its start, or from where it was loaded into; that is no part of the saved state. */
typedef struct SolveFigures {
    uint64_t steps;                         /* 0, and all else: of a method without such solvers */
    double iterations_mean, iterations_p95; /* of a step, all its solvers together; the 95th percentile to an
                                               eighth above 64 */
    double density_error_mean, density_error_max; /* that the solver of density left, fractions: mean over
                                                     steps and particles; of any particle in any step */
    bool projects, rubs; /* there are such of the method's: all above; implicit viscosity has one: */
    double viscosity_iterations_mean, viscosity_residual_mean; /* of a step; that was left, a fraction */
} SolveFigures;

/* So many layers of an emitter in a row without room for one particle: something stands in its way. Fluid
   that leaves as it should makes room for each second one at least. */
enum { BARRED_LAYERS = 20 };

/* What a world is, apart from its particles. */
typedef struct WorldInfo {
    double time;               /* simulated, s */
    uint64_t step;             /* substeps since the start */
    size_t count, capacity;    /* particles; as many as emitters may fill it up to */
    uint64_t emitted, drained; /* of them, since the start */
    bool full;                 /* what would come waits: the world has as many particles as it may have */
    uint64_t barred;           /* gates of emitters that found no room for BARRED_LAYERS layers in a row */
    int threads;               /* in use by the backend */
    const char *simd;          /* the instructions of its pair sums; NULL: it chooses none */
    double support_radius;     /* h, m */
    double spacing;            /* m */
    double box_size[3];        /* m */
    BoxState box;              /* of the state that world_read reads */
    BoxState floating[SOLIDS_MAX];      /* of solids that float, in the box's frame; by the def's solids */
    BoxTarget hand;                     /* the hand's part of its pose, as the filter has it */
    double gravity[3];                  /* in the box's frame, m/s2 */
    size_t state_bytes;                 /* memory that the backend holds for its particles and grid */
    bool touched;                       /* a finger is in the fluid */
    bool within_frame;                  /* steps of the frame are left */
    double dt;                          /* of the last step, s */
    StepLimit limit;                    /* what bounded it */
    uint64_t limited[STEP_LIMIT_COUNT]; /* steps by what bounded them, since the start */
    WorldTrouble trouble;
    StepSolve solves[SOLVES_MAX]; /* of the last step; of a method without solvers all 0 */
    SolveFigures solved;          /* of all steps */
    size_t lost;     /* backend fragment: particles without a place in its grid, in the last step known */
    size_t unlisted; /* backend compute: bytes of lists of neighbours that are more than the driver or its
                        memory allows, so that steps take longer; 0: it has them, or is not to have them */
    size_t guarded;  /* times that the last guard of a wall held a particle back, since the start */
    double fastest;  /* greatest speed of a particle at the end of any step that is sound, on a GPU of any
                        frame, since  the start or since it was loaded into, m/s */
    double courant;  /* dt (c + greatest speed) / h of the last step, whatever bounded it; on a GPU the speed
                        is that of the frame before */
} WorldInfo;

/* Reductions over all particles, in double, in an order that no thread count changes. Momenta and energies
   are those of the motion in the box's frame; angular momentum about the box's origin. */
typedef struct WorldSums {
    double mass;                /* kg */
    double momentum[3];         /* kg m/s */
    double momentum_scale;      /* sum |m v| */
    double angular_momentum[3]; /* kg m2/s */
    double angular_scale;       /* sum |m x v| */
    double kinetic_energy;      /* J */
    double centre[3];           /* of mass, m */
    double max_speed;           /* m/s */
    double neighbours_mean;     /* others with r < h, of those that the grid of the last substep shows */
} WorldSums;

/* What is plotted of a state while the world runs. The error of density is how far particles are pressed
   above the rest density, rho / rho0 - 1 where that is more than 0 (Bender and Koschier 2015): what a
   particle at a free surface lacks is no error. Energies as in WorldSums; that of compression is the integral
   of p / rho^2 dm. */
typedef struct WorldGauge {
    double time;                                  /* of that state, s */
    double density_error_mean, density_error_max; /* fractions of the rest density */
    double kinetic_energy;                        /* J */
    double potential_energy;                      /* in gravity, over the box's origin, J */
    double compression_energy;                    /* J */
    bool total_known; /* their sum is all of the energy; false with surface tension, whose is not known */
} WorldGauge;

/* Where world_read writes; NULL where something is not wanted. All arrays hold `count` particles in one
   common order, which changes from step to step; `id` tells who is who. Density (calibrated, so that
   p = c^2 (rho - rho0)), pressure and volume are those that the last substep used, at the middle of it (at
   time 0: those of the initial state); those that the particles carry, where they do, at its end. */
typedef struct ParticleArrays {
    float *position; /* 4 a particle: x y z (box frame, m), volume 1 / number density (m3) */
    float *velocity; /* 4 a particle: x y z (box frame, m/s), 0 */
    float *scalar[SCALAR_STATE_COUNT]; /* 1 a particle; NaN: a column that the state has not */
    uint32_t *fluid;                   /* index into WorldDef.fluids */
    ParticleId *whole_id;              /* who it is */
    uint32_t *id;                      /* the last 32 bits of it, for views */
    float *own[COLUMNS_OWN]; /* 1 a particle: the method's own columns; on a GPU those that are kept */
} ParticleArrays;

#endif
