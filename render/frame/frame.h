/* All inputs of a pass for one picture. */
#ifndef SLOSH_FRAME_H
#define SLOSH_FRAME_H

#include "render/frame/camera.h"
#include "render/frame/counts.h"
#include "render/frame/target.h"
#include "render/frame/view_def.h"
#include "sim/gl/particle_buffers.h"
#include "sim/gl/timer.h"

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
    float world_to_light[16];  /* orthographic, to 0..1 in the shadow map, 1 nearest to the light */
    float light_depth;         /* m in the world between 0 and 1 of the shadow map's depth */
    float to_light[3];         /* unit vector, world */
    float floor_height;        /* m, world */
    float floor_center[2];     /* x z, m */
    float floor_radius;        /* distance where the floor has faded, m; 0 without a floor */
    float floor_map_corner[2]; /* x z of the floor's shadow map, which covers all shadows of the box and
                                  solids, m */
    float floor_map_size[2];   /* m */
    float particle_radius;     /* m */
    float particle_reach;      /* largest distance from a particle's centre that drawing may reach, m */
    float shadow_radius;       /* particle radius in the shadow map, m */
    double slab;               /* depth of the box in a two-dimensional scene, m; 0 in three dimensions */
    float attenuation;         /* distance at which white light takes a clear fluid's colour if the scene
                                  gives none, m */
    float bounds[4];           /* x0 x1 y0 y1 in -1..1 around all particles; the whole picture if particles
                                  may be beside or behind the eye */
    float nearest;             /* least distance of a particle along the eye's axis, m; may be negative */
    float farthest;            /* greatest distance of a particle along the eye's axis, m */
    bool all_in_view;          /* every particle is inside the picture and in front of the near plane */
    unsigned over_depth;       /* GL texture: depths of the target, overlays and edges, for a view with
                                  draw_front; 0: no such depths */
    bool over_coarse;          /* the overlays' depths are incomplete; the next picture has better ones */
    bool over_lacks;           /* no memory for `over_depth` */
    bool depths;               /* overlays and edges write depth only */
    unsigned floor_light;      /* GL texture, R32F: light that reaches the floor, above 1 where it is
                                  focused; 0: not known */
    double range[2];           /* range of the scalar shown, in its unit; range[0] < range[1] */
    bool beyond[2];            /* the automatic range excludes values below, above */
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
    bool *behind;     /* set to true if an overlay shows a number of the previous picture; NULL: wait for
                         the GPU instead */
    float refraction; /* refractive index of a clear fluid */
    int glass;        /* glass box: 1: the edges, 2: the panes too; 0: drawn as lines */
    float clear;      /* fraction of light that the fluid lets through to the floor and to solids inside */
    bool plain;       /* unlit colours, without light and shadow */
} Frame;

/* Radii of balls with the def's radius, or `spacings` particle spacings if the def has 0. */
ParticleRadii frame_balls(const ViewDef *def, const ParticleBuffers *particles, double spacings);

/* Frame.slab: a two-dimensional scene is as deep as one particle layer. */
double frame_slab(const ParticleBuffers *particles);

/* Fills all of `frame` except timer, counts, floor_light, behind and plain. */
void frame_make(Frame *frame, const Subject *subject, const ParticleBuffers *particles, const Target *target,
                ParticleRadii radii, Covered covered);

/* frame->bounds in pixels: x0 y0 x1 y1. */
void frame_bounds(const Frame *frame, int part[4]);

/* Sets the scissor to frame->bounds. The caller ends it. */
void frame_cut_to_bounds(const Frame *frame);

/* Creates the uniform block of shaders/shared/frame_block.h; the caller deletes the buffer. */
unsigned frame_uniforms_create(void);

/* Fills the block and binds the buffer for all passes. */
void frame_uniforms_update(unsigned buffer, const Frame *frame, const double box_size[3], double spacing);

#endif
