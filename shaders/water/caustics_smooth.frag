// One of two passes that smooth the height over a few spacings, to hide the particles' balls. Much higher or lower texels are
// another surface. The weights (1 - q^2)^3 end at 0 so smoothly that the balls' lattice vanishes: a hundredth of a millimetre
// would be visible.
#include "common/frame.glsl"
#include "shaders/shared/shadow_maps.h"
layout(binding = CAUSTIC_UNIT) uniform sampler2D height_map;
layout(location = CAUSTIC_STEP_AT) uniform ivec2 along;  // a texel in x or y
layout(location = CAUSTIC_WIDTH_AT) uniform float reach; // of the weights, texels
layout(location = 0) out vec3 height;                    // m; fraction of fluid around; mean square deviation, m^2

const float apart = 3.0; // spacings
const int taps = 20;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 here = texelFetch(height_map, texel, 0).xyz;
    float sum = 0.0, squares = here.z, used = 1.0, met = 1.0, all = 1.0, there = here.y, limit = apart * particle_spacing;
    int stride = 1 + int(reach) / taps, count = int(reach) / stride;
    for (int i = -count; i <= count; i++) {
        vec3 other = texelFetch(height_map, clamp(texel + i * stride * along, ivec2(0), ivec2(CAUSTIC_TEXELS - 1)), 0).xyz;
        float q = float(i * stride) / reach, weight = 1.0 - q * q, off = other.x - here.x;
        weight = i == 0 ? 0.0 : weight * weight * weight;
        all += weight, there += weight * other.y;
        weight = other.y > 0.0 ? weight : 0.0;
        bool same = abs(off) < limit;
        met += weight;
        squares += weight * (same ? off * off + other.z : limit * limit);
        weight = same ? weight : 0.0;
        used += weight, sum += weight * off;
    }
    float mean = sum / used;
    height = here.y > 0.0 ? vec3(here.x + mean, there / all, max(squares / met - mean * mean, 0.0)) : vec3(0.0);
}
