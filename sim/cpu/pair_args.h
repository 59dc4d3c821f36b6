/* What the sums over neighbours read and write: the loops where the time goes. */
#ifndef SLOSH_PAIR_ARGS_H
#define SLOSH_PAIR_ARGS_H

#include "sim/box/box_step.h"
#include "sim/cpu/neighbour_lists.h"
#include "sim/world/cell_rows.h"
#include "sim/world/column.h"

/* Where the one stands whom lists are filled up with, m: its square is finite. */
#define PAST 1e9F

/* Arrays of particles sorted by cell; readable for LANES - 1 entries past the last. */
typedef struct PairArgs {
    const Constants *constants;
    size_t count;  /* particles */
    uint32_t none; /* whom lists are filled up with: behind the particles and their copies */
    const CellFold *fold;
    const uint32_t *cell_start; /* first particle of each place of `fold`; places + 1 */
    const uint32_t *copy_start; /* first copy of those outside of the box (sim/cpu/copies.c), `count` not
                                   counted; places + 1; NULL: no sides are periodic */
    const uint32_t *cell;       /* of each particle */
    const uint8_t *foreign; /* of each cell: 1 where its particles are ghosts, which have no lists; NULL */
    const ParticleId *id;
    const uint8_t *fluid;
    const float *x, *y, *z, *vx, *vy, *vz; /* m, m/s */
    const float (*place)[4];               /* of each {x, y, z, p V^2}, and behind the last {PAST, ...} */
    const float (*motion)[4];              /* {vx, vy, vz, V}, and behind the last 0 */
    NeighbourLists *lists;
    const float *volume;            /* over Constants.unit_volume: set before forces */
    const float *pressure_term;     /* p V^2, Pa: set before forces */
    const float *viscosity;         /* Pa s, of each particle; NULL with one fluid */
    const float *kind;              /* the fluid of each as a number; NULL where none asks */
    const float *tension;           /* Constants.tension of each; NULL: none; with `kind` */
    const ApparentGravity *gravity; /* of passes that have it */
    float *fx, *fy, *fz;            /* out of forces, N/m3; `fx` also of rates */
    float *number_density;   /* out of densities, times Constants.unit_volume: in the place of `volume` */
    float *own[COLUMNS_OWN]; /* of the method */
    float *const *term;      /* of what methods share */
} PairArgs;

#endif
