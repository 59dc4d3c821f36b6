// A particle as voxelization needs it.
#include "common/volume.glsl"
#include "common/particles.glsl"

// Centre in cells; what it adds at its centre, 0 where it counts for nothing.
vec4 volume_particle(uint index)
{
    vec3 at = particle_position(index);
    float volume = position_words[index * particle_strides.x + 3u];
    bool counts = all(greaterThanEqual(at, volume_low.xyz)) && all(lessThanEqual(at, volume_high.xyz)) && volume > 0.0 &&
                  volume < 1e30; // false for NaN
    return counts ? vec4(cells_of(at), volume * volume_scale.x) : vec4(0.0);
}

#ifdef SCALAR
float volume_scalar(uint index)
{
    float value = particle_strides.y > 0u ? scalar_words[index * particle_strides.y] : 0.0;
    return abs(value) < 1e30 ? value : 0.0;
}
#endif

// First and last of the cells along an axis that a ball around `at` reaches.
ivec2 cells_within(float at, float radius, int size)
{
    return ivec2(max(int(ceil(at - radius - 0.5)), 0), min(int(floor(at + radius - 0.5)), size - 1));
}
