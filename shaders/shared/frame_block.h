/* What all shaders of pictures know of a frame; render/frame.c fills it.
   Spaces: box (the particles' own), world, eye (camera at the origin, looking along -z), light (0..1 in the
   shadow map). */
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
    vec2 view_tangent;   /* of half the field of view in x and y */
    float near_plane;    /* m */
    float light_depth;   /* m that 0..1 of light space stands for */
    vec2 picture_size;   /* pixels */
    vec2 pixel_size;     /* shares of the picture's width and height */
    vec3 light_in_eye;   /* unit vector towards the light */
    float shading;       /* its strength; 0 shows plain colours */
    vec3 up_in_eye;      /* unit vector */
    float shadow_radius; /* of a particle as the light sees it, m */
    vec3 light_color;
    float light_radius; /* of soft shadow on the floor, sides of the shadow map */
    vec3 sky_color;
    float particle_radius; /* m */
    vec3 ground_color;
    float particle_spacing; /* m */
    vec3 background;        /* at the horizon */
    float range_low;        /* of the scalar shown */
    vec3 box_size;          /* m */
    float range_scale;      /* 1 / (greatest - least of the scalar shown) */
    vec2 floor_center;      /* x z in the world, m */
    float floor_height;     /* in the world, m */
    float floor_radius;     /* at which the floor has faded, m; 0: there is none */
    vec2 floor_map_corner;  /* x z of the floor's shadow map in the world, m */
    vec2 floor_map_size;    /* m */
    vec4 edge_color;
    vec4 fluid_color[FRAME_FLUIDS_MAX];
    vec2 view_centre;  /* where on the screen the axis of the view is, -1..1 in x and y */
    uint by_fluid;     /* 1: particles have the colours of their fluids, not of the scalar */
    uint walled;       /* axes across which the box has walls: 1 x, 2 y, 4 z */
    float fluid_clear; /* the share of the light that the fluid lets through; 0: it is not clear */
    uint glass;        /* the box is of it: 1 its edges, 2 the rest too; 0: lines */
}
BLOCK_END(FrameBlock);

#endif
