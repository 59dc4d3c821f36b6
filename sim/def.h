/* What a world is made of: WorldDef, plain data for world_create (sim/world.h). Begin with
   world_def_default() and set the box, the spacing and the fluids. SI units; 2D or 3D; the box's frame has
   its origin at the centre of the box's floor, y up.

   The file has, in this order, formulas and tables of time and place, the box's motion and the hand's filter,
   and solids. Then come fluids with fills, emitters and drains, and the WorldDef.

   A list is a count and a pointer to memory of the def's creator: `Fill fills[40]; ... fluid.fills = fills;
   fluid.fill_count = 40;`. A copy of a def has the same lists. world_create copies the lists: equal lists
   once, for as long as the program runs. The names, tables and meshes behind other pointers stay
   the creator's, until the world is destroyed. */
#ifndef SIM_DEF_H
#define SIM_DEF_H

#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Names of files in scenes: as long as whole paths. */

enum { FILE_NAME_SIZE = 1024 };

/* A formula in a scene: numbers, the names of variables, pi, + - * / ^, parentheses, and the functions sin
   cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b). "0.1 * cos(pi * x / 0.5)". */

enum { FORMULA_SIZE = 96 }; /* size of the text, with the final 0 */

/* A formula as a program for a stack machine. Each step comes from at least a letter of the text. */
typedef struct Formula {
    int count;
    struct {
        uint8_t what, which; /* index of the name or function */
        double number;
    } step[FORMULA_SIZE];
} Formula;

/* Parses a text; `names` has a letter per variable, such as "xyz". Returns false with the reason and its
   position. */
bool formula_read(const char *text, const char *names, Formula *formula, Error *error);

/* The value for the given values of the variables. */
double formula_value(const Formula *formula, const double *values);

/* True if the text is neither "" nor "none". */
bool formula_given(const char *text);

/* A quantity over simulated time: linear between rows, constant outside. */

enum { TIME_TABLE_ROWS = 16 };

/* Doubles only: part of a world's saved state. */
typedef struct TimeTable {
    double rows;                  /* 0: no table */
    double time[TIME_TABLE_ROWS]; /* s, ascending */
    double value[TIME_TABLE_ROWS];
} TimeTable;

/* For a table with rows; `time` in s. */
double time_table_at(const TimeTable *table, double time);

/* Greatest and least value over all times; 0 without rows. */
double time_table_most(const TimeTable *table);
double time_table_least(const TimeTable *table);

/* A smooth curve through the rows, and its rate. The rate at a row is the mean rate between the rows before
   and after; 0 at both ends and outside. */
double time_table_smooth(const TimeTable *table, double time, double *rate);

/* True if there are 0 to TIME_TABLE_ROWS rows, times ascend, and no value is negative, infinite or NaN. */
bool time_table_sound(const TimeTable *table);

/* Quantities over positions: linear between the points of a grid with arbitrary plane spacing, constant
   outside of the grid. */

enum { FIELD_TABLE_COLUMNS = 3 };

/* The creator owns the arrays. */
typedef struct FieldTable {
    int count[3];     /* planes across x, y, z; 1: independent of the coordinate */
    double *place[3]; /* count[k] positions of planes, ascending, m; not read for a single plane */
    double *value[FIELD_TABLE_COLUMNS]; /* values at all points, x fastest, z slowest; NULL: none */
} FieldTable;

/* Value of quantity `column`, which must exist, at x (m). */
double field_table_at(const FieldTable *table, int column, const double x[3]);

/* The box as a frame of reference: pose, motion, and transforms of positions and velocities. The box's
   frame has its origin at the centre of the box's floor, y up, axes parallel to the box's edges. Devices
   and prescribed motions turn the box about its centre. World and box frame coincide until the box moves. */

enum { MOTIONS_MAX = 1000 }; /* of a list: a bound of the work, not of memory */

/* The pose of the box and its rate, in the world's frame. */
typedef struct BoxState {
    double position[3];         /* of the box's origin, m */
    double orientation[4];      /* unit quaternion x y z w: world = orientation * box */
    double velocity[3];         /* of the box's origin, m/s */
    double angular_velocity[3]; /* rad/s */
} BoxState;

/* X(ENUM, name, help): kinds of prescribed motion. Motions of a list act together, rotations from the first
   (outermost) to the last (innermost). */
