/* A scene's probes: places where `slosh run --probes` and the panel read pressure, density and velocity of
   the fluid, or the height of its surface. Also the force of fluid on the box and on solids. Plain data;
   lengths in m, in the box's frame, where probes are at rest. */
#ifndef APP_RUN_MEASURE_MEASURE_DEF_H
#define APP_RUN_MEASURE_MEASURE_DEF_H

#include <stdbool.h>

enum {
    PROBES_MAX = 1000, /* a bound of the work: a list is as long as its count */
    PROBE_NAME_SIZE = 32,
    PROBE_ON_SIZE = 16,
    PROBE_LINE_MAX = 200,
    PROBE_PLANE_MAX = 40
};

/* X(ENUM, name, help) */
#define PROBE_KIND_LIST(X)                                                                                   \
    X(POINT, "point", "the fluid at a place")                                                                \
    X(HEIGHT, "height", "how high the surface of the fluid is over a place; 0: there is none")               \
    X(LINE, "line", "the fluid at places along a line, both ends among them, a column each")                 \
    X(PLANE, "plane", "the mean over a parallelogram")                                                       \
    X(FORCE, "force", "force and torque of the fluid on the box or a solid: the mean since the last reading")

typedef enum ProbeKind {
#define X(NAME, name, help) PROBE_##NAME,
    PROBE_KIND_LIST(X)
#undef X
        PROBE_KIND_COUNT
} ProbeKind;

/* Fields of the fluid a probe can read: X(ENUM, name, unit, components) */
#define PROBE_FIELD_LIST(X)                                                                                  \
    X(PRESSURE, "pressure", "Pa", 1)                                                                         \
    X(DENSITY, "density", "kg/m3", 1)                                                                        \
    X(SPEED, "speed", "m/s", 1)                                                                              \
    X(VELOCITY, "velocity", "m/s", 3)

typedef enum ProbeField {
#define X(NAME, name, unit, components) PROBE_##NAME,
    PROBE_FIELD_LIST(X)
#undef X
        PROBE_FIELD_COUNT
} ProbeField;

typedef struct ProbeFieldRow {
    const char *name, *unit;
    int components; /* 1, or 3: x y z */
} ProbeFieldRow;

extern const ProbeFieldRow probe_fields[]; /* in the order of ProbeField, ended by a NULL name */

/* Members not named for a kind are unused. */
typedef struct ProbeDef {
    char name[PROBE_NAME_SIZE]; /* letters, digits and _ */
    int kind;                   /* ProbeKind */
    double at[3];               /* point, height; plane: the middle */
    double from[3], to[3];      /* line */
    double along[3], across[3]; /* plane: both sides */
    char on[PROBE_ON_SIZE];     /* force: "box", all walls; "solid_0" */
    int count;                  /* line: places; plane: places per side */
    double size;                /* diameter of the ball around each place, m; 0: default of probe_size */
    double average;             /* averaging time, s: adds a mean column after each value; 0: none */
    int field_count, fields[PROBE_FIELD_COUNT]; /* each a ProbeField; unused for height and force */
} ProbeDef;

/* The creator owns the array. */
typedef struct ProbeList {
    int count;
    const ProbeDef *probe;
} ProbeList;

/* Returns the target of a force: the solid's index, or -1 for the box; -2 if there is no such name among
   `solids` solids. */
int probe_on(const ProbeDef *probe, int solids);

/* True if the list has a force. */
bool probe_list_has_forces(const ProbeList *list);

/* Returns the diameter in use, m: the requested size, at least four spacings; by default six spacings, or
   twice the support radius. */
double probe_size(const ProbeDef *probe, double spacing, double support);

#endif
