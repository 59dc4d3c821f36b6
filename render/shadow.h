/* The shadow map: what the light sees. A view draws its casters between shadow_begin and shadow_end; then
   spheres.frag and the floor read the maps. */
#ifndef SLOSH_SHADOW_H
#define SLOSH_SHADOW_H

#include "render/frame.h"
#include "sim/error.h"

typedef struct Shadow {
    unsigned framebuffer, map;             /* depth, SHADOW_MAP_TEXELS squared */
    unsigned floor_framebuffer, floor_map; /* light left on the floor, FLOOR_MAP_TEXELS squared */
    unsigned floor_program, vertex_array;
} Shadow;

bool shadow_create(Shadow *shadow, Error *error);
void shadow_destroy(Shadow *shadow);

/* Changes framebuffer, viewport and depth function. */
void shadow_begin(const Shadow *shadow);

/* Lays the shadow on the floor if the frame has one, and binds the shadow map to texture unit 0. */
void shadow_end(const Shadow *shadow, const Frame *frame);

#endif