#define MOTION_LIST(X)                                                                                       \
    X(SHAKE, "shake", "moves to and fro along `axis`: amplitude (m) * sin(2 pi frequency (Hz) t)")           \
    X(ROCK, "rock", "turns to and fro about `axis`: angle (degrees) * sin(2 pi frequency (Hz) t)")           \
    X(TURN, "turn", "turns about `axis` by `angle` (degrees) within `duration` (s), smoothly, and stays")    \
    X(SPIN, "spin", "turns about `axis` at the constant `rate` (rad/s)")                                     \
    X(ACCELERATE, "accelerate", "moves along `axis` with the constant `acceleration` (m/s2)")                \
    X(PATH, "path", "moves along `axis` by a table of ways (m) over time, in smooth curves")                 \
    X(TILT, "tilt", "turns about `axis` by a table of angles (degrees) over time, in smooth curves")

typedef enum MotionKind {
#define X(NAME, name, help) MOTION_##NAME,
    MOTION_LIST(X)
#undef X
        MOTION_KIND_COUNT
} MotionKind;

/* Fields not named in a kind's help are unused. */
typedef struct Motion {
    MotionKind kind;
    double axis[3];      /* direction, non-zero; in the world's frame for translations and for the outermost
                            rotation, for inner rotations in the frame after the outer rotations */
    double amplitude;    /* m */
    double angle_deg;    /* degrees */
    double frequency;    /* Hz */
    double rate;         /* rad/s */
    double acceleration; /* m/s2 */
    double start;        /* s; no motion before */
    double duration;     /* s; 0: unlimited (turn: must be > 0). Afterwards shake and rock rest at their start
                            if the duration is a whole number of half periods */
    double held;         /* m or degrees, for a table without rows */
    TimeTable table;     /* m or degrees; at rest before the first row and after the last */
} Motion;

const char *motion_name(MotionKind kind);
const char *motion_help(MotionKind kind);

/* The box at `time` (s) under `count` motions; exact, with exact rates. `box_height` (m) gives the centre
   of rotation. */
void box_state_at(const Motion list[], int count, double box_height, double time, BoxState *state);

/* a x b; `out` may be a or b. */
void cross_product(const double a[3], const double b[3], double out[3]);

/* a * b; `out` may be a or b. */
void quat_multiply(const double a[4], const double b[4], double out[4]);

/* Turns q further by a rotation vector (radians, along the axis, both in the world), to a unit quaternion. */
void quat_turn(const double rotation[3], double q[4]);

/* Rotates v by the quaternion q, or by its inverse. `out` may be `v`. */
void quat_rotate(const double q[4], const double v[3], double out[3]);
void quat_rotate_inverse(const double q[4], const double v[3], double out[3]);

/* Box frame to world frame, for a point and its velocity in the box's frame (NULL: not wanted). */
void box_to_world(const BoxState *box, const double x[3], const double v[3], double x_world[3],
                  double v_world[3]);

/* True for a motion without rotation. */
bool motion_translates(const Motion *motion);

/* A bound of the distance from the start, m or degrees, of a motion by a table. The curve goes at most 0.6 of
   the greatest value beyond. Slopes over a span are at most twice the greatest value, with Hermite's weights
   of 4/27. */
double motion_farthest(const Motion *motion);

/* True if the motion keeps the plane z = 0. */
bool motion_in_plane(const Motion *motion);

/* The box in the hand: follows a target pose like a critically damped spring, within limits, in simulated
   time. */

/* The hand's target for the box, on top of the scene's prescribed motion. */
typedef struct BoxTarget {
    double position[3];    /* of the box's centre from its home, m; the prescribed motion is added */
    double orientation[4]; /* unit quaternion x y z w; about the box's centre */
} BoxTarget;

/* Limits of a box in the hand; the scene's keys `hand.*`. */
typedef struct BoxLimits {
    double response;              /* s: time constant of the filter */
    double speed;                 /* m/s */
    double acceleration;          /* m/s2 */
    double turn_speed_deg;        /* degrees/s */
    double turn_acceleration_deg; /* degrees/s2 */
} BoxLimits;

/* State of the filter: the hand's part of the pose, and its rates in the world's frame. */
typedef struct BoxFilter {
    double position[3];         /* m */
    double velocity[3];         /* m/s */
    double orientation[4];      /* unit quaternion */
    double angular_velocity[3]; /* rad/s */
} BoxFilter;

/* sim/box/box_motion.c gives the reason for each value. */
BoxLimits box_limits_default(void);
BoxFilter box_filter_at_rest(void);

/* Advances the filter by dt (s) towards the target. */
void box_filter_step(BoxFilter *filter, const BoxTarget *target, const BoxLimits *limits, double dt);

