// A particle's contribution to a sample, by the true distance in space.
#include "shaders/shared/plane_block.h"
#include "common/plane_kernel.glsl"

layout(location = 0) flat in ivec2 cell;
layout(location = 1) flat in vec4 disc;
layout(location = 2) flat in vec2 scalar;
layout(location = 0) out vec4 sums;

void main()
{
    vec2 samples = vec2(ivec2(gl_FragCoord.xy) - cell) + (0.5 - disc.xy), off = samples * (plane_side / plane_support);
    float square = dot(off, off) + disc.z;
    if (square >= 1.0)
        discard;
    float weight = disc.w * plane_shape(sqrt(square));
    sums = vec4(weight * scalar.x, weight * (1.0 - scalar.y), weight * scalar.y, 0.0);
}
