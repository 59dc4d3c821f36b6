/* Solids: bodies in the box, at rest in it or moving on a prescribed path, that the fluid flows around.

   A solid has a frame of its own: a sphere is centred there, a box has its edges along the axes, a cylinder
   lies along y, a bowl (half of a hollow sphere) opens towards +y. Its pose places that frame in the box's
   frame. */
#ifndef SLOSH_SOLID_H
#define SLOSH_SOLID_H

#include "sim/box/box_motion.h"

#include <stdbool.h>

enum { SOLIDS_MAX = 16 };

/* X(ENUM, name, help) */
#define SOLID_LIST(X)                                                                                        \
    X(SPHERE, "sphere", "a ball; in two dimensions a disc")                                                  \
    X(BOX, "box", "a block, turned by `angle` about `axis`")                                                 \
    X(CYLINDER, "cylinder", "a cylinder along `axis`; not in two dimensions")                                \
    X(BOWL, "bowl", "half of a hollow sphere that opens towards `axis`; in two dimensions half of a ring")

typedef enum SolidKind {
#define X(NAME, name, help) SOLID_##NAME,
    SOLID_LIST(X)
#undef X
        SOLID_KIND_COUNT
} SolidKind;

/* How fluid passes a surface. */
typedef enum Slip { SLIP_FREE, SLIP_NONE } Slip;

extern const char *const slip_names[]; /* in its order, ended by NULL */

/* Fields that a kind does not name are unused. All in the box's frame. */
typedef struct SolidDef {
    SolidKind kind;
    double centre[3]; /* at rest, m: of the body; of a bowl: of its sphere */
    double size[3];   /* box: lengths of its edges, m */
    double radius;    /* sphere, cylinder, bowl (inside), m */
    double height;    /* cylinder, m */
    double thickness; /* bowl: of its wall, m */
    double axis[3];   /* cylinder, bowl: its direction; box: what it is turned about; any length but zero */
    double angle_deg; /* box, degrees */
    int slip;         /* a Slip */
    float color[3];   /* linear RGB 0..1: for the views, no solver reads it */
    int motion_count;
    Motion motions[MOTIONS_MAX]; /* act together, as the box's own do; turns go about the centre */
} SolidDef;

const char *solid_name(SolidKind kind);

/* Where the solid's frame is at `time` (s), in the box's frame, and how it moves there. */
void solid_pose(const SolidDef *solid, double time, BoxState *pose);

/* Signed distance of x (the solid's frame, m) from the surface: less than 0 inside; outside it is exact,
   inside no more than the true depth. In two dimensions x[2] must be 0. */
double solid_distance(const SolidDef *solid, int dimensions, const double x[3]);

/* Unit vector along which the distance grows fastest. */
void solid_normal(const SolidDef *solid, int dimensions, const double x[3], double normal[3]);

/* Whether it is always between `low` and `high` (m) along that axis of the box; false where that is not plain
   to see, as for one that is accelerated along it. */
bool solid_between(const SolidDef *solid, int dimensions, int axis, double low, double high);

/* Radius of a ball about the origin of the solid's own frame that holds the solid, m. */
double solid_reach(const SolidDef *solid);

#endif