/* Adds the hand's part to the prescribed pose: the hand's rotation is outermost, about the home position of
   the box's centre. */
void box_filter_apply(const BoxFilter *filter, double box_height, BoxState *state);

/* Solids: bodies in the box, with fluid around them: at rest in the box, moving on a prescribed path, or
   moved by the fluid.

   A solid has a frame. A sphere is centred there, a box has edges along the axes, a cylinder lies along y. A
   bowl (half of a hollow sphere) opens towards +y. A mesh has the middle of its bounding block there. The
   pose places the solid's frame in the box's frame. */

enum { SOLIDS_MAX = 16 }; /* as many as the GPU's blocks of constants and a saved state have room for */

/* X(ENUM, name, help) */
#define SOLID_LIST(X)                                                                                         \
    X(SPHERE, "sphere", "a ball; in two dimensions a disc")                                                   \
    X(BOX, "box", "a block, turned by `angle` about `axis`")                                                  \
    X(CYLINDER, "cylinder", "a cylinder along `axis`; not in two dimensions")                                 \
    X(BOWL, "bowl", "half of a hollow sphere that opens towards `axis`; in two dimensions half of a ring")    \
    X(MESH, "mesh",                                                                                           \
      "a closed mesh of triangles from a file (OBJ, PLY, STL, glTF), turned by `angle` about `axis`; not in " \
      "two dimensions")

typedef enum SolidKind {
#define X(NAME, name, help) SOLID_##NAME,
    SOLID_LIST(X)
#undef X
        SOLID_KIND_COUNT
} SolidKind;

/* How fluid passes a surface. */
typedef enum Slip { SLIP_FREE, SLIP_NONE } Slip;

extern const char *const slip_names[]; /* in the order of Slip, ended by NULL */

struct MeshShape;

/* The mesh of a solid or a fill. */
typedef struct MeshUse {
    const char *file;              /* name of the file of `shape`; NULL: none */
    double scale;                  /* m per unit of the file */
    const struct MeshShape *shape; /* sim/mesh/mesh_shape.h; must outlive all copies. NULL: no kind of mesh,
                                      or the file is missing */
} MeshUse;

/* Where a user's hand holds a solid, on top of the solid's own motion. The solid gets there like a critically
   damped spring, so the hand's last request decides all later poses. */
typedef struct SolidHand {
    bool moved;                       /* a hand has moved the solid, ever */
    double since;                     /* s: time of the hand's last request */
    double response;                  /* s: time constant */
    double at[3], turn[4];            /* target, m; unit quaternion about the centre; at `since`: */
    double apart[3], rate[3];         /* offset from the target, m; rate, m/s */
    double turned[3], turned_rate[3]; /* offset as a rotation vector; rate, rad/s */
} SolidHand;

/* Fields not named by a kind are unused. All in the box's frame. */
typedef struct SolidDef {
    SolidKind kind;
    double centre[3]; /* at rest, m: of the body; of a bowl: of the sphere */
    double size[3];   /* box: lengths of the edges, m */
    double radius;    /* sphere, cylinder, bowl (inside), m */
    double height;    /* cylinder, m */
    double thickness; /* bowl: of the wall, m */
    double axis[3];   /* cylinder, bowl: direction; box, mesh: axis of the turn; any length but 0 */
    double angle_deg; /* box, mesh, degrees */
    MeshUse mesh;
    int slip;       /* a Slip */
    float color[3]; /* linear RGB 0..1: for the views, no solver reads it */
    int motion_count;
    const Motion *motions;             /* act together, like the box's motions; turns go about the centre */
    SolidHand hand;                    /* zero: never moved by a hand */
    double density;                    /* kg/m3: more than 0: no motions, fluid and gravity move the solid
                                          (sim/solids), */
    double hinge_at[3], hinge_axis[3]; /* about one axis fixed to the box; 0 0 0: freely */
} SolidDef;

/* Name of the kind in scenes, as in SOLID_LIST. */
const char *solid_name(SolidKind kind);

/* True if fluid moves the solid. */
static inline bool solid_floats(const SolidDef *solid)
{
    return solid->density > 0;
}

/* True if the solid may ever move: by motions, by fluid, or after a hand has moved the solid. */
static inline bool solid_moves(const SolidDef *solid)
{
    return solid->motion_count > 0 || solid->hand.moved || solid_floats(solid);
}

/* The hand's part of the pose at `time` (s): offset of the centre, m, turn about the centre, and their
   rates. */
void solid_hand_at(const SolidHand *hand, double time, BoxState *part);

