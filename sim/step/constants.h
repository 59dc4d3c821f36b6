/* The numbers of a world: bounds of the step size, and the def in numbers. */
#ifndef SIM_STEP_CONSTANTS_H
#define SIM_STEP_CONSTANTS_H

#include "sim/box/box.h"
#include "sim/def.h"
#include "sim/def/fluids.h"
#include "sim/error.h"
#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"
#include "sim/state.h"
#include "sim/world.h"

#include <stdbool.h>

/* Bounds of the step size, and causes of trouble after too large a step. Pure functions. */

/* A solver is in trouble if its final residual exceeds the tolerance by this factor. */
#define STEP_SOLVE_STANDS 10

/* Findings of a substep, over all particles. */
typedef struct StepWatch {
    bool bounded;            /* no particle moves further than the support radius in the step, and none is
                                NaN */
    bool memory;             /* memory was short: some neighbours are missing */
    float max_speed;         /* m/s */
    float max_acceleration;  /* m/s2, with gravity */
    float max_density_ratio; /* number density over rest number density */
    size_t lost, lost_limit; /* particles without a place in the grid, most in a step; limit for trouble */
} StepWatch;

/* Without a `sentinel`, only trouble that prevents further steps. */
StepTrouble step_trouble_of(const StepWatch *watch, bool sentinel);

/* Friction of a def's method. Takes some milliseconds: call once per world. */
StepFriction step_friction(const WorldDef *def);

/* Greatest over least density of a def's fluids. */
double density_ratio(const WorldDef *def);

/* The sound speed that bounds a step, m/s; 0 without sound. */
double step_sound(const WorldDef *def);

/* Kinematic viscosity equivalent to an artificial viscosity, alpha c h / 4, m2/s. */
double artificial_kinematic(const WorldDef *def, double alpha);

/* The laminar viscosity with the same work in a shear: alpha c h / (4 (d + 2)), m2/s (Monaghan 2005). */
double numerical_kinematic(const WorldDef *def, double alpha);

/* The remaining alpha for fluid f: all of alpha without a viscosity, 0 from the equivalent viscosity of
   alpha on. */
double step_alpha(const WorldDef *def, double alpha, int f);

/* Viscosity between pairs of fluid f, Pa s: the present viscosity, or the method's numerical viscosity if
   greater. */
double step_viscosity(const WorldDef *def, const StepFriction *friction, int f);

/* The longest stable step for friction on the lattice at rest, s: longer steps amplify velocity
   differences. Uses the def's present viscosities; a pair of fluids counts with half of pair_viscosity,
   over the lighter fluid's density. INFINITY without friction. */
double step_viscous(const WorldDef *def, const StepFriction *friction);

/* The longest stable step for sound, in h / c: 2 / omega of the stiffest wave on the lattice; omega is 2.0
   to 2.6 c / h by kernel and support. With summed density, which has no damping, steps above
   STEP_SOUND_CALM heat fluid without friction: docs/labbook/failures.md. */
#define STEP_SOUND_STANDS 0.9
#define STEP_SOUND_CALM   0.5
double step_sound_calm(const WorldDef *def); /* by the stiffness of the kernel */

/* The longest stable step for the pressure of fluid at rest, s, for a method without sound; INFINITY for
   methods with sound. A method that leaps parts particles again in each step after a fall of g dt^2. Above
   half a spacing of fall a column reads 1.3 to 1.8 times its weight and boils (2D, 20 and 36 layers). With
   other methods multipliers belong to the middle of a step. At p / rho = g times depth, positions boil from
   0.3 h / sqrt(g depth) on in 3D (0.43 in 2D), at any tolerance; later with implicit friction as damping.
   Depth is the greatest fall. h counts up to a twentieth beyond the last shell of the lattice's neighbours.
   For a box at rest: world_step.c shortens the limit by the box's prescribed acceleration. */
double step_pressure(const WorldDef *def);
#define STEP_PRESSURE_STANDS 0.25
#define STEP_FALL_STANDS     0.4 /* spacings */

/* The longest step to resolve surface tension, s: J. U. Brackbill, D. B. Kothe, C. Zemach, "A continuum
   method for modeling surface tension", 1992, eq. 61, for the fluid with the tightest bound. A wave of two
   spacings is stable up to 1.8 times this step, and a drop with cohesion and without sound up to 1.3 to 2.7
   times. A third of this step holds with methods that move particles by tension before parting them
   (docs/labbook/failures.md). INFINITY without tension. */
double step_tension(const WorldDef *def);
#define STEP_TENSION_STANDS 0.5
#define STEP_TENSION_LEAPS  (STEP_TENSION_STANDS / 3)

/* Share of step_viscous at which disordered fluid is stable. Measured shares are 0.8 to 1.1, and 0.6 with
   carried density in 3D at supports below 3, stirred hard (docs/labbook/failures.md). */
#define STEP_VISCOUS_STANDS 0.7

/* Describes the bound of a step of `dt` s in which a world blew up, at the greatest speed before (m/s), and
   the change to make: words for an error. */
void step_advice(const WorldDef *def, const StepFriction *friction, StepTrouble trouble, double dt,
                 double max_speed, char words[200]);

/* The adaptive step (mode cfl; Monaghan, "Smoothed particle hydrodynamics", 1992, eq. 10.1 f.): the least
   limit at the speed and acceleration of the last step. The result is never much longer than the last step
   (`before`, s; 0: none), so that the effects of a blow have time to show. */
double step_cfl(const WorldDef *def, const StepFriction *friction, double max_speed, double max_acceleration,
                double before, StepLimit *binding);

/* The step of at most `dt` that reaches `left` (s) in an integer number of equal steps, if four or fewer
   suffice. This avoids a tiny last step, after which steps would have to grow again. Otherwise returns
   `dt`. */
double step_towards(double dt, double left);

/* The def in numbers: computed once, constant while a world lives except for time-dependent viscosities;
   read by every backend. */

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
    float pressure_scale;      /* of the pressure force by a summed density: set by the method */
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
    bool rubs;                   /* forces include the friction; otherwise sim/methods/shared/terms.h */
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
    WallLift lift; /* of images with the pressure of the fluid */
    StepFriction friction;
    ImplicitViscosity implicit;
    bool no_slip;          /* walls hold fluid: set in the def and some fluid is viscous */
    bool lid;              /* and the top wall moves */
    float lid_velocity[3]; /* m/s */
    WallDrag drag;         /* created when `no_slip` first becomes true */
    int dimensions;
    bool emits, drains; /* fluid may be emitted; drained */
    bool accelerations; /* kept for output: sim/methods/shared/terms.h */
    bool wide;          /* remainders of positions are kept: columns_wide */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    Boundary boundary; /* of the solids */
    /* The method's struct; on a GPU also the uniform block METHOD_BLOCK of the method's shaders. */
    _Alignas(16) unsigned char of_method[METHOD_CONSTANTS_SIZE];
} Constants;

/* Returns false with the reason: def out of range, too many cells, or memory short. */
bool constants_create(Constants *constants, const WorldDef *def, Error *error);
/* Takes the live settings of the def (sim/state.h). Returns false with the reason, for example
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
