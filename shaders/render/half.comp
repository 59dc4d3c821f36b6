// Sets the positions of particles beyond a plane to NaN: render/particles/particles.h.
#include "common/particles.glsl"

layout(local_size_x = 64) in;
layout(location = HALF_PLANE_AT) uniform vec4 half_plane; // x y z: normal; w: largest distance along the normal that is kept, m
layout(location = HALF_COUNT_AT) uniform uint half_count;
layout(std430, binding = HALF_STORAGE) writeonly buffer Half { vec4 half_positions[]; };

void main()
{
    uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (index >= half_count)
        return;
    vec3 place = particle_position(index);
    float volume = position_words[index * position_stride + 3u];
    bool stays = dot(half_plane.xyz, place) <= half_plane.w;
    half_positions[index] = stays ? vec4(place, volume) : uintBitsToFloat(uvec4(0x7fc00000u));
}
