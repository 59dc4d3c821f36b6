/* What the passes of raycasting know of the volume and of the march; render/volume/raycast.c fills it. Volume
   space: 0..1 of the texture. */
#ifndef SLOSH_RAYCAST_BLOCK_H
#define SLOSH_RAYCAST_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/volume/volume_bindings.h"

UNIFORM_BLOCK(RaycastBlock, RAYCAST_BLOCK)
{
    mat4 eye_to_volume; /* m */
    mat4 volume_to_eye;
    vec3 volume_cells;
    float cell_size; /* m */
    vec3 brick_count;
    float brick_side;  /* cells */
    vec3 wall_low;     /* of the walls at which fluid ends; beyond the volume where there are none */
    float brick_least; /* field that a brick with fluid exceeds */
    vec3 wall_high;
    float surface_level;
    vec3 field_low;    /* nearer to a wall the field is as here */
    float step_length; /* m */
    vec3 field_high;
    float far_step;      /* the longest, far from the surface, m */
    float near_start;    /* depth where all rays start, m; 0: at faces */
    float ramp_begin;    /* field at which opacity begins */
    float ramp_scale;    /* 1 / (field at which it is full - ramp_begin) */
    float extinction;    /* where it is full, 1/m */
    float skin_depth;    /* optical depth of the skin, where opacity rises from none to full */
    float opacity_low;   /* of the range of the scalar by which opacity goes */
    float opacity_scale; /* 1 / its width */
    float enough_light;  /* share of light at which a ray ends */
    uint jitter;         /* 1: rays begin at random */
}
BLOCK_END(RaycastBlock);

#endif
