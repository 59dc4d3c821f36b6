/* What a def means in numbers: computed once, constant while a world lives but for viscosities over time;
 * every backend reads it. */
#ifndef SLOSH_CONSTANTS_H
#define SLOSH_CONSTANTS_H

#include "sim/base/error.h"
#include "sim/box/periodic.h"
#include "sim/box/wall.h"
#include "sim/box/wall_drag.h"
#include "sim/kernel/lattice.h"
#include "sim/matter/boundary.h"
#include "sim/matter/tension.h"
#include "sim/matter/viscosity.h"
#include "sim/matter/world_def.h"
#include "sim/world/column.h"
#include "sim/world/step_control.h"
#include "sim/world/step_parts.h"

struct Method; /* sim/world/method.h */

/* Bytes for the struct that a method makes of its settings. */
enum { METHOD_CONSTANTS_SIZE = 256 };

/* The grid of cells of side h: cell (i, j, k) holds floor(x / h) = first + (i, j, k), of one global lattice
   whatever the box; one empty layer on each side saves the neighbour search its bounds (along a
   periodic axis backend cpu has copies there: sim/cpu/copies.c). Along a periodic axis
   a whole number of cells, of side h at least, fills the box from its low side on. */
typedef struct CellGrid {
    float origin[3], inverse[3]; /* floor((x - origin) * inverse); m, 1/m */
    int first[3];
    int size[3]; /* the empty layers included; x runs fastest */
    size_t count;
} CellGrid;

/* Friction at the end of a step, where the def says so: sim/viscosity. */
typedef struct ImplicitViscosity {
    bool named;         /* the def says so, */
    bool on;            /* and some fluid is viscous */
    ShapeKernel kernel; /* the method's where pair loops have it (sim/cpu/pair_shape.h) */
    float scale;      /* R F U over f(r / h), where a pair's force is V_i V_j (mu_i + mu_j) R F (v_ji . x_ij)
                         x_ij, 1/m4 */
    double tolerance; /* of the mean */
    int most;         /* iterations */
} ImplicitViscosity;

typedef struct Constants {
    const struct Method *method;
    /* u, m, the power of two at or next below the spacing, and U = u^dimensions. All that grows with the
       volume of fluid is in units of U, or powers of the spacing leave the range of floats: number densities
       and kernels (times U), volumes, masses and forces (over U). What leaves the solver is in SI units. */
    double unit, unit_volume;
    float support_radius;      /* h, m */
    float rest_number_density; /* n0 U */
    float kernel_scale;        /* its value at r = 0 times U, calibrated */
    float pressure_scale;      /* -dW_spiky/dr U = pressure_scale * (1 - r/h)^2, 1/m, calibrated */
    float viscosity_scale;     /* Laplacian U = viscosity_scale * (1 - r/h), 1/m2, calibrated */
    float spacing;             /* m */
    int fluid_count;
    float mass[FLUIDS_MAX];      /* of a particle over U: rho0 / (n0 U), kg/m3 */
    float density[FLUIDS_MAX];   /* rho0, kg/m3 */
    float stiffness[FLUIDS_MAX]; /* p = stiffness * (n / n0 - 1): c^2 rho0 stiffness_scale, Pa */
    float stiffness_scale;       /* relative change of density over that of n / n0, see Lattice */
    float viscosity[FLUIDS_MAX]; /* step_viscosity, Pa s; of the step in hand where it varies */
    bool holds;                  /* a fluid names a viscosity: what has no slip holds it */
    bool viscous;                /* something rubs, now or ever, */
    bool rubs;                   /* and forces have its friction; else sim/viscosity has */
    bool varies;                 /* some mu is a table over time */
    bool negative_pressure;
    bool reproducible;
    float sound_speed;          /* m/s */
    TensionModel tension_model; /* none where no fluid has a tension */
    float tension[FLUIDS_MAX];  /* sigma, N/m; of cohesion times its scale for pairs in units of u, N/m3; of
                                   curvature N m over U */
    CurvatureScale curvature;   /* of the model of that name */
    float wet[FLUIDS_MAX];      /* wetting_curvature, 1/m */
    float colour;               /* colour_scale for sums in units of u, 1/m2 */
    CellGrid cells;
    Periodic periodic;
    int first_row, last_row; /* of the nine rows of cells that hold neighbours: 0 to 9, in 2D 3 to 6 */
    Lattice lattice;
    Walls walls;
    StepFriction friction;
    ImplicitViscosity implicit;
    bool no_slip;          /* walls hold fluid: the def says so and some fluid is viscous */
    bool lid;              /* and the one at the top moves, */
    float lid_velocity[3]; /* so, m/s */
    WallDrag drag;         /* made once `no_slip` is first true */
    int dimensions;
    bool emits, drains; /* fluid may come; go */
    bool accelerations; /* are kept: sim/change */
    bool wide;          /* what rounding leaves of places is: columns_wide */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    Boundary boundary; /* of the solids */
    /* The method's own struct: on a GPU also the uniform block METHOD_BLOCK of its shaders. */
    _Alignas(16) unsigned char of_method[METHOD_CONSTANTS_SIZE];
} Constants;

/* False with the reason: a def out of range, too many cells, no memory. */
bool constants_create(Constants *constants, const WorldDef *def, Error *error);
/* Takes what of the def may change while a world lives (sim/world/live.h). False with the reason, no memory
   among them: nothing has changed. */
bool constants_change(Constants *constants, const WorldDef *def, Error *error);

/* Takes the viscosities of the def, which differ from those before by the time alone; true where one does. */
bool constants_vary(Constants *constants, const WorldDef *def);

void constants_destroy(Constants *constants);

/* Of a particle, kg. */
static inline double constants_mass(const Constants *constants, int fluid)
{
    return (double)constants->mass[fluid] * constants->unit_volume;
}

#endif