/* Moves the solid to `at` and `turn` from `time` (s) on, from the present place: never faster than `speed`
   (m/s) and `turn_speed` (rad/s, about the centre). In two dimensions the solid stays in the plane. Returns
   false and changes nothing if a number is not finite or a speed is not positive. */
bool solid_hand_move(SolidHand *hand, const double at[3], const double turn[4], double time, double speed,
                     double turn_speed, int dimensions);

/* Writes the turn by `angle_deg` about `axis` as a unit quaternion. */
void solid_turn(const double axis[3], double angle_deg, double q[4]);

/* Pose and velocities of the solid's frame at `time` (s), in the box's frame; for a floating solid the pose
   at the start. */
void solid_pose(const SolidDef *solid, double time, BoxState *pose);

/* Like solid_pose, for a state: a floating solid has the pose `floating`. All 0: the state has no pose, and
   the solid is where it began. */
void solid_pose_in(const SolidDef *solid, double time, const BoxState *floating, BoxState *pose);

/* Signed distance of x (the solid's frame, m) from the surface: negative inside. Exact outside, inside at
   most the true depth; for a mesh as in sim/mesh/mesh_shape.h. In two dimensions x[2] must be 0. */
double solid_distance(const SolidDef *solid, int dimensions, const double x[3]);

/* Unit vector of the fastest growth of the distance. */
void solid_normal(const SolidDef *solid, int dimensions, const double x[3], double normal[3]);

/* True if the solid is always between `low` and `high` (m) along an axis of the box. False also where a
   proof is not easy, as with an acceleration along the axis. */
bool solid_between(const SolidDef *solid, int dimensions, int axis, double low, double high);

/* Radius of a ball about the origin of the solid's frame, around the whole solid, m. */
double solid_reach(const SolidDef *solid);

/* Half the edges of a block around the solid, along the axes of the solid's frame, about the origin, m. */
void solid_half(const SolidDef *solid, double half[3]);

/* Distance and reach of a mesh of that size: x about the mesh's middle, m; INFINITY and 0 without a shape. */
double mesh_use_distance(const MeshUse *mesh, const double x[3]);
double mesh_use_reach(const MeshUse *mesh);

/* A solver's knowledge of a scene: plain data, SI units, the box's frame unless said otherwise. */

enum {
    FLUIDS_MAX = 8, /* as many as the GPU's blocks of constants have room for */
    EMITS_MAX = 4,  /* of a fluid; with drains at most 64 gates, a bit each in states and recordings */
    DRAINS_MAX = 8,
    FILLS_MAX = 256, /* of a fluid: a bound of the work, not of memory */
    NAME_SIZE = 32
};
enum { METHODS_MAX = 8, METHOD_DEF_SIZE = 256, BACKENDS_MAX = 4, BACKEND_DEF_SIZE = 64 };

/* Room for a method's own settings, a struct known only to the method: see method_def in
   sim/step/method.h. */
typedef struct MethodDef {
    _Alignas(8) unsigned char bytes[METHOD_DEF_SIZE];
} MethodDef;

/* The same for a backend: see backend_def in sim/step/backend.h. */
typedef struct BackendDef {
    _Alignas(8) unsigned char bytes[BACKEND_DEF_SIZE];
} BackendDef;

typedef enum FillKind { FILL_BLOCK, FILL_BALL, FILL_CYLINDER, FILL_MESH } FillKind;

/* A region full of a fluid at the start, on a lattice of sim/start/start.h; or the region of a
   drain. */
typedef struct Fill {
    FillKind kind;
    double min[3], max[3];     /* block, m */
    double centre[3], radius;  /* ball and cylinder, m; mesh: middle of the block around the mesh */
    double axis[3], height;    /* cylinder: direction, of any length but zero; m. 3D only */
    double angle_deg;          /* mesh: turn about `axis`, degrees */
    MeshUse mesh;              /* 3D only */
    const char *below;         /* upper end (m), a formula of x and z, if given; or the name of the file of
                                  `heights`. NULL or "none": none */
    const FieldTable *heights; /* NULL: `below` is a formula or not given; column 0: m. For world_create */
    bool closed;               /* a drain: shut at the start */
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
    bool closed;         /* shut at the start */
} Emit;

/* How a fluid's fills start: X(ENUM, name). */
#define START_LIST(X)                                                                                        \
    X(REST, "rest")               /* at rest density: gravity sets in suddenly, and deep fluid rings */      \
    X(HYDROSTATIC, "hydrostatic") /* with the pressure due to gravity: sim/start/start.h */

