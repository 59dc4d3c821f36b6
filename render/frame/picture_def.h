/* The picture settings of a scene: plain data. */
#ifndef RENDER_FRAME_PICTURE_DEF_H
#define RENDER_FRAME_PICTURE_DEF_H

#include "sim/base/tables.h"
#include "slosh/def.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct CameraDef {
    double from[3]; /* eye, m, world's frame */
    double to[3];   /* target point, m */
    double fov_deg; /* vertical field of view, degrees */
} CameraDef;

/* The camera at a time, s. */
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
    VIEW_SET_SIZE = 512
};

/* Quality: the time that a picture may take. */
typedef enum ViewQuality {
    VIEW_AUTO,  /* best in files, draft for clear fluid in a window on a software driver, else good */
    VIEW_DRAFT, /* fast enough for motion */
    VIEW_GOOD,  /* as all keys say */
    VIEW_BEST
} ViewQuality;

extern const char *const view_quality_names[]; /* ended by NULL */

/* How the walls of the box are drawn, if ViewDef.box. */
typedef enum ViewWalls {
    VIEW_WALLS_AUTO, /* glass if the view shows clear fluid, else lines */
    VIEW_WALLS_LINES,
    VIEW_WALLS_GLASS
} ViewWalls;

extern const char *const view_walls_names[]; /* ended by NULL */

/* Room for the own settings of a view or an overlay; only the owner knows the struct. See view_own_settings
   in render/frame/view.h, overlay_own_settings in render/frame/view.h. */
typedef struct ViewOwnSettings {
    _Alignas(8) unsigned char bytes[VIEW_OWN_SIZE];
} ViewOwnSettings;

/* A property of a particle that depends on a scalar, other than the colour. */
typedef struct ScalarCurve {
    int by;               /* 1 + a Scalar; 0: no curve, and the rest has no effect */
    bool range_auto;      /* the range follows each state; else range[0] .. range[1] */
    bool range_symmetric; /* an automatic range is as wide below 0 as above */
    double range[2];      /* in the scalar's unit */
    ControlPoints curve;
} ScalarCurve;

typedef struct ViewDef {
    char kind[NAME_SIZE];                    /* see view_list; "none": no view */
    Scalar color_by;                         /* SCALAR_FLUID: the fluids' own colours; SCALAR_COUNT: auto, see
                                                view_color_by */
    char colormap[NAME_SIZE];                /* see colormap_choices, view_colormap */
    bool range_auto;                         /* the range follows each state; else range[0] .. range[1] */
    bool range_symmetric;                    /* an automatic range is as wide below 0 as above */
    double range[2];                         /* in the scalar's unit */
    ControlPoints color_curve;               /* bends the colormap */
    ScalarCurve opacity;                     /* 0 .. 1 */
    ScalarCurve size;                        /* factor of the radius */
    double radius;                           /* particle radius in spacings; 0: the view's default */
    ViewOwnSettings of_view[VIEW_KINDS_MAX]; /* own settings of each view, in the order of the list */
    bool legend;                             /* draw the legend */
    bool box;                                /* draw the box's edges */
    int walls;                               /* a ViewWalls */
    bool caustics;                           /* light patterns below clear fluid */
    double foam;                             /* how easily clear fluid foams: 1 as documented, 0 never */
    bool floor;                              /* draw the floor below the box */
    bool camera_auto;                        /* the camera shows the whole box; else `camera` */
    CameraDef camera;
    double camera_turn;                     /* degrees per second about the vertical through the target
                                               point */
    int camera_path_count;                  /* number of keyframes; 0: no path */
    CameraKey camera_path[CAMERA_KEYS_MAX]; /* times ascend */
    double camera_yaw;           /* rotation of an automatic camera, radians: set by camera_at; 0 in a
                                    scene */
    char title[VIEW_TITLE_SIZE]; /* over the picture; "": none */
    bool carries_scene;          /* PNG files contain the scene as text */
    double background[3];        /* linear RGB 0..1, at the horizon */
    int quality;                 /* a ViewQuality: changes keys with default values, see view_at_quality */
    int drawn_quality;           /* not a key: chosen for this picture by view_at_quality; VIEW_AUTO before */
    double resolution;           /* pixels drawn per pixel shown, along each axis; more than 0, at most 1 */

    /* own settings of each overlay, in the order of the list */
    ViewOwnSettings of_overlay[OVERLAY_KINDS_MAX];
    /* For one of several views: the source of its states; "": the scene. Not read in render. */
    char file[FILE_NAME_SIZE]; /* a recorded run */
    char set[VIEW_SET_SIZE];   /* the scene with these settings changed: KEY_SETTINGS */
} ViewDef;

/* What to show, and how. */
typedef struct Subject {
    const ViewDef *def;
    const WorldDef *world; /* all 0 if unknown */
} Subject;

/* The scalar of a curve; curve->by must not be 0. */
static inline Scalar scalar_of_curve(const ScalarCurve *curve)
{
    return (Scalar)(curve->by - 1);
}

/* The scalar that the colours show; for `auto`, chosen by view and look (ViewKind.own_colors). All code
   that draws, names or checks colours must call this function. */
Scalar view_color_by(const ViewDef *def);

/* The name of the colormap in use. */
const char *view_colormap(const ViewDef *def);

/* The def's quality, with auto resolved; never VIEW_AUTO. `moving`: in a window. */
ViewQuality view_quality(const ViewDef *def, bool moving);

/* The def as drawn: at a quality other than good, the view changes own keys and the resolution, where at
   default values. `moving`: in a window. */
ViewDef view_at_quality(const ViewDef *def, bool moving);

/* True if the view's own colours are of a clear fluid: looks and shadings water and jelly. */
bool view_shows_clear_fluid(const ViewDef *def);

/* True if the def asks for foam: on clear fluid, not in a draft. The renderer draws none in two
   dimensions. */
bool view_has_foam(const ViewDef *def);

/* True if the def asks for a glass box: with `auto` only if the view's own colours are of a clear fluid.
   The renderer draws lines in two dimensions, and no panes in a draft. */
bool view_has_glass(const ViewDef *def);

/* As view_at_quality, for pictures in files, where nobody waits: auto is best. */
ViewDef view_in_file(const ViewDef *def);

/* A bit per Scalar, the first the lowest: scalars with an automatic range. The fluids' own colours have no
   range. */
uint64_t view_def_ranges(const ViewDef *def);

/* Defaults of the settings shared by all views. For kind and own settings: views_default,
   overlays_default. */
ViewDef view_def_shared(void);

#endif
