/* Inputs of the raycasting passes: the volume and the march; filled by render/views/volume/raycast.c. Volume
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
    vec3 wall_low;     /* walls where fluid ends; outside the volume if there are none */
    float brick_least; /* bricks with fluid exceed this field */
    vec3 wall_high;
    float surface_level;
    vec3 field_low;    /* nearer to a wall, the field is constant from here */
    float step_length; /* m */
    vec3 field_high;
    float far_step;      /* longest step, far from the surface, m */
    float near_start;    /* depth where all rays start, m; 0: at faces */
    float ramp_begin;    /* field where opacity begins */
    float ramp_scale;    /* 1 / (field of full opacity - ramp_begin) */
    float extinction;    /* at full opacity, 1/m */
    float skin_depth;    /* optical depth of the skin, where opacity rises from none to full */
    float opacity_low;   /* low end of the range of the opacity's scalar */
    float opacity_scale; /* 1 / width of that range */
    float enough_light;  /* a ray ends at this remaining fraction of light */
    uint jitter;         /* 1: rays start at random offsets */
}
BLOCK_END(RaycastBlock);

#endif
