// The mean of the fluid around a place: sum V W v over sum V W (Shepard 1968), with Wendland's C2 kernel of the solver's support
// radius. No fluid where sum V W is below `mean_least`. Set by mean_bind of render/particles.
#include "common/particles.glsl"
#include "common/particle_shown.glsl"
#include "common/neighbourhood.glsl"

layout(std430, binding = VECTORS_STORAGE) readonly buffer Vectors { float vector_words[]; };
layout(location = VECTOR_STRIDE_AT) uniform uint vector_stride;
layout(location = MEAN_SUPPORT_AT) uniform float support; // m
layout(location = MEAN_PEAK_AT) uniform float peak;       // of the kernel, 1/m3 or 1/m2

const float mean_least = 0.25;

struct Mean {
    float weight, scalar_weight, scalar, best;
    vec3 vector;
    float fluid; // fluid of the particle with the largest weight
};

void add(inout Mean mean, uint number, float weight)
{
    uint at = number * vector_stride;
    vec3 vector = vec3(vector_words[at], vector_words[at + 1u], vector_words[at + 2u]);
    float value = particle_shown(number);
    if (is_nan(vec4(vector, weight)) || any(greaterThan(abs(vector), vec3(1e15))))
        return;
    bool known = !is_nan(value) && abs(value) < 1e30;
    mean.weight += weight;
    mean.vector += weight * vector;
    mean.scalar_weight += known ? weight : 0.0;
    mean.scalar += known ? weight * value : 0.0;
    mean.fluid = weight > mean.best ? value : mean.fluid;
    mean.best = max(mean.best, weight);
}

Mean mean_at(vec3 x)
{
    Mean mean = Mean(0.0, 0.0, 0.0, 0.0, vec3(0.0), 0.0);
    uvec3 cell = cell_at(x);
    for (uint row = 0u; row < 9u; row++) {
        uvec2 range = row_of(cell, row);
        for (uint j = range.x; j < range.y; j++) {
            float q = length(place_of(j) - x) / support, t = 1.0 - q;
            if (q >= 1.0)
                continue;
            uint number = number_of(j);
            add(mean, number, position_words[number * position_stride + 3u] * peak * t * t * t * t * (1.0 + 4.0 * q));
        }
    }
    return mean;
}

float shown_of(Mean mean)
{
    return shown_is_fluid != 0u ? mean.fluid : mean.scalar / mean.scalar_weight;
}
