// Writes each particle into the cells of the coarse map that the particle covers.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "common/scattered.glsl"
#include "splat/cull.glsl"
#include "common/sphere.glsl"
#include "splat/splat_body.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 64) in;
layout(location = CULL_COUNT_AT) uniform uint count;

const float pixel_margin = 1.0 / 64.0; // rasterisers round corners to 1/256 of a pixel

struct Disc {
    vec2 middle, radii; // pixels
    float w, slant;     // depth of the centre, m; tangent of the steepest ray's angle to the axis
    float radius;       // m
};

// The disc through the centre, perpendicular to the eye's axis: inside the sphere, or inside the ball within an ellipsoid. Empty
// if the particle reaches the near plane.
Disc disc_of(uint index)
{
    Body body = body_of(index);
    vec3 centre = body.centre;
    float w = -centre.z, radius = body.inner;
    vec2 scale = 0.5 * cull_pixels / (w * view_tangent);
    bool whole = body_nearest(body) > near_plane;
#ifdef PAPER
    float slant = 0.0; // the paper's rays are parallel to the axis
#else
    float slant = (length(centre.xy) + radius) / w;
#endif
    return Disc(centre.xy * scale + 0.5 * cull_pixels * (1.0 + view_centre), whole ? radius * scale - pixel_margin : vec2(0.0), w, slant, radius);
}

// A ray at distance r from the centre in the disc's plane meets the sphere latest when leaning outwards: as splat_hit with u.d =
// -r slant.
float depth_within(Disc disc, vec2 away)
{
    float r2 = dot(away, away), length2 = 1.0 + disc.slant * disc.slant;
    float k = (sqrt(max(length2 - r2, 0.0)) - sqrt(r2) * disc.slant) / length2;
    return r2 < 0.99 ? (disc.w - disc.radius * k) * 1.00001 : uintBitsToFloat(nothing);
}

void main()
{
    uint index = scattered(count);
    if (index >= count)
        return;
    Disc disc = disc_of(index);
    float side = float(cell_side), margin = 0.5 * (side - 1.0); // from a cell's middle to its outermost pixels' centres
    vec2 reach = disc.radii - margin, per_radius = 1.0 / disc.radii;
    if (is_nan(vec4(disc.middle, disc.radii)) || min(reach.x, reach.y) <= 0.0)
        return;
    vec2 own = floor(disc.middle / side), most = clamp(floor(0.5 * disc.radii / side + 0.5), 1.0, 2.0); // half way to a neighbour is enough
    vec2 low = max(ceil((disc.middle - reach) / side - 0.5), max(own - most, 0.0));
    vec2 high = min(floor((disc.middle + reach) / side - 0.5), min(own + most, vec2(cell_count) - 1.0));
    uint best = floatBitsToUint(max(disc.w - disc.radius, 0.0)); // most particles are behind values already written
    if (any(greaterThan(low, high)) || greatest_in(uvec4(low, high).xzyw, best) <= best)
        return;
    for (float y = low.y; y <= high.y; y++)
        for (float x = low.x; x <= high.x; x++) {
            vec2 away = abs((vec2(x, y) + 0.5) * side - disc.middle) + margin;
            uint depth = floatBitsToUint(depth_within(disc, away * per_radius)), cell = cell_at(uint(x), uint(y));
            if (depth < nearest[cell])
                atomicMin(nearest[cell], depth);
        }
}
