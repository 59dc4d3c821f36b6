// Packs the neighbour data of sums into texels, in the order of cells: velocity or scalar, and volume. Particles with values that
// are not finite get weight 0.
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
