/* A picture and its inputs: the settings of a scene's pictures, the camera and its handles, the target, and
   the frame that each pass reads. */
#ifndef RENDER_FRAME_FRAME_H
#define RENDER_FRAME_FRAME_H

#include "sim/base/base.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The picture settings of a scene: plain data. */

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
    CAMERA_KEYS_MAX = 1000, /* a bound of the work: a path is as long as its count */
    VIEW_TITLE_SIZE = 96,
    VIEW_KINDS_MAX = 8,
    OVERLAY_KINDS_MAX = 4,
    FINEST_RESOLUTION = 2, /* of ViewDef.resolution */
    VIEW_OWN_SIZE = 3072,
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

/* Room for the own settings of all views, then of all overlays, in the order of the lists; only the owner
   knows the struct. See view_own_settings and overlay_own_settings in render/frame/view.h. */
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
    char kind[NAME_SIZE];      /* see view_list; "none": no view */
    Scalar color_by;           /* SCALAR_FLUID: the fluids' own colours; SCALAR_COUNT: auto, see
                                  view_color_by */
    char colormap[NAME_SIZE];  /* see colormap_choices, view_colormap */
    bool range_auto;           /* the range follows each state; else range[0] .. range[1] */
    bool range_symmetric;      /* an automatic range is as wide below 0 as above */
    double range[2];           /* in the scalar's unit */
    ControlPoints color_curve; /* bends the colormap */
    ScalarCurve opacity;       /* 0 .. 1 */
    ScalarCurve size;          /* factor of the radius */
    double radius;             /* particle radius in spacings; 0: the view's default */
    bool legend;               /* draw the legend */
    bool box;                  /* draw the box's edges */
    int walls;                 /* a ViewWalls */
    bool caustics;             /* light patterns below clear fluid */
    double foam;               /* how easily clear fluid foams: 1 as documented, 0 never */
    bool floor;                /* draw the floor below the box */
    bool camera_auto;          /* the camera shows the whole box; else `camera` */
    CameraDef camera;
    double camera_turn;           /* degrees per second about the vertical through the target
                                     point */
    int camera_path_count;        /* number of keyframes; 0: no path */
    const CameraKey *camera_path; /* times ascend; the creator owns the array */
    double camera_yaw;            /* rotation of an automatic camera, radians: set by camera_at; 0 in a
                                     scene */
    char title[VIEW_TITLE_SIZE];  /* over the picture; "": none */
    bool carries_scene;           /* PNG files contain the scene as text */
    double background[3];         /* linear RGB 0..1, at the horizon */
    int quality;                  /* a ViewQuality: changes keys with default values, see view_at_quality */
    int drawn_quality; /* not a key: chosen for this picture by view_at_quality; VIEW_AUTO before */
    double resolution; /* pixels drawn per pixel shown, along each axis; more than 0, at most 2 */
    ViewOwnSettings own;
    /* For one of several views: the source of its states; none: the scene. Not read in render. */
    const char *file; /* a recorded run; NULL: none */
    const char *set;  /* the scene with these settings changed: KEY_SETTINGS; NULL: none */
    double time;      /* of the states shown, s; below 0: the scene's */
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

/* The def's quality, with auto resolved; never VIEW_AUTO. `moving` is true in a window. */
ViewQuality view_quality(const ViewDef *def, bool moving);

/* The def as drawn: at a quality other than good, the view changes own keys and the resolution, where
   these have default values. `moving` is true in a window. */
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

/* The viewpoint of a picture: camera, lines of sight through pixels, and handles that a user drags. There
   is no GL and no window here. */

/* The camera of a picture. Right-handed, y up, looks along -z; perspective with reversed depth and an
   infinite far plane: depth = near / distance along the axis. Matrices are column-major. */

typedef struct Camera {
    float eye[3];     /* m, world */
    float view[16];   /* world to eye */
    float tangent[2]; /* of half the field of view, in x and y */
    float centre[2];  /* position of the axis in the picture, -1 .. 1 to the right and up; not 0 if a panel
                         covers a side */
    float near_plane; /* m */
} Camera;

/* The parts of a picture covered by a panel on the left, and by a legend in the upper right corner: fractions
   of width (left, right) and height (top), 0 .. 1. Any camera moves the view's axis to the middle of the area
   right of the panel; an automatic camera also keeps the box's corners clear of the legend. */
typedef struct CoveredParts {
    double left, right, top;
} CoveredParts;

/* The larger of each part. */
CoveredParts covered_by_both(CoveredParts a, CoveredParts b);

/* The squared tangent of the largest angle between a ray and the axis. */
float camera_max_slant_squared(const Camera *camera);

