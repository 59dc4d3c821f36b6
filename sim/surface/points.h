/* Points on surfaces, from samplers to renderers: an array of SurfacePoint is copied to a GL buffer
   unchanged. In std430 the layout is
     struct SurfacePoint { float x, y, z; uint normal; uint surface; float value; };
   with a stride of 24 bytes (six scalars, no vec3, which would be padded to 32). As vertex attributes: 3
   floats at 0, 2 normalised shorts (GL_SHORT) at 12, 1 unsigned integer at 16, 1 float at 20.

   Sets (L_R of Tanaka et al. 2012): point i belongs to set i mod sets. So an array can be split into any
   number of sets. Adjacent points are in different sets, and a walk's consecutive points, which are close in
   space, are adjacent in the array. */
#ifndef SLOSH_SURFACE_POINTS_H
#define SLOSH_SURFACE_POINTS_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct SurfacePoint {
    float position[3]; /* m, the box's frame */
    uint32_t normal;   /* unit, packed by surface_normal_pack; towards greater values of the field */
    uint32_t surface;  /* index given by the sampler's caller */
    float value;       /* scalar for colouring, in the scalar's unit; the level if no scalar is given */
} SurfacePoint;

_Static_assert(sizeof(SurfacePoint) == 24, "a SurfacePoint goes to a GL buffer as it is");

/* Owns its memory. Zero-initialise. */
typedef struct SurfacePoints {
    size_t count, capacity;
    SurfacePoint *point; /* count */
} SurfacePoints;

/* Makes room for `capacity` points in total; keeps the contents. Returns false, with nothing changed, if
   memory is short. */
bool surface_points_reserve(SurfacePoints *points, size_t capacity, Error *error);

void surface_points_free(SurfacePoints *points); /* a zeroed struct is allowed */

/* The unit vector on an octahedron, x / (|x| + |y| + |z|) with the lower half folded outwards, as two 16-bit
   signed normalised integers, x in the low half: GLSL's unpackSnorm2x16. After: Meyer et al., "On
   floating-point normal vectors", 2010. Errors below 0.004 degrees. A zero vector gives +z. Unpacking in
   GLSL: vec2 e = unpackSnorm2x16(normal); vec3 n = vec3(e, 1 - abs(e.x) - abs(e.y)); float t = max(-n.z, 0);
   n.xy -= t * vec2(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1); n = normalize(n); */
uint32_t surface_normal_pack(const float normal[3]);
void surface_normal_unpack(uint32_t packed, float normal[3]);

#endif
