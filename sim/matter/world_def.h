/* What a solver needs to know of a scene: plain data, SI units, the box's frame unless said otherwise. */
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

/* Room for a method's own settings, a struct that only the method knows: see method_def in
   sim/world/method.h. */
typedef struct MethodDef {
    _Alignas(8) unsigned char bytes[METHOD_DEF_SIZE];
} MethodDef;

/* The same of a backend: see backend_def in sim/world/backend.h. */
typedef struct BackendDef {
    _Alignas(8) unsigned char bytes[BACKEND_DEF_SIZE];
} BackendDef;

typedef enum FillKind { FILL_BLOCK, FILL_BALL, FILL_CYLINDER, FILL_MESH } FillKind;

/* A region that is full of a fluid at the start: it takes the points of one lattice that all fills share,
   with the scene's spacing, half a spacing from the floor and centred between the walls. */
typedef struct Fill {
    FillKind kind;
    double min[3], max[3];      /* block, m */
    double centre[3], radius;   /* ball and cylinder, m; of a mesh the middle of the block around it */
    double axis[3], height;     /* cylinder: its direction, of any length but zero; m. 3D only */
    double angle_deg;           /* mesh: its turn about `axis`, degrees */
    MeshUse mesh;               /* 3D only */
    char below[FILE_NAME_SIZE]; /* it ends at this height (m), a formula of x and z, if one is given; or the
                                 name of the file that `heights` was read from */
    const FieldTable *heights;  /* NULL: `below` is a formula or not given; column 0: m. For world_create */
    bool shut;                  /* a drain: at the start */
} Fill;

/* A disk that sends out fluid at rest density, with a velocity along its normal, in the box's frame. A
   particle comes out where there is room for it. */
typedef struct Emit {
    int kind;            /* 0: a disk */
    double centre[3];    /* m */
    double direction[3]; /* of any length but zero */
    double radius;       /* m */
    double speed;        /* m/s */
    double start;        /* s */
    double duration;     /* s; 0: for ever */
    bool shut;           /* at the start */
} Emit;

/* How a fluid's fills start: X(ENUM, name). */
#define START_LIST(X)                                                                                        \
    X(REST, "rest")               /* at rest density: gravity sets in suddenly, and what is deep rings */    \
    X(HYDROSTATIC, "hydrostatic") /* with the pressure that gravity asks for: sim/matter/balance.h */

typedef enum FluidStart {
#define X(NAME, name) START_##NAME,
    START_LIST(X)
#undef X
} FluidStart;

typedef struct FluidDef {
    char name[NAME_SIZE];
    double density;             /* rest density rho0, kg/m3 */
    double viscosity;           /* dynamic, mu, Pa s; in a world, of a fluid with a table: the present one */
    TimeTable viscosity_table;  /* mu over time; without rows it is `viscosity` at any time */
    double surface_tension;     /* sigma, N/m: against what is not this fluid; see WorldDef.tension_model */
    double contact_angle;       /* at the walls of the box, degrees, measured in the fluid */
    int start;                  /* a FluidStart */
    double velocity[3];         /* at the start, in the box's frame, m/s */
    char flow[3][FORMULA_SIZE]; /* besides it, formulas of x, y and z, if given: m/s */
    char flow_file[FILE_NAME_SIZE]; /* the name of the file that `flow_table` was read from */
    const FieldTable *flow_table; /* besides them, its columns: m/s; NULL: none. Read by world_create only */
    double taylor_green; /* with it the vortices of sim/matter/vortices.h, of that speed, m/s; 0: none */
    float color[3];      /* linear RGB 0..1: for the views, no solver reads it */
    int fill_count;
    Fill fills[FILLS_MAX];
    int emit_count;
    Emit emits[EMITS_MAX];
} FluidDef;

