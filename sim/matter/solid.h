/* Solids: bodies in the box, at rest in it, moving on a prescribed path or by the fluid, that it flows
   around.

   A solid has a frame of its own: a sphere is centred there, a box has its edges along the axes, a cylinder
   lies along y, a bowl (half of a hollow sphere) opens towards +y, a mesh has the middle of the block around
   it there. Its pose places that frame in the box's frame. */
#ifndef SLOSH_SOLID_H
#define SLOSH_SOLID_H

#include "sim/base/file_name.h"
#include "sim/box/box_motion.h"

#include <stdbool.h>

enum { SOLIDS_MAX = 16 };

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

extern const char *const slip_names[]; /* in its order, ended by NULL */

struct MeshShape;

/* A mesh that a solid or a fill has the shape of. */
typedef struct MeshUse {
    char file[FILE_NAME_SIZE];     /* the name of the file that `shape` was read from */
    double scale;                  /* m of a unit of the file */
    const struct MeshShape *shape; /* sim/mesh/mesh_shape.h; must outlive all copies. NULL: no kind of mesh,
                                      or its file is gone */
} MeshUse;

/* Where a user's hand holds a solid, on top of its own motion: it comes there as a critically damped spring
   would, so that all is known from when the hand last asked. */
typedef struct SolidHand {
    bool moved;                       /* ever, by a hand */
    double since;                     /* s: when the hand last asked */
    double response;                  /* s: time constant */
    double at[3], turn[4];            /* where it goes, m; unit quaternion, about its centre; then: */
    double apart[3], rate[3];         /* from there, m; m/s */
    double turned[3], turned_rate[3]; /* from there, as a rotation vector; rad/s */
} SolidHand;

/* Fields that a kind does not name are unused. All in the box's frame. */
typedef struct SolidDef {
    SolidKind kind;
    double centre[3]; /* at rest, m: of the body; of a bowl: of its sphere */
    double size[3];   /* box: lengths of its edges, m */
    double radius;    /* sphere, cylinder, bowl (inside), m */
    double height;    /* cylinder, m */
    double thickness; /* bowl: of its wall, m */
    double axis[3]; /* cylinder, bowl: its direction; box, mesh: what it is turned about; any length but 0 */
    double angle_deg; /* box, mesh, degrees */
    MeshUse mesh;
    int slip;       /* a Slip */
    float color[3]; /* linear RGB 0..1: for the views, no solver reads it */
    int motion_count;
    Motion motions[MOTIONS_MAX]; /* act together, as the box's own do; turns go about the centre */
    SolidHand hand;              /* zero: nobody has moved it */
    double density;              /* kg/m3: more than 0: no motions, fluid and gravity move it (sim/body), */
    double hinge_at[3], hinge_axis[3]; /* about this axis alone, fixed to the box; 0 0 0: freely */
} SolidDef;

const char *solid_name(SolidKind kind);

/* Whether fluid moves it. */
static inline bool solid_floats(const SolidDef *solid)
{
    return solid->density > 0;
}

/* Whether it may ever move: by a motion of its own, by fluid, or since a hand has moved it. */
static inline bool solid_moves(const SolidDef *solid)
{
    return solid->motion_count > 0 || solid->hand.moved || solid_floats(solid);
}

/* The hand's part of the pose at `time` (s): what its centre is off, m, the turn about it, and their rates.
 */
void solid_hand_at(const SolidHand *hand, double time, BoxState *part);

/* From `time` (s) on it goes there, from where it is: never faster than `speed` (m/s), nor than so many
   radians a second about its centre; what is not finite is not taken, and nothing has changed. In two
   dimensions it stays in the plane. */
bool solid_hand_move(SolidHand *hand, const double at[3], const double turn[4], double time, double speed,
                     double turn_speed, int dimensions);

/* The turn by `angle_deg` about `axis`. */
void solid_turn(const double axis[3], double angle_deg, double q[4]);

/* Where the solid's frame is at `time` (s), in the box's frame, and how it moves there; of one that is free
   to move, where it began. */
void solid_pose(const SolidDef *solid, double time, BoxState *pose);

/* The same as solid_pose, of a state that has `floating` as the pose of this solid if it floats; all 0: the
   state does not say, and it is where it began. */
void solid_pose_in(const SolidDef *solid, double time, const BoxState *floating, BoxState *pose);

/* Signed distance of x (the solid's frame, m) from the surface: less than 0 inside; outside it is exact,
   inside no more than the true depth; of a mesh as sim/mesh/distance.h has it. In two dimensions x[2] must be
   0. */
double solid_distance(const SolidDef *solid, int dimensions, const double x[3]);

/* Unit vector along which the distance grows fastest. */
void solid_normal(const SolidDef *solid, int dimensions, const double x[3], double normal[3]);

/* Whether it is always between `low` and `high` (m) along that axis of the box; false where that is not plain
   to see, as for one that is accelerated along it. */
bool solid_between(const SolidDef *solid, int dimensions, int axis, double low, double high);

/* Radius of a ball about the origin of the solid's own frame that holds the solid, m. */
double solid_reach(const SolidDef *solid);

/* Half the edges of a block along the axes of the solid's own frame, about its origin, that holds it, m. */
void solid_half(const SolidDef *solid, double half[3]);

/* The same of a mesh of that size: x about its middle, m; INFINITY and 0 without a shape. */
double mesh_use_distance(const MeshUse *mesh, const double x[3]);
double mesh_use_reach(const MeshUse *mesh);

#endif
