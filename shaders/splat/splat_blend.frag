// Pass 2, attribute blending: sums of weighted colours, normals and weights of the spheres within eps of the nearest one.
// After: Adams et al. 2006, section 3.2. W1 (eq. 6) is 1 on the ray to the centre and 0 at the silhouette; W2 (eq. 7) 1 at the
// nearest depth and 0 at eps behind it.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = EPS_AT) uniform float eps; // m
layout(location = 2) flat in vec3 color;
layout(early_fragment_tests) in;
layout(location = 0) out vec4 color_sum;
layout(location = 1) out vec4 normal_sum;
#ifdef DISCS
layout(location = 7) flat in float gain;  // see splat/splat_small.glsl
layout(location = 2) out vec2 weight_sum; // weight; covered part of the pixel, above 1e8: all of the pixel
#else
layout(location = 2) out float weight_sum;
#endif

// In half precision, as in the sums of hardware, a colour times a smaller weight has too few bits for dividing by the weight.
const float least_weight = 1e-4;

// True if the previous pass found exactly this depth. A driver that rounds differently there has errors of up to 1e-3 of a radius
// at the rim, where the root is steep. A radius is mostly below 1e-2 of the depth: `slack` 1e-5 loses no pixel. Vectors to
// outlines need less slack, since the vectors of all spheres in the slack add up.
bool foremost(Splat hit, float nearest, float slack)
{
    return hit.depth <= nearest + slack * nearest;
}

float weight_of(Splat hit, float nearest)
{
#if WEIGHTS == 0
    return foremost(hit, nearest, 1e-5) ? 1.0 : 0.0;
#else
    float w1 = WEIGHTS == 3 ? 1.0 : 1.0 - sqrt(max(1.0 - hit.inside2, 0.0)); // eq. 6
    float w2 = WEIGHTS == 1 ? 1.0 : (nearest + eps - hit.depth) / eps;         // eq. 7
    return max(w1 * w2, least_weight);
#endif
}

// The vector from the ray to the outline on the screen, in the view's radii. On the screen 1 - rho falls by |beside.xy| / rho per
// radius in this direction.
vec2 rim_of(Splat hit)
{
    float rho = sqrt(max(1.0 - hit.inside2, 0.0));
    vec2 rim = hit.beside * ((1.0 - rho) * rho / max(dot(hit.beside, hit.beside), 1e-12));
#ifdef DROPS
    rim *= radius / particle_radius;
#endif
    return rim;
}

// Software drivers alone draw points, and blend each block of a shader with discard even if hidden: there zeros are added
// instead.
void main()
{
    Splat hit = splat_here();
    float nearest = texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x;
    bool adds = splat_seen(hit) && hit.depth < nearest + eps;
#ifndef POINT
    if (!adds)
        discard;
#endif
    float weight = weight_of(hit, nearest);
    vec2 rim = vec2(0.0);
#ifdef DISCS
    rim = foremost(hit, nearest, 1e-6) ? rim_of(hit) : vec2(0.0);
#endif
    color_sum = adds ? vec4(weight * color, rim.x) : vec4(0.0);
    normal_sum = adds ? vec4(weight * hit.normal, rim.y) : vec4(0.0);
#ifdef DISCS
    weight_sum = adds ? vec2(weight, gain * hit.inside2) : vec2(0.0);
#else
    weight_sum = adds ? weight : 0.0;
#endif
}