/* The def's camera. With camera_auto: a camera that shows the whole box from the front, the right and
   above, in the uncovered part of a picture with the given `aspect` (width / height). The automatic camera
   stands still while the box moves by less than half its size, and follows only the rest of the motion. */
void camera_make(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                 CoveredParts covered, Camera *camera);

/* The def at a time, s: the camera is moved along `view.camera_path` and turned. The path is a cubic curve
   through the keyframes in time, with continuous velocity. The velocity at a keyframe is the mean velocity
   between the keyframes before and after; 0 at both ends, where the camera rests. */
ViewDef camera_at(const ViewDef *def, double time);

/* Removes path and turning of the camera from the def. */
void camera_stop(ViewDef *def);

/* The point that the automatic camera and the floor follow: the box's position minus a free way of half
   the box's size. */
void camera_anchor(const double box_size[3], const BoxState *box, float anchor[3]);

/* Pose of the box as a matrix: box frame to world. */
void camera_box_matrix(const BoxState *box, float matrix[16]);

/* out = a b, out = inverse of a rigid motion a, out = a (x, 1). `out` may be an argument. */
void matrix_multiply(const float a[16], const float b[16], float out[16]);
void matrix_invert_rigid(const float a[16], float out[16]);
void matrix_transform(const float a[16], const float x[3], float out[3]);

/* The pixel (from the left, from the top) and the reversed depth of a point in the world. Returns false if
   the point is behind the near plane. */
bool camera_project(const Camera *camera, const double world[3], int width, int height, double pixel[2],
                    double *depth);

/* Handles: parts of a picture that a user drags with the mouse. A view (see ViewKind) gives position and
   direction of each handle; this file finds and drags handles. Pure: no GL, no window. Positions are in
   the box's frame, m; pixels count from the left and the top. */

typedef enum HandleLook {
    HANDLE_DOT,
    HANDLE_RING, /* around `from`, perpendicular to `axis`, through `at` */
    HANDLE_ARROW /* from `from` to `at` */
} HandleLook;

typedef enum HandleMotion {
    HANDLE_ALONG,  /* the line through `at` along `axis` */
    HANDLE_WITHIN, /* the plane through `at` perpendicular to `axis` */
    HANDLE_AROUND  /* the sphere around `from` through `at` */
} HandleMotion;

typedef struct Handle {
    const char *help; /* effect of dragging the handle */
    HandleLook look;
    HandleMotion way;
    double at[3], from[3];
    double axis[3]; /* unit vector */
} Handle;

enum { HANDLES_MAX = 16, HANDLE_RING_PARTS = 48 };

/* The viewpoint; `box` is the pose of the picture's state. */
typedef struct Sight {
    Camera camera;
    BoxState box;
    int width, height; /* pixels */
    double reach;      /* capture distance of the mouse, pixels */
} Sight;

/* The line of sight of a pixel: a point and a unit vector. */
typedef struct SightRay {
    double from[3], along[3];
} SightRay;

/* Returns false if `at` is behind the eye. */
bool sight_pixel(const Sight *sight, const double at[3], double pixel[2]);
void sight_ray(const Sight *sight, const double pixel[2], SightRay *ray);

/* The point where a ray meets the plane through `at` perpendicular to `axis`. Returns false if there is
   none in front of the eye, or if the angle is too flat. */
bool sight_ray_plane(const SightRay *ray, const double at[3], const double axis[3], double hit[3]);

/* Corner `part` of HANDLE_RING_PARTS around a ring. */
void handle_ring(const Handle *handle, int part, double corner[3]);

/* The nearest handle within reach of a pixel; -1: none. A ring is found by its line, an arrow by the end. */
int handle_at_pixel(const Sight *sight, const Handle *handles, int count, const double pixel[2]);

/* The new position of a handle taken by the ray `first`, with the mouse at `now`. Returns false if the
   position is undefined. */
bool handle_drag(const Handle *taken, const SightRay *first, const SightRay *now, double at[3]);

/* All inputs of a pass for one picture: colours, target, counts, and the frame with camera, light, floor,
   radii and ranges. Needs a current OpenGL 4.5 core context. */

/* Colormaps: from a number in 0 .. 1 to a colour. */

extern const char *const *const colormap_list; /* names, ended by NULL */
extern const char *const colormap_choices[];   /* "auto", then the names */

/* Returns `name`, or the colormap that "auto" stands for with this scalar. */
const char *colormap_of(const char *name, Scalar scalar);

enum { COLORMAP_SIZE = 256 };

/* Fills `rgb` with COLORMAP_SIZE sRGB colours. Returns false if `name` is unknown. */
bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE]);

