/* A solver's knowledge of a scene: plain data, SI units, the box's frame unless said otherwise. */
#ifndef SLOSH_WORLD_DEF_H
#define SLOSH_WORLD_DEF_H

#include "sim/base/field_table.h"
#include "sim/base/formula.h"
#include "sim/base/time_table.h"
#include "sim/box/box_filter.h"
#include "sim/box/box_motion.h"
#include "sim/matter/solid.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FLUIDS_MAX = 8, FILLS_MAX = 16, EMITS_MAX = 4, DRAINS_MAX = 8, NAME_SIZE = 32 };
enum { METHODS_MAX = 8, METHOD_DEF_SIZE = 256, BACKENDS_MAX = 4, BACKEND_DEF_SIZE = 64 };

/* Room for a method's own settings, a struct known only to the method: see method_def in
   sim/world/method.h. */
typedef struct MethodDef {
    _Alignas(8) unsigned char bytes[METHOD_DEF_SIZE];
} MethodDef;

/* The same for a backend: see backend_def in sim/world/backend.h. */
typedef struct BackendDef {
    _Alignas(8) unsigned char bytes[BACKEND_DEF_SIZE];
} BackendDef;

typedef enum FillKind { FILL_BLOCK, FILL_BALL, FILL_CYLINDER, FILL_MESH } FillKind;

/* A region full of a fluid at the start, on a lattice of sim/matter/fill_lattice.h; or the region of a
   drain. */
typedef struct Fill {
    FillKind kind;
    double min[3], max[3];      /* block, m */
    double centre[3], radius;   /* ball and cylinder, m; mesh: middle of the block around the mesh */
    double axis[3], height;     /* cylinder: direction, of any length but zero; m. 3D only */
    double angle_deg;           /* mesh: turn about `axis`, degrees */
    MeshUse mesh;               /* 3D only */
    char below[FILE_NAME_SIZE]; /* upper end (m), a formula of x and z, if given; or the name of the file of
                                 `heights` */
    const FieldTable *heights;  /* NULL: `below` is a formula or not given; column 0: m. For world_create */
    bool shut;                  /* a drain: shut at the start */
} Fill;

/* A disk that sends out fluid at rest density, with a velocity along the normal, in the box's frame.
   Particles come out where there is room. */
typedef struct Emit {
    int kind;            /* 0: a disk */
    double centre[3];    /* m */
    double direction[3]; /* of any length but zero */
    double radius;       /* m */
    double speed;        /* m/s */
    double start;        /* s */
    double duration;     /* s; 0: for ever */
    bool shut;           /* shut at the start */
} Emit;

/* How a fluid's fills start: X(ENUM, name). */
#define START_LIST(X)                                                                                        \
    X(REST, "rest")               /* at rest density: gravity sets in suddenly, and deep fluid rings */      \
    X(HYDROSTATIC, "hydrostatic") /* with the pressure due to gravity: sim/matter/balance.h */

typedef enum FluidStart {
#define X(NAME, name) START_##NAME,
    START_LIST(X)
#undef X
} FluidStart;

typedef struct FluidDef {
    char name[NAME_SIZE];
    double density;                 /* rest density rho0, kg/m3 */
    double viscosity;               /* dynamic, mu, Pa s; in a world, with a table: the present value */
    TimeTable viscosity_table;      /* mu over time; without rows `viscosity` at any time */
    double surface_tension;         /* sigma, N/m: at the border of this fluid; see WorldDef.tension_model */
    double contact_angle;           /* at the walls of the box, degrees, measured in the fluid */
    int start;                      /* a FluidStart */
    double velocity[3];             /* at the start, in the box's frame, m/s */
    char flow[3][FORMULA_SIZE];     /* added to `velocity`: formulas of x, y and z, if given: m/s */
    char flow_file[FILE_NAME_SIZE]; /* name of the file of `flow_table` */
    const FieldTable *flow_table;   /* added too: columns in m/s; NULL: none. Read by world_create only */
    double taylor_green; /* added too: vortices of sim/matter/vortices.h, of that speed, m/s; 0: none */
    float color[3];      /* linear RGB 0..1: for the views, no solver reads it */
    int fill_count;
    Fill fills[FILLS_MAX];
    int emit_count;
    Emit emits[EMITS_MAX];
} FluidDef;

