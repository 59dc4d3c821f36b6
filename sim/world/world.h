/* A world: the state of a fluid in its box, and the step that carries it on.

   The backend and the method are named in the WorldDef; both stand in one list each, which `slosh info`
   prints. All functions of one world belong to one thread at a time. */
#ifndef SLOSH_WORLD_H
#define SLOSH_WORLD_H

#include "sim/base/error.h"
#include "sim/base/scalar.h"
#include "sim/base/stage.h"
#include "sim/matter/world_def.h"
#include "sim/world/step_control.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct World World;

/* A world at time 0, its densities and pressures evaluated, or NULL with the reason in `error`: an unknown
   method or backend, a def out of range, too many particles or cells for the memory. */
World *world_create(const WorldDef *def, Error *error);
void world_destroy(World *world); /* NULL is allowed */

/* Whether backend and method are there and have all that the def names; needs no context. World_create asks
   too. */
bool world_can(const WorldDef *def, Error *error);

/* Whether the def's backend works on a GPU: a GL context must then be current wherever a world of it is used,
   the same one, from before world_create until after world_destroy. */
bool world_on_gpu(const WorldDef *def);

/* Carries the world one frame on (mode fixed: dt, in `substeps` steps; cfl: one step), or what is left of it;
   stage times go into `clock` (NULL: not measured). On trouble the sentinel goes back and halves the step:
   WorldInfo.trouble. False with a message when that did not help, `retries` times: the world then holds the
   last good state; without retries what it holds is of no use. */
bool world_step(World *world, StageClock *clock, Error *error);

/* The same for one step of the frame's `substeps`: for who wants a say in between. */
bool world_substep(World *world, StageClock *clock, Error *error);

/* In mode cfl the steps before `time` (s) are shortened so that a state falls on it; other modes take no
   notice. No part of the saved state: whoever goes on from one asks again. */
void world_stop_at(World *world, double time);

/* Whether no trouble is known of the present state. A backend on a GPU is else asked at the begin of the next
   frame only, which then goes back: who keeps a state asks before. Waits for its steps. */
bool world_sound(World *world);

/* Where the hand wants the box from the next step on: the box follows through the filter, on top of the
   prescribed motion (sim/box/box_filter.h). The orientation is normalised; one that is not finite is not
   taken.
 */
void world_set_target(World *world, const BoxTarget *target);

/* Puts the box there at once and at rest; the fluid comes along as it is and feels no force. */
void world_carry(World *world, const BoxTarget *target);

/* Takes from `def` what may change while a world lives: gravity, viscosities, sound speed, negative pressure,
   dt, substeps, number and max_dt of mode cfl, the hand's limits; all else must be as it was. It holds from
   the next step on, and is as much a part of the world's history as a target is. False with the reason:
   nothing has changed. */
bool world_change(World *world, const WorldDef *def, Error *error);

/* The last trouble that the sentinel found. The world then went back to the begin of the frame, with half the
   step. */
typedef struct WorldTrouble {
    unsigned count; /* in all */
    StepTrouble what;
    double time;        /* when it was found, s */
    double back_to;     /* the state that it went back to, s */
    int tries, retries; /* halvings in force, and how many there may be */
} WorldTrouble;

/* Reads the shaders of a backend on a GPU again; false with the reason where one is wrong: those before stay.
 */
bool world_reload(World *world, Error *error);

/* What a world is, apart from its particles. */
typedef struct WorldInfo {
    double time;                        /* simulated, s */
    uint64_t step;                      /* substeps since the start */
    size_t count, capacity;             /* particles; as many as emitters may fill it up to */
    uint64_t emitted, drained;          /* of them, since the start */
    bool full;                          /* emitters wait: there are as many as there may be */
    int threads;                        /* that the backend uses */
    double support_radius;              /* h, m */
    double spacing;                     /* m */
    double box_size[3];                 /* m */
    BoxState box;                       /* of the state that world_read reads */
    BoxTarget hand;                     /* the hand's part of its pose, as the filter has it */
    double gravity[3];                  /* in the box's frame, m/s2 */
    size_t state_bytes;                 /* memory that the backend holds for its particles and grid */
    bool within_frame;                  /* steps of the frame are left */
    double dt;                          /* of the last step, s */
    StepLimit limit;                    /* what bounded it */
    uint64_t limited[STEP_LIMIT_COUNT]; /* steps by what bounded them, since the start */
    WorldTrouble trouble;
    size_t lost;    /* backend fragment: particles without a place in its grid, in the last step known */
    size_t guarded; /* times that the last guard of a wall held a particle back, since the start */
    double courant; /* dt (c + greatest speed) / h of the last step, whatever bounded it; on a GPU the speed
                       is that of the frame before */
} WorldInfo;

void world_info(const World *world, WorldInfo *info);

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

void world_sums(World *world, WorldSums *sums);

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

/* Begins to gather the gauge of the present state: behind the steps in a GPU's queue, without waiting.
   Nothing while an earlier one is on its way. A world that is never asked has no pass and no buffer for it.
 */
void world_gauge_ask(World *world);

/* True once for each time that it was asked for, as soon as it has come; never waits. On the CPU at once. */
bool world_gauge(World *world, WorldGauge *gauge);

/* Where world_read writes; NULL where something is not wanted. All arrays hold `count` particles in one
   common order, which changes from step to step; `id` tells who is who. Density (calibrated, so that
   p = c^2 (rho - rho0)), pressure and volume are those that the last substep used, at the middle of it (at
   time 0: those of the initial state); with wcsph those that the particles carry, at its end. */
typedef struct ParticleArrays {
    float *position;             /* 4 a particle: x y z (box frame, m), volume 1 / number density (m3) */
    float *velocity;             /* 4 a particle: x y z (box frame, m/s), 0 */
    float *scalar[SCALAR_COUNT]; /* 1 a particle */
    uint32_t *fluid;             /* index into WorldDef.fluids */
    uint32_t *id;                /* place in the initial state */
} ParticleArrays;

/* False, and nothing of use in the arrays, when memory is short. */
bool world_read(World *world, const ParticleArrays *out);

/* A hash of id, position and velocity of every particle in the order of their ids: equal for equal bits; 0
   when memory is short. */
uint64_t world_hash(World *world);

/* The lists of what there is, ended by a NULL name. */
typedef struct Named {
    const char *name, *help;
} Named;

/* The defaults of every field but the box, the spacing, the fluids: what a scene that says nothing gets. The
   reason for each number stands beside it in world_default.c. */
WorldDef world_def_default(void);

const Named *world_methods(void);
const Named *world_backends(void);

/* Processors, of which threads: 0 uses all. */
int world_processors(void);

#endif