/* As colormap_fill, bent by a curve: position x in the scalar's range gets the colour at the curve's y. */
bool colormap_fill_bent(const char *name, const ControlPoints *curve, uint8_t rgb[3 * COLORMAP_SIZE]);

/* A colormap for shaders: a texture of COLORMAP_SIZE x 1 texels, sRGB. */
typedef struct ColorTable {
    unsigned texture;
    const char *name; /* one of colormap_list */
    ControlPoints curve;
} ColorTable;

/* Returns false, with the reason, if `name` is unknown; color_table_destroy is allowed in either case. */
bool color_table_create(ColorTable *table, const char *name, const ControlPoints *curve, Error *error);
void color_table_destroy(ColorTable *table);

/* Bends the colormap by `curve` and binds the texture for shaders (COLORMAP_UNIT). */
void color_table_bind(ColorTable *table, const ControlPoints *curve);

/* For owners of one table for changing colormaps: changes the table to `name` and `curve` if different.
   The table may be zeroed. */
void color_table_update(ColorTable *table, const char *name, const ControlPoints *curve);

/* The off-screen framebuffer of a picture.

   Colour is 8-bit sRGB: shaders write linear light and the framebuffer encodes. Depth is 32-bit float and
   reversed: 1 at the near plane, 0 at infinity. */

typedef struct Target {
    int width, height;
    unsigned number; /* unique per target; GL names of textures are reused */
    unsigned framebuffer;
    unsigned color; /* texture, SRGB8_ALPHA8 */
    unsigned depth; /* texture, DEPTH_COMPONENT32F */
} Target;

bool target_create(Target *target, int width, int height, Error *error);
void target_destroy(Target *target);

/* Binds the target, clears its depth (the backdrop will fill the colour), and sets the depth convention
   for all later drawing. */
void target_begin(const Target *target);

/* Reads 3 * width * height bytes, rows from the top down; waits for the GPU. */
void target_read(const Target *target, uint8_t *rgb);

/* Copies the encoded colour into the default framebuffer, lower left corner at x, y, and leaves the
   default framebuffer bound. */
void target_present(const Target *target, int x, int y);

/* Reads width * height depths, rows from the bottom up; for tests and picking. */
void target_read_depth(const Target *target, float *depth);

/* Coverage and fragments of a picture, counted while drawing a picture that is not timed. */

typedef struct ViewCounts {
    bool counted;    /* the view has counted; false: all is 0 */
    double coverage; /* fraction of the picture's pixels that the fluid's surface covers, including pixels
                        where a solid is in front */
    double fragments[STAGE_COUNT]; /* fragments that the stage's sprites write, per covered pixel; includes
                                      corners of sprites that the shader or an early driver test lets pass;
                                      0: not counted */
    unsigned query;                /* GL query while a stage is being counted */
} ViewCounts;

/* Call around a stage's draw calls; the counts add up. NULL: does nothing. counts_end waits for the GPU. */
void counts_begin(ViewCounts *counts);
void counts_end(ViewCounts *counts, Stage stage);

/* Call at the end of a picture: `covered` of `pixels` pixels are covered. */
void counts_finish(ViewCounts *counts, uint64_t covered, uint64_t pixels);

/* All inputs of a pass for one picture. */

/* FrameFluid.clear of water and jelly: much of the light goes through; light that waves refract lands
   elsewhere. */
#define CLEAR_FLUID_LIGHT 0.35F

/* The key light. Made by frame_make. */
typedef struct FrameLight {
    float to[3];          /* unit vector towards the light, world */
    float from_world[16]; /* orthographic, to 0..1 in the shadow map, 1 nearest to the light */
    float depth;          /* m in the world between 0 and 1 of the shadow map's depth */
} FrameLight;

/* The floor below the box. Made by frame_make, the light by the effects solid_shadow to caustics. */
typedef struct FrameFloor {
    float height;        /* m, world */
    float center[2];     /* x z, m */
    float radius;        /* distance where the floor has faded, m; 0 without a floor */
    float map_corner[2]; /* x z of the shadow map on the floor, around all shadows of box and solids, m */
    float map_size[2];   /* m */
    unsigned light;      /* GL texture, R32F: light that reaches the floor, above 1 where it is focused;
                            0: not known */
} FrameFloor;

/* Radii of a particle, m. Made by view_radii. */
typedef struct ParticleRadii {
    float drawn;
    float reach;  /* largest distance from a particle's centre that drawing may reach */
    float shadow; /* in the shadow map */
} ParticleRadii;

/* Where the picture may show particles. Made by frame_make. */
typedef struct FrameExtent {
    float bounds[4];  /* x0 x1 y0 y1 in -1..1; the whole picture if particles may be beside or behind the
                         eye */
    float nearest;    /* least distance along the eye's axis, m; may be negative */
    float farthest;   /* greatest distance along the eye's axis, m */
    bool all_in_view; /* every particle is inside the picture and in front of the near plane */
} FrameExtent;