/* A ready initial state in place of the fills: for tests, and for what is not a lattice. */
typedef struct InitialState {
    size_t count;
    const float *position; /* 3 * count, x y z of each particle */
    const float *velocity; /* 3 * count, or NULL for rest in the box's frame */
    const uint8_t *fluid;  /* count, or NULL for the first fluid */
    const float *density;  /* count, kg/m3, for a method whose particles carry it; NULL: at rest */
    const float *pressure; /* count, Pa, for a method that begins with multipliers; NULL: 0 */
    size_t room;           /* for so many particles at least; 0: for its own */
} InitialState;

typedef enum StepMode { STEP_FIXED, STEP_CFL } StepMode;

typedef struct WorldDef {
    int dimensions;     /* 3, or 2: all in the plane z = 0, a metre deep; the box's depth is then the
                           spacing, whatever box_size says */
    double box_size[3]; /* inner width, height, depth, m */
    bool periodic[3];  /* the sides across this axis are one: see sim/box/periodic.h; such a box does not turn
                        */
    double gravity[3]; /* in the world's frame, m/s2 */
    double spacing;    /* of the lattice at rest, m */
    double support;    /* support radius h over spacing */
    double jitter; /* of the lattice that fills give: each point moves by up to so many spacings along each
                      axis, the same way in each run */
    char method[NAME_SIZE];              /* see method_list */
    char backend[NAME_SIZE];             /* see backend_list */
    double sound_speed;                  /* c, m/s: p = c^2 (rho - rho0) */
    bool negative_pressure;              /* false: p = max(0, p) */
    bool reproducible;                   /* the same bits each time on compute too; the others always are */
    MethodDef of_method[METHODS_MAX];    /* own settings of each method of the list, in its order */
    BackendDef of_backend[BACKENDS_MAX]; /* the same of each backend */
    int tension_model;                   /* a TensionModel of sim/matter/tension.h */
    int viscosity_solver;       /* a ViscositySolver of sim/matter/viscosity.h; of the implicit one: */
    double viscosity_tolerance; /* what a step may leave, a fraction: see sim/viscosity/passes.h */
    int viscosity_iterations;   /* at most */
    int wall_slip; /* a Slip of sim/matter/solid.h: how viscous fluid passes the walls of the box */
    double lid[3]; /* velocity of the wall at the top, in its plane, m/s: for walls without slip */
    StepMode step_mode;
    double dt;         /* simulated time of a frame, s; mode fixed */
    int substeps;      /* steps in a frame; mode fixed */
    double cfl_number; /* of its limits; mode cfl, whose frame is one step: see sim/world/step_control.h */
    double max_dt;     /* greatest step, s; mode cfl */
    int retries; /* times that the step is halved after trouble before the world gives up; 0: no sentinel */
    int fluid_count;
    FluidDef fluids[FLUIDS_MAX];
    int motion_count;
    Motion motions[MOTIONS_MAX];
    int drain_count;
    Fill drains[DRAINS_MAX]; /* fluid that comes into one of these is taken out */
    int most;                /* particles that emitters may fill the world up to */
    bool pours;              /* a user pours fluid: as with emitters. A world takes it up when somebody does:
                                world_make_room */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    bool acceleration;           /* of particles is kept: sim/change; no bit of a step changes with it */
    BoxLimits limits;            /* of the box in the hand */
    const InitialState *initial; /* NULL: the fills; read by world_create only */
} WorldDef;

/* mu at `time` (s), the greatest and the least at any time, Pa s. A fluid whose table is above 0 somewhere
   counts as viscous throughout, so that the terms of a world do not change with time. */
double fluid_viscosity_at(const FluidDef *fluid, double time);
double fluid_viscosity_most(const FluidDef *fluid);
double fluid_viscosity_least(const FluidDef *fluid);

/* The def with each viscosity the greatest that its table has. */
WorldDef world_def_most_viscous(const WorldDef *def);

/* Puts the viscosities of fluids with a table to those of `time` (s). */
void world_def_at(WorldDef *def, double time);

#endif
