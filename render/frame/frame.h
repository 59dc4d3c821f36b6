/* All that a pass needs to know of one picture. */
#ifndef SLOSH_FRAME_H
#define SLOSH_FRAME_H

#include "render/frame/camera.h"
#include "render/frame/counts.h"
#include "render/frame/target.h"
#include "render/frame/view_def.h"
#include "sim/gl/particle_buffers.h"
#include "sim/gl/timer.h"

/* Frame.clear of water and jelly: much of the light goes through; what waves bend aside falls beside. */
#define CLEAR_FLUID_LIGHT 0.35F

/* Of a particle, m. */
typedef struct ParticleRadii {
    float drawn, reach, shadow; /* Frame.particle_radius, particle_reach, shadow_radius */
} ParticleRadii;

enum { FRAME_PARTS_MAX = 8 };

/* A part of the picture, as the legend names it. */
typedef struct FramePart {
    bool own;       /* it has that colour; else those of the scalar shown */
    float color[3]; /* linear */
    char words[64];
} FramePart;

typedef struct Frame {
    int width, height; /* pixels */
    const ViewDef *def;
    const WorldDef *world;
    const BoxState *floating; /* poses of its solids that float: ParticleBuffers.floating */
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
    float floor_radius;        /* at which it has faded, m; 0 without a floor */
    float floor_map_corner[2]; /* x z of the floor's shadow map, which covers all that box and solids may
                                  shade, m */
    float floor_map_size[2];   /* m */
    float particle_radius;     /* m */
    float particle_reach;      /* how far from a particle it may be drawn, m */
    float shadow_radius;       /* of a particle as the light sees it, m */
    double slab;               /* depth of the box of a scene of two dimensions, m; 0 in three */
    float attenuation;         /* through which white light gets a clear fluid's colour where the scene names
                                  no distance, m */
    float bounds[4];           /* x0 x1 y0 y1 in -1..1 that hold all particles; the whole picture when some
                                  may be beside or behind the eye */
    float nearest;             /* least distance of a particle along the eye's axis, m; may be negative */
    float farthest;            /* greatest distance of a particle along the eye's axis, m */
    bool all_in_view;          /* every particle is wholly in the picture and before the near plane */
    unsigned over_depth;       /* GL texture: depths of the target, and of overlays and edges, for a view that
                                  has draw_front; 0: there are none of them */
    bool over_coarse;          /* and those of overlays are not whole yet: the next picture has others */
    bool over_lacks;           /* there is no memory for them */
    bool depths;               /* overlays and edges leave their depth, all that is wanted of them */
    unsigned floor_light;      /* GL texture, R32F: what of the light arrives on the floor, more than 1 where
                                  it is gathered; 0: not known */
    double range[2];           /* of the scalar shown, in its unit; range[0] < range[1] */
    bool beyond[2];            /* an automatic range leaves some out, below and above it */
    double opacity_range[2],
        size_range[2]; /* the same as range of the def's opacity and size; 0 where they have none */
    unsigned curves;   /* which of the two the view draws: VIEW_OPACITY, VIEW_SIZE */
    const char *shown, *shown_unit; /* what that range is of, for the legend */
    bool no_solids;                 /* the view draws the solids in its own way */
    bool no_colors;                 /* nothing is coloured by that range: the legend does not show it */
    int part_count;
    FramePart parts[FRAME_PARTS_MAX];
    const char *note; /* a line below the legend, static; NULL: none */
    bool by_fluid;    /* coloured by the fluids' own colours */
    bool flat;        /* the picture is no look into space: no edges of the box */
    bool more;        /* further pictures follow at once: view and overlays may take their time over
                         several */
    bool *behind;     /* becomes true where an overlay shows a number of the picture before; NULL: the GPU is
                         waited for instead */
    float refraction; /* index of a clear fluid */
    int glass;        /* the box is of it: 1 its edges, 2 the rest too; 0: it is drawn as lines */
    float clear; /* the share of the light that the fluid lets through to the floor and to solids in it */
    bool plain;  /* colours as they are, without light and shadow */
} Frame;

/* Balls of the def's radius; of that many spacings where the def says 0. */
ParticleRadii frame_balls(const ViewDef *def, const ParticleBuffers *particles, double spacings);

/* Frame.slab: a scene of two dimensions is as deep as its particles. */
double frame_slab(const ParticleBuffers *particles);

/* Fills all of `frame` but timer, counts, floor_light, behind and plain. */
void frame_make(Frame *frame, const Subject *subject, const ParticleBuffers *particles, const Target *target,
                ParticleRadii radii, Covered covered);

/* frame->bounds in pixels: x0 y0 x1 y1. */
void frame_bounds(const Frame *frame, int part[4]);

/* Sets the scissor to frame->bounds. The caller ends it. */
void frame_cut_to_bounds(const Frame *frame);

/* The uniform block of shaders/shared/frame_block.h; the caller deletes the buffer. */
unsigned frame_uniforms_create(void);

/* Fills the block and binds it for all passes. */
void frame_uniforms_update(unsigned buffer, const Frame *frame, const double box_size[3], double spacing);

#endif
