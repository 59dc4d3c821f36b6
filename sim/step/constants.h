/* The def in numbers: computed once, constant while a world lives except for time-dependent viscosities;
   read by every backend. */
#ifndef SIM_STEP_CONSTANTS_H
#define SIM_STEP_CONSTANTS_H

#include "sim/box/walls.h"
#include "sim/def/fluids.h"
#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"
#include "sim/step/step_control.h"
#include "slosh/def.h"
#include "slosh/error.h"
#include "slosh/state.h"
#include "slosh/world.h"

struct Method; /* sim/step/method.h */

/* Bytes for the struct that a method derives from its settings. */
enum { METHOD_CONSTANTS_SIZE = 256 };

/* The grid of cells with side h. Cell (i, j, k) holds floor(x / h) = first + (i, j, k), on a global lattice
   independent of the box. An empty layer on each side saves bounds checks in the neighbour search; along a
   periodic axis, backend cpu has copies there (sim/cpu/boundary.c). Along a periodic axis, an integer number
   of cells, with side h or more, fills the box from its low side. */
typedef struct CellGrid {
    float origin[3], inverse[3]; /* floor((x - origin) * inverse); m, 1/m */
    int first[3];
    int size[3]; /* with the empty layers; x runs fastest */
    size_t count;
} CellGrid;

/* Friction at the end of a step, if chosen in the def: sim/viscosity. */
typedef struct ImplicitViscosity {
    bool named;         /* chosen in the def */
    bool on;            /* and some fluid is viscous */
    ShapeKernel kernel; /* the method's kernel if pair loops have it (sim/cpu/pair_loop.h) */
    float scale;        /* R F U / f(r / h); a pair's force is V_i V_j (mu_i + mu_j) R F (v_ji . x_ij) x_ij,
                           1/m4 */
    double tolerance;   /* for the mean residual */
    int most;           /* iterations */
} ImplicitViscosity;

typedef struct Constants {
    const struct Method *method;
    /* u, m, the power of two at or below the spacing, and U = u^dimensions. Quantities that grow with fluid
       volume are in units of U; otherwise powers of the spacing leave the range of floats. Number densities
       and kernels are times U; volumes, masses and forces are over U. Results of the solver are in SI
       units. */
    double unit, unit_volume;
    float support_radius;      /* h, m */
    float rest_number_density; /* n0 U */
    float kernel_scale;        /* kernel value at r = 0 times U, calibrated */
    float pressure_scale;      /* -dW_spiky/dr U = pressure_scale * (1 - r/h)^2, 1/m, calibrated */
    float viscosity_scale;     /* Laplacian U = viscosity_scale * (1 - r/h), 1/m2, calibrated */
    float spacing;             /* m */
    int fluid_count;
    float mass[FLUIDS_MAX];      /* particle mass over U: rho0 / (n0 U), kg/m3 */
    float density[FLUIDS_MAX];   /* rho0, kg/m3 */
    float stiffness[FLUIDS_MAX]; /* p = stiffness * (n / n0 - 1): c^2 rho0 stiffness_scale, Pa */
    float stiffness_scale;       /* relative change of density over that of n / n0, see Lattice */
    float viscosity[FLUIDS_MAX]; /* step_viscosity, Pa s; of the current step if time-dependent */
    bool holds;                  /* a fluid names a viscosity, so no-slip surfaces hold the fluid */
    bool viscous;                /* some fluid has friction, now or later */
    bool rubs;                   /* forces include the friction; otherwise sim/methods/shared/viscosity.h */
    bool varies;                 /* some viscosity is a table over time */
    bool negative_pressure;
    bool reproducible;
    float sound_speed;          /* m/s */
    TensionModel tension_model; /* none if no fluid has surface tension */
    float tension[FLUIDS_MAX];  /* sigma, N/m; for cohesion times its scale for pairs in units of u, N/m3;
                                   for curvature N m over U */
    CurvatureScale curvature;   /* for the curvature model */
    float wet[FLUIDS_MAX];      /* wetting_curvature, 1/m */
    float colour;               /* colour_scale for sums in units of u, 1/m2 */
    CellGrid cells;
    Periodic periodic;
    int first_row, last_row; /* of the nine rows of neighbour cells: 0 to 9, in 2D 3 to 6 */
    Lattice lattice;
    Walls walls;
    StepFriction friction;
    ImplicitViscosity implicit;
    bool no_slip;          /* walls hold fluid: set in the def and some fluid is viscous */
    bool lid;              /* and the top wall moves */
    float lid_velocity[3]; /* m/s */
    WallDrag drag;         /* created when `no_slip` first becomes true */
    int dimensions;
    bool emits, drains; /* fluid may be emitted; drained */
    bool accelerations; /* kept for output: sim/methods/shared/acceleration.h */
    bool wide;          /* remainders of positions are kept: columns_wide */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    Boundary boundary; /* of the solids */
    /* The method's struct; on a GPU also the uniform block METHOD_BLOCK of the method's shaders. */
    _Alignas(16) unsigned char of_method[METHOD_CONSTANTS_SIZE];
} Constants;

/* Returns false with the reason: def out of range, too many cells, or memory short. */
bool constants_create(Constants *constants, const WorldDef *def, Error *error);
/* Takes the live settings of the def (include/slosh/state.h). Returns false with the reason, for example
   short memory, with nothing changed. */
bool constants_change(Constants *constants, const WorldDef *def, Error *error);

/* Takes the def's viscosities, which have changed with time only; true if some viscosity changed. */
bool constants_vary(Constants *constants, const WorldDef *def);

void constants_destroy(Constants *constants);

/* Mass of a particle, kg. */
static inline double constants_mass(const Constants *constants, int fluid)
{
    return (double)constants->mass[fluid] * constants->unit_volume;
}

#endif
