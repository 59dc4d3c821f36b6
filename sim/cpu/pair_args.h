/* Inputs and outputs of sums over neighbours, the hottest loops. */
#ifndef SLOSH_PAIR_ARGS_H
#define SLOSH_PAIR_ARGS_H

#include "sim/box/box_step.h"
#include "sim/cpu/neighbour_lists.h"
#include "sim/world/cell_rows.h"
#include "sim/world/column.h"

/* Position of the dummy particle that fills up lists, m; its square is finite. */
#define PAST 1e9F

/* Arrays of particles sorted by cell; readable for LANES - 1 entries past the last. */
typedef struct PairArgs {
    const Constants *constants;
    size_t count;  /* particles */
    uint32_t none; /* index of the dummy particle: after the particles and copies */
    const CellFold *fold;
    const uint32_t *cell_start; /* first particle of each place of `fold`; places + 1 */
    const uint32_t *copy_start; /* first copy outside of the box (sim/cpu/copies.c) per place, counted from
                                   `count`; places + 1; NULL: no periodic sides */
    const uint32_t *cell;       /* per particle */
    const uint8_t *foreign;     /* per cell: 1 if its particles are ghosts, without lists; NULL */
    const ParticleId *id;
    const uint8_t *fluid;
    const float *x, *y, *z, *vx, *vy, *vz; /* m, m/s */
    const float (*place)[4];               /* per particle {x, y, z, p V^2}; after the last {PAST, ...} */
    const float (*motion)[4];              /* {vx, vy, vz, V}; after the last 0 */
    NeighbourLists *lists;
    const float *volume;            /* over Constants.unit_volume: set before forces */
    const float *pressure_term;     /* p V^2, Pa: set before forces */
    const float *viscosity;         /* Pa s, per particle; NULL with a single fluid */
    const float *kind;              /* fluid number per particle; NULL if unused */
    const float *tension;           /* Constants.tension per particle; NULL: none; requires `kind` */
    const ApparentGravity *gravity; /* for passes that use gravity */
    float *fx, *fy, *fz;            /* out of forces, N/m3; `fx` also of rates */
    float *number_density;   /* out of densities, times Constants.unit_volume: in the place of `volume` */
    float *own[COLUMNS_OWN]; /* columns of the method */
    float *const *term;      /* columns shared by methods */
} PairArgs;

#endif
