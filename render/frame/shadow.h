/* The shadow maps, seen from the light. A view draws its casters between shadow_begin and shadow_end;
   spheres.frag and the floor read the maps. Solids have a separate map, present only in scenes with
   solids: shadows of solids are full at once, while the fluid's own shadow fades with depth. */
#ifndef SLOSH_SHADOW_H
#define SLOSH_SHADOW_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct Shadow {
    unsigned framebuffer, map;             /* depth, SHADOW_MAP_TEXELS squared */
    unsigned floor_framebuffer, floor_map; /* light left on the floor, FLOOR_MAP_TEXELS squared */
    unsigned floor_program, vertex_array;
    unsigned solid_framebuffer, solid_map, solid_floor_program; /* 0 without solids */
} Shadow;

bool shadow_create(Shadow *shadow, Error *error);
void shadow_destroy(Shadow *shadow);

/* Creates or drops the solids' map. Returns false on failure and changes nothing. */
bool shadow_follow_solids(Shadow *shadow, bool solids, Error *error);

/* Change framebuffer, viewport and depth function: for the casters of a view; for solids. */
void shadow_begin(const Shadow *shadow);
void shadow_begin_solids(const Shadow *shadow);

/* Draws the shadow on the floor if the frame has a floor, and binds the maps to texture units: 0, and 4
   for solids. */
void shadow_end(const Shadow *shadow, const Frame *frame);

#endif
