// A particle's data for voxelization.
#include "volume/volume.glsl"
#include "common/particles.glsl"
#include "common/nan.glsl"

struct Bump {
    vec3 at;      // cells
    float height; // field at the centre; 0: the particle does not count
};

Bump volume_particle(uint index)
{
    vec3 at = particle_position(index);
    float volume = position_words[index * position_stride + 3u];
    bool counts = !is_nan(vec4(at, volume)) && all(greaterThanEqual(at, volume_low)) && all(lessThanEqual(at, volume_high)) &&
                  volume > 0.0 && volume < 1e30;
    if (!counts)
        return Bump(vec3(0.0), 0.0);
    return Bump(cells_of(at), volume * kernel_peak);
}

#ifdef SCALAR
#include "common/particle_scalars.glsl"

float volume_scalar(uint index)
{
    float value = scalar_stride > 0u ? scalar_words[index * scalar_stride] : 0.0;
    return is_nan(value) || abs(value) >= 1e30 ? 0.0 : value;
}
#endif

// First and last cell along an axis that a ball around `at` reaches.
ivec2 cells_within(float at, float radius, int size)
{
    return ivec2(max(int(ceil(at - radius - 0.5)), 0), min(int(floor(at + radius - 0.5)), size - 1));
}
