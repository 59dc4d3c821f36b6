// The fluid's field F = sum V W and the mean of a quantity at the values of a grid, an invocation per value. As
// render/views/pbsr/fluid_layers.c: the mean is over particles with a number, NaN where all particles lack a number.
#include "common/particles.glsl"
#include "common/particle_shown.glsl"
#include "common/neighbourhood.glsl"
#include "pbsr/grid.glsl"
layout(std430, binding = PBSR_FIELD_STORAGE) writeonly buffer Field { float field[]; };
layout(std430, binding = PBSR_MEAN_STORAGE) writeonly buffer Mean { float mean[]; };
layout(location = FIELD_SUPPORT_AT) uniform float support; // m
layout(location = FIELD_PEAK_AT) uniform float peak;       // of the kernel, 1/m3 or 1/m2
layout(location = FIELD_BOX_AT) uniform vec3 box_size;     // m
layout(location = FIELD_HAS_MEAN_AT) uniform uint has_mean;

// Fluid that has left the box by more than a support radius is ignored.
bool counts(vec3 x, float volume)
{
    vec3 middle = vec3(0.0, 0.5 * box_size.y, 0.0);
    return volume > 0.0 && volume < 1e30 && all(lessThanEqual(abs(x - middle), 0.5 * box_size + support));
}

// The sums of V W, of V W of particles with a number, and of V W times the number.
vec3 sums_at(vec3 x)
{
    vec3 sums = vec3(0.0);
    uvec3 cell = cell_at(x);
    for (uint row = 0u; row < 9u; row++) {
        uvec2 range = row_of(cell, row);
        for (uint j = range.x; j < range.y; j++) {
            vec3 place = place_of(j), apart = (place - x) * vec3(1.0, 1.0, flat_box != 0u ? 0.0 : 1.0) / support;
            float t = 1.0 - dot(apart, apart);
            if (t <= 0.0)
                continue;
            uint number = number_of(j);
            float volume = position_words[number * position_stride + 3u], value = has_mean != 0u ? particle_shown(number) : 0.0;
            if (is_nan(volume) || !counts(place, volume))
                continue;
            float weight = volume * peak * t * t * t;
            bool known = !is_nan(value) && abs(value) < 1e30;
            sums += vec3(weight, known ? weight : 0.0, known ? weight * value : 0.0);
        }
    }
    return sums;
}

void main()
{
    uint i = invocation();
    if (i >= values_count())
        return;
    vec3 sums = sums_at(value_place(vec3(value_index(i))));
    field[i] = sums.x;
    if (has_mean != 0u)
        mean[i] = sums.y > 0.0 ? sums.z / sums.y : sums.x > 0.0 ? uintBitsToFloat(0x7fc00000u) : 0.0;
}
