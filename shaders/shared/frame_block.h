/* Inputs of all shaders for one picture; filled by render/frame/frame.c.

   Spaces: box (the particles' own), world, eye (camera at the origin, looking along -z), light (0..1 in
   the shadow map). */
#ifndef SLOSH_FRAME_BLOCK_H
#define SLOSH_FRAME_BLOCK_H

#include "shaders/shared/bindings.h"
#include "shaders/shared/block.h"

#define FRAME_FLUIDS_MAX 8

UNIFORM_BLOCK(FrameBlock, FRAME_BLOCK)
{
    mat4 box_to_eye;
    mat4 box_to_light;
    mat4 eye_to_light;
    mat4 world_to_light;
    mat4 eye_to_world;
    vec2 view_tangent;   /* half the field of view in x and y */
    float near_plane;    /* m */
    float light_depth;   /* length of 0..1 in light space, m */
    vec2 picture_size;   /* pixels */
    vec2 pixel_size;     /* fractions of the picture's width and height */
    vec3 light_in_eye;   /* unit vector towards the light */
    float shading;       /* strength of shading; 0: plain colours */
    vec3 up_in_eye;      /* unit vector */
    float shadow_radius; /* particle radius in the shadow map, m */
    vec3 light_color;
    float light_radius; /* softness of shadows on the floor, sides of the shadow map */
    vec3 sky_color;
    float particle_radius; /* m */
    vec3 ground_color;
    float particle_spacing; /* m */
    vec3 background;        /* colour at the horizon */
    float range_low;        /* low end of the scalar's range */
    vec3 box_size;          /* m */
    float range_scale;      /* 1 / (high - low end of the scalar's range) */
    vec2 floor_center;      /* x z in the world, m */
    float floor_height;     /* in the world, m */
    float floor_radius;     /* distance where the floor has faded, m; 0: no floor */
    vec2 floor_map_corner;  /* x z of the floor's shadow map in the world, m */
    vec2 floor_map_size;    /* m */
    vec4 edge_color;
    vec4 fluid_color[FRAME_FLUIDS_MAX];
    vec2 view_centre;    /* position of the view's axis on the screen, -1..1 in x and y */
    uint by_fluid;       /* 1: particles have the fluids' colours instead of the scalar's */
    uint walled;         /* axes with walls of the box: 1 x, 2 y, 4 z */
    float fluid_clear;   /* fraction of light that the fluid lets through; 0: opaque fluid */
    uint glass;          /* glass box: 1: the edges, 2: the panes too; 0: lines */
    float fineness;      /* pixels drawn per pixel shown, at least 1 */
    float shadow_spread; /* distance of four samples' places in the shadow map, sides of the map; else 0 */
    vec3 light_in_world; /* unit vector towards the light */
}
BLOCK_END(FrameBlock);

#endif
