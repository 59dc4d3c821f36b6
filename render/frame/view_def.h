/* What a scene says of its picture: plain data. */
#ifndef SLOSH_VIEW_DEF_H
#define SLOSH_VIEW_DEF_H

#include "sim/base/control_points.h"
#include "sim/base/scalar.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct CameraDef {
    double from[3]; /* eye, m, world's frame */
    double to[3];   /* looked at, m */
    double fov_deg; /* vertical field of view, degrees */
} CameraDef;

/* Where a camera is at a time, s. */
typedef struct CameraKey {
    double time;
    CameraDef at;
} CameraKey;

enum {
    CAMERA_KEYS_MAX = 16,
    VIEW_TITLE_SIZE = 96,
    VIEW_KINDS_MAX = 8,
    OVERLAY_KINDS_MAX = 4,
    VIEW_OWN_SIZE = 1792,
    VIEW_FILE_SIZE = 256,
    VIEW_SET_SIZE = 512
};

/* How much time a picture may take. */
typedef enum ViewQuality {
    VIEW_AUTO,  /* best in files, draft for clear fluid in a window on a software driver, else good */
    VIEW_DRAFT, /* in time while it moves */
    VIEW_GOOD,  /* as all keys say */
    VIEW_BEST
} ViewQuality;

extern const char *const view_quality_names[]; /* ended by NULL */

/* How the walls of the box are drawn, where ViewDef.box. */
typedef enum ViewWalls {
    VIEW_WALLS_AUTO, /* glass where the view shows clear fluid, else lines */
    VIEW_WALLS_LINES,
    VIEW_WALLS_GLASS
} ViewWalls;

extern const char *const view_walls_names[]; /* ended by NULL */

/* Room for the own settings of a view or an overlay, a struct that only its owner knows: see view_own in
   render/frame/view.h, overlay_own in render/frame/overlay.h. */
typedef struct ViewOwn {
    _Alignas(8) unsigned char bytes[VIEW_OWN_SIZE];
} ViewOwn;

/* What of a particle goes with a scalar, beside its colour. */
typedef struct ScalarCurve {
    int by;               /* 1 + a Scalar; 0: none, and the rest has no effect */
    bool range_auto;      /* the range follows each state; else range[0] .. range[1] */
    bool range_symmetric; /* one that follows each state is as wide below 0 as above */
    double range[2];      /* in the scalar's unit */
    ControlPoints curve;
} ScalarCurve;

typedef struct ViewDef {
    char kind[NAME_SIZE];      /* see view_list; "none" draws nothing */
    Scalar color_by;           /* SCALAR_FLUID: the fluids' own; SCALAR_COUNT: auto, see view_color_by */
    char colormap[NAME_SIZE];  /* see colormap_choices, view_colormap */
    bool range_auto;           /* the range follows each state; else range[0] .. range[1] */
    bool range_symmetric;      /* one that follows each state is as wide below 0 as above */
    double range[2];           /* in the scalar's unit */
    ControlPoints color_curve; /* bends the colormap */
    ScalarCurve opacity;       /* 0 .. 1 */
    ScalarCurve size;          /* factor of the radius */
    double radius;             /* of a particle, in spacings; 0: the view's default */
    ViewOwn of_view[VIEW_KINDS_MAX]; /* own settings of each view of the list, in its order */
    bool legend;                     /* draw the legend */
    bool box;                        /* draw the box's edges */
    int walls;                       /* a ViewWalls */
    bool caustics;                   /* light patterns below clear fluid */
    double foam;                     /* how easily clear fluid foams: 1 as in the docs, 0 never */
    bool floor;                      /* draw the floor below the box */
    bool camera_auto;                /* the camera shows the whole box; else `camera` */
    CameraDef camera;
    double camera_turn;                     /* degrees a second about the vertical through what it looks at */
    int camera_path_count;                  /* of the keyframes that it flies by; 0: none */
    CameraKey camera_path[CAMERA_KEYS_MAX]; /* times ascend */
    double camera_yaw;           /* radians that an automatic camera is turned by: camera_at; a scene has 0 */
    char title[VIEW_TITLE_SIZE]; /* over the picture; "": none */
    bool carries_scene;          /* pictures in PNG files have the scene as text */
    double background[3];        /* linear RGB 0..1, at the horizon */
    int quality;       /* a ViewQuality: chooses for keys that are at their defaults, see view_at_quality */
    int drawn_quality; /* no key: what view_at_quality chose for this picture; VIEW_AUTO before it did */
    double resolution; /* pixels drawn for a pixel shown, each way; more than 0, at most 1 */

    /* The same as of_view of each overlay of its list. */
    ViewOwn of_overlay[OVERLAY_KINDS_MAX];
    /* Of one among several, whose states it shows; "": the scene's. Nothing here reads them. */
    char file[VIEW_FILE_SIZE]; /* a recorded run */
    char set[VIEW_SET_SIZE];   /* the scene with these settings: KEY_SETTINGS */
} ViewDef;

/* What there is to be shown, and how. */
typedef struct Subject {
    const ViewDef *def;
    const WorldDef *world; /* all 0 where it is not known */
} Subject;

/* The scalar of a curve that has one. */
static inline Scalar scalar_of_curve(const ScalarCurve *curve)
{
    return (Scalar)(curve->by - 1);
}

/* What the colours show: of a def with `auto` what goes with its view and look (ViewKind.own_colors). All
   that draw, name or check colours ask here. */
Scalar view_color_by(const ViewDef *def);

/* The name of the colormap in force. */
const char *view_colormap(const ViewDef *def);

/* What auto stands for; never VIEW_AUTO. `moving`: in a window. */
ViewQuality view_quality(const ViewDef *def, bool moving);

/* The def as it is drawn: of a quality other than good the view changes its own keys and the resolution where
   they are at their defaults. `moving`: in a window. */
ViewDef view_at_quality(const ViewDef *def, bool moving);

/* Whether the view's own colours are a clear fluid's: looks and shadings water and jelly. */
bool view_shows_clear_fluid(const ViewDef *def);

/* Whether foam is drawn: on clear fluid in three dimensions, and not in a draft. */
bool view_has_foam(const ViewDef *def);

/* Whether the box is drawn as glass: not in two dimensions, and with `auto` where the view's own colours are
   a clear fluid's. Panes and what else costs time: not in a draft. */
bool view_has_glass(const ViewDef *def);

/* The same for pictures in files, which nobody waits for: auto is best. */
ViewDef view_in_file(const ViewDef *def);

/* A bit a Scalar, the first the lowest: those whose range follows the state. The fluids' own colours have
 * none. */
uint64_t view_def_ranges(const ViewDef *def);

/* Defaults of all that views share; kind and own settings: views_default, overlays_default. */
ViewDef view_def_shared(void);

#endif
