// Culling of hidden particles on a coarse map, for render/splat/cull.c. A cell holds a depth behind which nothing can be seen in it: that
// of the nearest sprite that covers all of its pixels' centres. A particle whose sprite lies behind all cells that it
// touches is hidden. Two projections: the eye's, with depth along its axis, and with LIGHT the shadow map's.
#include "shaders/splat/splat_bindings.h"
layout(location = CELLS_AT) uniform uvec2 cell_count; // columns, rows
layout(location = CELL_SIDE_AT) uniform uint cell_side; // pixels
layout(location = WIDEN_REACH_AT) uniform uint widen_reach; // how far maxima reach, cells
layout(location = CULL_PIXELS_AT) uniform vec2 cull_pixels; // of the picture or the shadow map, wide and high
layout(location = POINT_HALF_AT) uniform float point_half; // LIGHT: half the side of a point of the view's radius, pixels
layout(std430, binding = CULL_MAP_STORAGE) buffer Nearest { uint nearest[]; }; // bits of a depth that is not negative: ordered as it is

const uint nothing = 0x7f800000u; // infinity

#ifdef LIGHT
struct LightPoint {
    vec2 pixel;
    float depth;
    float half_side; // pixels, where the driver draws it no larger
};

LightPoint light_point(uint index)
{
    Ball ball = ball_of(index);
    vec3 at = (box_to_light * vec4(ball.centre, 1.0)).xyz;
    return LightPoint(at.xy * cull_pixels, 1.0 - at.z, point_half * (ball.radius / particle_radius));
}
#endif
