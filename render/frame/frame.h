/* All inputs of a pass for one picture: colours, target, counts, and the frame with camera, light, floor,
   radii and ranges. Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_FRAME_FRAME_H
#define RENDER_FRAME_FRAME_H

#include "render/frame/camera.h"
#include "render/frame/picture_def.h"
#include "sim/base/tables.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/gpu/timer.h"
#include "slosh/error.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stdint.h>

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

/* Frame.clear of water and jelly: much of the light goes through; light that waves refract lands
   elsewhere. */
#define CLEAR_FLUID_LIGHT 0.35F

/* Radii of a particle, m. */
typedef struct ParticleRadii {
    float drawn, reach, shadow; /* Frame.particle_radius, particle_reach, shadow_radius */
} ParticleRadii;

enum { FRAME_PARTS_MAX = 8 };

/* A part of the picture with an entry in the legend. */
typedef struct FramePart {
    bool own;       /* true: `color`; false: the colours of the scalar shown */
    float color[3]; /* linear */
    char words[64];
} FramePart;

typedef struct Frame {
    int width, height; /* pixels */
    const ViewDef *def;
    const WorldDef *world;
    const BoxState *floating; /* poses of the world's floating solids: ParticleBuffers.floating */
    const Target *target;
    GlTimer *timer;     /* NULL: not measured */
    ViewCounts *counts; /* NULL: not counted */
    Camera camera;
    float box_to_world[16];
    float world_to_light[16];   /* orthographic, to 0..1 in the shadow map, 1 nearest to the light */
    float light_depth;          /* m in the world between 0 and 1 of the shadow map's depth */
    float to_light[3];          /* unit vector, world */
    float floor_height;         /* m, world */
    float floor_center[2];      /* x z, m */
    float floor_radius;         /* distance where the floor has faded, m; 0 without a floor */
    float floor_map_corner[2];  /* x z of the floor's shadow map, which covers all shadows of the box and
                                   solids, m */
    float floor_map_size[2];    /* m */
    float particle_radius;      /* m */
    float particle_reach;       /* largest distance from a particle's centre that drawing may reach, m */
    float shadow_radius;        /* particle radius in the shadow map, m */
    double slab;                /* depth of the box in a two-dimensional scene, m; 0 in three dimensions */
    float attenuation;          /* distance at which white light takes a clear fluid's colour if the scene
                                   gives none, m */
    float bounds[4];            /* x0 x1 y0 y1 in -1..1 around all particles; the whole picture if particles
                                   may be beside or behind the eye */
    float nearest;              /* least distance of a particle along the eye's axis, m; may be negative */
    float farthest;             /* greatest distance of a particle along the eye's axis, m */
    bool all_in_view;           /* every particle is inside the picture and in front of the near plane */
    unsigned overlay_depth;     /* GL texture: depths of the target, overlays and edges, for a view with
                                draw_front; 0: no such depths */
    bool overlay_depth_coarse;  /* the overlays' depths are incomplete; the next picture has better ones */
    bool overlay_depth_missing; /* no memory for `overlay_depth` */
    bool depths;                /* overlays and edges write depth only */
    unsigned floor_light;       /* GL texture, R32F: light that reaches the floor, above 1 where it is
                                   focused; 0: not known */
    double range[2];            /* range of the scalar shown, in its unit; range[0] < range[1] */
    bool beyond[2];             /* the automatic range excludes values below, above */
    double opacity_range[2],
        size_range[2]; /* ranges of the scalars of the def's opacity and size; 0 without a curve */
    unsigned curves;   /* the curves that the view draws: VIEW_OPACITY, VIEW_SIZE */
    const char *shown, *shown_unit; /* name and unit of `range` for the legend */
    bool no_solids;                 /* the view draws the solids itself */
    bool no_colors;                 /* no colour depends on `range`: the legend leaves the range out */
    int part_count;
    FramePart parts[FRAME_PARTS_MAX];
    const char *note; /* a line below the legend, static; NULL: none */
    bool by_fluid;    /* particles have the fluids' own colours */
    bool flat;        /* the picture is no view into space (a flat slice): no edges of the box */
    bool more;        /* further pictures follow at once: views and overlays may spread work over several */
    bool *stale;      /* set to true if an overlay shows a number of the previous picture; NULL: wait for
                          the GPU instead */
    float refraction; /* refractive index of a clear fluid */
    int glass;        /* glass box: 1: the edges, 2: the panes too; 0: drawn as lines */
    float clear;      /* fraction of light that the fluid lets through to the floor and to solids inside */
    bool plain;       /* unlit colours, without light and shadow */
} Frame;

/* Radii of balls with the def's radius, or `spacings` particle spacings if the def has 0. */
ParticleRadii frame_ball_radii(const ViewDef *def, const ParticleBuffers *particles, double spacings);

/* Frame.slab: a two-dimensional scene is as deep as one particle layer. */
double frame_slab_depth(const ParticleBuffers *particles);

/* Fills all of `frame` except timer, counts, floor_light, stale and plain. */
void frame_make(Frame *frame, const Subject *subject, const ParticleBuffers *particles, const Target *target,
                ParticleRadii radii, CoveredParts covered);

/* frame->bounds in pixels: x0 y0 x1 y1. */
void frame_bounds(const Frame *frame, int part[4]);

/* Sets the scissor to frame->bounds. The caller ends it. */
void frame_set_scissor(const Frame *frame);

/* Creates the uniform block of shaders/shared/frame_block.h; the caller deletes the buffer. */
unsigned frame_uniforms_create(void);

/* Fills the block and binds the buffer for all passes. */
void frame_uniforms_update(unsigned buffer, const Frame *frame, const double box_size[3], double spacing);

#endif
