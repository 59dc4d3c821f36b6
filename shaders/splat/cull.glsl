// Culling of hidden particles on a coarse map, for render/splat/cull.c. A cell holds a depth behind which nothing can be seen in it: that
// of the nearest sprite that covers all of its pixels' centres. A particle whose sprite lies behind all cells that it
// touches is hidden. Two projections: the eye's, with depth along its axis, and with LIGHT the shadow map's.
layout(location = 1) uniform uvec4 grid;       // columns, rows; pixels along a cell's side; how far maxima reach, cells
layout(location = 2) uniform vec4 projection;  // pixels wide, high; LIGHT: half the side of a point of the view's radius, pixels
layout(std430, binding = 4) buffer Nearest { uint nearest[]; }; // bits of a depth that is not negative: ordered as it is

const uint nothing = 0x7f800000u; // infinity

#ifdef LIGHT
vec4 light_pixel(uint index) // pixel, depth, half the side of its point where the driver draws it no larger
{
    vec4 ball = ball_of(index);
    vec3 at = (box_to_light * vec4(ball.xyz, 1.0)).xyz;
    return vec4(at.xy * projection.xy, 1.0 - at.z, projection.z * (ball.w / particle_radius));
}
#endif
