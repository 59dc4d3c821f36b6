// What a sum over neighbours reads of each, in the order of their cells, as a texel: its velocity or the scalar, and its volume.
// One that is no number, or not finite, weighs nothing.
#include "common/particles.glsl"
#include "common/neighbourhood.glsl"
#include "derived/derived_read.glsl"
layout(std430, binding = DERIVED_STORAGE) writeonly buffer Others { vec4 others[]; };

void main()
{
    uint at = invocation();
    if (at >= grid_particles)
        return;
    uint i = number_of(at);
    float volume = position_words[i * position_stride + 3u];
    vec4 whole = vec4(velocity_of(i) + vec3(carried_of(i), 0.0, 0.0), volume);
    bool finite = all(notEqual(floatBitsToUint(whole) & 0x7f800000u, uvec4(0x7f800000u)));
    others[at] = finite ? whole : vec4(0.0);
}