/* A ready initial state in place of the fills: for tests, and for states off the lattice. */
typedef struct InitialState {
    size_t count;
    const float *position; /* 3 * count, x y z of each particle */
    const float *velocity; /* 3 * count, or NULL for rest in the box's frame */
    const uint8_t *fluid;  /* count, or NULL for the first fluid */
    const float *density;  /* count, kg/m3, for a method with carried density; NULL: at rest */
    const float *pressure; /* count, Pa, for a method with multipliers at the start; NULL: 0 */
    size_t room;           /* room for at least so many particles; 0: for `count` */
} InitialState;

typedef enum StepMode { STEP_FIXED, STEP_CFL } StepMode;

typedef struct WorldDef {
    int dimensions;     /* 3, or 2: all in the plane z = 0, a metre deep; then the box's depth is the spacing,
                           not that of box_size */
    double box_size[3]; /* inner width, height, depth, m */
    bool periodic[3];   /* the sides across the axis are joined: see sim/box/periodic.h; a periodic box does
                           not turn */
    double gravity[3];  /* in the world's frame, m/s2 */
    double spacing;     /* of the lattice at rest, m */
    double support;     /* support radius h over spacing */
    double jitter; /* of the fills' lattice: each point moves by up to so many spacings along each axis, the
                      same way in each run */
    char method[NAME_SIZE];              /* see method_list */
    char backend[NAME_SIZE];             /* see backend_list */
    double sound_speed;                  /* c, m/s: p = c^2 (rho - rho0) */
    bool negative_pressure;              /* false: p = max(0, p) */
    bool reproducible;                   /* the same bits each time on compute too; the other backends always
                                            give the same bits */
    MethodDef of_method[METHODS_MAX];    /* own settings of each method, in the order of the list */
    BackendDef of_backend[BACKENDS_MAX]; /* the same for each backend */
    int tension_model;                   /* a TensionModel of sim/matter/tension.h */
    int viscosity_solver;       /* a ViscositySolver of sim/matter/viscosity.h; for the implicit solver: */
    double viscosity_tolerance; /* greatest residual of a step, a fraction: see sim/viscosity/passes.h */
    int viscosity_iterations;   /* at most */
    int wall_slip; /* a Slip of sim/matter/solid.h: how viscous fluid passes the walls of the box */
    double lid[3]; /* velocity of the top wall, in its plane, m/s: for walls without slip */
    StepMode step_mode;
    double dt;         /* simulated time of a frame, s; mode fixed */
    int substeps;      /* steps in a frame; mode fixed */
    double cfl_number; /* factor of the step's limits; mode cfl, one step per frame: see
                          sim/world/step_control.h */
    double max_dt;     /* greatest step, s; mode cfl */
    int retries; /* number of halvings of the step after trouble, before the world gives up; 0: no sentinel */
    int fluid_count;
    FluidDef fluids[FLUIDS_MAX];
    int motion_count;
    Motion motions[MOTIONS_MAX];
    int drain_count;
    Fill drains[DRAINS_MAX]; /* fluid inside a drain is removed */
    int most;                /* emitters fill the world up to so many particles */
    bool pours;              /* a user pours fluid: as with emitters. A world sets it at the first pouring:
                                world_make_room */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    bool acceleration;           /* keeps particles' accelerations: sim/change; no bit of a step changes */
    BoxLimits limits;            /* of the box in the hand */
    const InitialState *initial; /* NULL: the fills; read by world_create only */
} WorldDef;

/* mu at `time` (s), and the greatest and the least mu at any time, Pa s. A fluid with a table above 0
   somewhere counts as viscous throughout, so that the terms of a world do not change with time. */
double fluid_viscosity_at(const FluidDef *fluid, double time);
double fluid_viscosity_most(const FluidDef *fluid);
double fluid_viscosity_least(const FluidDef *fluid);

/* Copy of the def with each viscosity at the greatest value of its table. */
WorldDef world_def_most_viscous(const WorldDef *def);

/* Sets viscosities with a table to the values at `time` (s). */
void world_def_at(WorldDef *def, double time);

#endif
