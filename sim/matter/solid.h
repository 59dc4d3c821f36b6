/* Solids: bodies in the box, with fluid around them: at rest in the box, moving on a prescribed path, or
   moved by the fluid.

   A solid has a frame. A sphere is centred there, a box has edges along the axes, a cylinder lies along y. A
   bowl (half of a hollow sphere) opens towards +y. A mesh has the middle of its bounding block there. The
   pose places the solid's frame in the box's frame. */
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

extern const char *const slip_names[]; /* in the order of Slip, ended by NULL */

struct MeshShape;

/* The mesh of a solid or a fill. */
typedef struct MeshUse {
    char file[FILE_NAME_SIZE];     /* name of the file of `shape` */
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
    Motion motions[MOTIONS_MAX];       /* act together, like the box's motions; turns go about the centre */
    SolidHand hand;                    /* zero: never moved by a hand */
    double density;                    /* kg/m3: more than 0: no motions, fluid and gravity move the solid
                                          (sim/body), */
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
   most the true depth; for a mesh as in sim/mesh/distance.h. In two dimensions x[2] must be 0. */
double solid_distance(const SolidDef *solid, int dimensions, const double x[3]);

/* Unit vector of the fastest growth of the distance. */
void solid_normal(const SolidDef *solid, int dimensions, const double x[3], double normal[3]);

/* True if the solid is always between `low` and `high` (m) along an axis of the box. False also where not
   easy to prove, as with an acceleration along the axis. */
bool solid_between(const SolidDef *solid, int dimensions, int axis, double low, double high);

/* Radius of a ball about the origin of the solid's frame, around the whole solid, m. */
double solid_reach(const SolidDef *solid);

/* Half the edges of a block around the solid, along the axes of the solid's frame, about the origin, m. */
void solid_half(const SolidDef *solid, double half[3]);

/* Distance and reach of a mesh of that size: x about the mesh's middle, m; INFINITY and 0 without a shape. */
double mesh_use_distance(const MeshUse *mesh, const double x[3]);
double mesh_use_reach(const MeshUse *mesh);

#endif
