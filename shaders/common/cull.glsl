// Culling of hidden particles on a coarse map, for render/cull.c. A cell holds a depth behind which nothing can be seen in it: that
// of the nearest sprite that covers all of its pixels' centres. A particle whose sprite lies behind all cells that it
// touches is hidden. Two projections: the eye's, with depth along its axis, and with LIGHT the shadow map's.
layout(location = 1) uniform uvec4 grid;       // columns, rows; pixels along a cell's side; how far maxima reach, cells
layout(location = 2) uniform vec4 projection;  // pixels wide, high; LIGHT: half a point's side at least and at most, pixels
layout(std430, binding = 4) buffer Nearest { uint nearest[]; }; // bits of a depth that is not negative: ordered as it is

const uint nothing = 0x7f800000u; // infinity

#ifdef LIGHT
vec3 light_pixel(uint index) // pixel and depth
{
    vec3 at = (box_to_light * vec4(particle_position(index), 1.0)).xyz;
    return vec3(at.xy * projection.xy, 1.0 - at.z);
}
#endif