/* How light goes through the fluid. Made by frame_make for opaque fluid; a view changes it in
   ViewKind.show. */
typedef struct FrameFluid {
    float clear;       /* fraction of light that the fluid lets through to the floor and to solids inside */
    float refraction;  /* refractive index of a clear fluid */
    float attenuation; /* distance at which white light takes a clear fluid's colour if the scene gives none,
                          m */
} FrameFluid;

enum { FRAME_PARTS_MAX = 8 };

/* A part of the picture with an entry in the legend. */
typedef struct FramePart {
    bool own;       /* true: `color`; false: the colours of the scalar shown */
    float color[3]; /* linear */
    char words[64];
} FramePart;

/* What the colours mean, for views and the legend. Made by frame_make for the def's scalar; a view changes
   it in ViewKind.show. */
typedef struct FrameColors {
    const char *name, *unit; /* of the scalar shown */
    double range[2];         /* in the scalar's unit; range[0] < range[1] */
    bool beyond[2];          /* the automatic range excludes values below, above */
    bool by_fluid;           /* particles have the fluids' own colours */
    bool fluids_known;       /* the state says which fluid each particle is of */
    bool none;               /* no colour depends on `range`: the legend leaves the range out */
    int part_count;
    FramePart parts[FRAME_PARTS_MAX];
} FrameColors;

/* Opacity and size by scalars. Made by frame_make. */
typedef struct FrameCurves {
    unsigned drawn;             /* the curves that the view draws: VIEW_OPACITY, VIEW_SIZE */
    double opacity[2], size[2]; /* ranges of the scalars; 0 without a curve */
} FrameCurves;

struct OverlayDepth;
struct Neighbourhood;

/* A picture as all its passes see it. */
typedef struct Frame {
    int width, height; /* pixels */
    float fineness;    /* pixels drawn per pixel shown along each axis, at least 1: lines are so much wider */
    const ViewDef *def;
    const WorldDef *world;
    const BoxState *floating; /* poses of the world's floating solids: ParticleBuffers.floating */
    const Target *target;
    GlTimer *timer;     /* NULL: not measured */
    ViewCounts *counts; /* NULL: not counted */
    bool *stale; /* set to true if a pass shows a number of the previous picture; NULL: wait for the GPU
                    instead */
    bool more;   /* further pictures follow at once: views and overlays may spread work over several */
    bool plain;  /* unlit colours, without light and shadow */
    bool depths; /* overlays and edges write depth only */
    Camera camera;
    float box_to_world[16];
    double slab; /* depth of the box in a two-dimensional scene, m; 0 in three dimensions */
    FrameLight light;
    FrameFloor floor;
    ParticleRadii radii;
    FrameExtent extent;
    FrameFluid fluid;
    FrameColors colors;
    FrameCurves curves;
    bool flat;      /* the view is no look into space (a flat slice): no edges of the box */
    bool no_solids; /* the view draws the solids itself */

    /* Grid of the picture's particles (render/particles/particles.h), for passes that said so in
       ParticleWants.neighbours. */
    struct Neighbourhood *neighbourhood;
    /* Depths over the view (render/frame/passes.h), for a view with draw_front; NULL: none. */
    const struct OverlayDepth *over;
} Frame;

/* Frame.slab: a two-dimensional scene is as deep as one particle layer. */
double frame_slab_depth(const ParticleBuffers *particles);

/* Fills all of `frame`, with fineness 1, except timer, counts, stale, more, plain, depths, floor.light,
   neighbourhood and over. */
void frame_make(Frame *frame, const Subject *subject, const ParticleBuffers *particles, const Target *target,
                ParticleRadii radii, CoveredParts covered);

/* How the frame draws the box. */
typedef enum FrameGlass { GLASS_NONE /* lines */, GLASS_EDGES, GLASS_PANES /* and edges */ } FrameGlass;

FrameGlass frame_glass(const Frame *frame);

/* frame->extent.bounds in pixels: x0 y0 x1 y1. */
void frame_bounds(const Frame *frame, int part[4]);

/* Sets the scissor to frame->extent.bounds. The caller ends it. */
void frame_set_scissor(const Frame *frame);

/* Creates the uniform block of shaders/shared/frame_block.h; the caller deletes the buffer. */
unsigned frame_uniforms_create(void);

/* Fills the block and binds the buffer for all passes. */
void frame_uniforms_update(unsigned buffer, const Frame *frame, const double box_size[3], double spacing);

#endif