typedef enum FluidStart {
#define X(NAME, name) START_##NAME,
    START_LIST(X)
#undef X
} FluidStart;

typedef struct FluidDef {
    char name[NAME_SIZE];
    double density;               /* rest density rho0, kg/m3 */
    double viscosity;             /* dynamic, mu, Pa s; in a world, with a table: the present value */
    TimeTable viscosity_table;    /* mu over time; without rows `viscosity` at any time */
    double surface_tension;       /* sigma, N/m: at the border of this fluid; see WorldDef.tension_model */
    double contact_angle;         /* at the walls of the box, degrees, measured in the fluid */
    int start;                    /* a FluidStart */
    double velocity[3];           /* at the start, in the box's frame, m/s */
    char flow[3][FORMULA_SIZE];   /* added to `velocity`: formulas of x, y and z, if given: m/s */
    const char *flow_file;        /* name of the file of `flow_table`; NULL or "none": none */
    const FieldTable *flow_table; /* added too: columns in m/s; NULL: none. Read by world_create only */
    double taylor_green;          /* added too: vortices of sim/start/start.h, of that speed, m/s; 0: none */
    float color[3];               /* linear RGB 0..1: for the views, no solver reads it */
    int fill_count;
    const Fill *fills;
    int emit_count;
    const Emit *emits;
} FluidDef;

/* A ready initial state in place of the fills: for tests, and for states off the lattice. */
typedef struct InitialState {
    size_t count;
    const float *position; /* 3 * count, x y z of each particle */
    const float *velocity; /* 3 * count, or NULL for rest in the box's frame */
    const uint8_t *fluid;  /* count, or NULL for the first fluid */
    const float *density;  /* count, kg/m3, for a method with carried density; NULL: at rest */
    const float *pressure; /* count, Pa, for a method with multipliers at the start; NULL: 0 */
    size_t capacity;       /* room for at least so many particles; 0: for `count` */
} InitialState;

typedef enum StepMode { STEP_FIXED, STEP_CFL } StepMode;

typedef struct WorldDef {
    int dimensions;     /* 3, or 2: all in the plane z = 0, a metre deep; then the box's depth is the spacing,
                           not that of box_size */
    double box_size[3]; /* inner width, height, depth, m */
    bool periodic[3];   /* the sides across the axis are joined: see sim/box/box.h; a periodic box does
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
    int tension_model;                   /* a TensionModel of sim/def/fluids.h */
    int viscosity_solver;                /* a ViscositySolver of sim/def/fluids.h; for the implicit solver: */
    double viscosity_tolerance; /* greatest residual of a step, a fraction: see sim/methods/shared/terms.h */
    int viscosity_iterations;   /* at most */
    int wall_slip;              /* a Slip: how viscous fluid passes the walls of the box */
    double lid[3];              /* velocity of the top wall, in its plane, m/s: for walls without slip */
    StepMode step_mode;
    double dt;         /* simulated time of a frame, s; mode fixed */
    int substeps;      /* steps in a frame; mode fixed */
    double cfl_number; /* factor of the step's limits; mode cfl, one step per frame: see
                          sim/step/constants.h */
    double max_dt;     /* greatest step, s; mode cfl */
    int retries; /* number of halvings of the step after trouble, before the world gives up; 0: no sentinel */
    int fluid_count;
    FluidDef fluids[FLUIDS_MAX];
    int motion_count;
    const Motion *motions;
    int drain_count;
    const Fill *drains; /* fluid inside a drain is removed */
    int most;           /* emitters fill the world up to so many particles */
    bool pours;         /* a user pours fluid: as with emitters. A world sets it at the first pouring:
                           world_make_room */
    int solid_count;
    SolidDef solids[SOLIDS_MAX];
    bool acceleration; /* keeps particles' accelerations: sim/methods/shared/terms.h; no bit of a step
                          changes */
    BoxLimits limits;  /* of the box in the hand */
    const InitialState *initial; /* NULL: the fills; read by world_create only */
} WorldDef;

/* The greatest and the least mu at any time, Pa s. A fluid with a table above 0
   somewhere counts as viscous throughout, so that the terms of a world do not change with time. */
double fluid_viscosity_most(const FluidDef *fluid);
double fluid_viscosity_least(const FluidDef *fluid);

/* The def with each viscosity at the greatest value of its table: a copy in *space, or the def itself without
   a table. */
const WorldDef *world_def_most_viscous(const WorldDef *def, WorldDef *space);

/* Sets viscosities with a table to the values at `time` (s). */
void world_def_at(WorldDef *def, double time);

#endif
