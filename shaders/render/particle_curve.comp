// A property of each particle by a curve of a scalar (render/particles/particles.h): the radius, or with VEILED the
// opacity. SCALED: multiplies present sizes (common/ball.glsl). LEAST: lower bound, where spheres must not have size 0.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "common/nan.glsl"
#include "common/curve.glsl"

#ifndef LEAST
#define LEAST 0.0
#endif
layout(local_size_x = 64) in;
layout(location = CURVE_PARTICLES_AT) uniform uint particles;   // number of particles
#ifdef VEILED
#include "common/particle_ids.glsl"
layout(std430, binding = VEILS_STORAGE) writeonly buffer Veils { vec2 veil[]; };
#elif defined ELLIPSOID
layout(std430, binding = SHAPES_STORAGE) buffer Shapes { vec4 shape[]; };
#else
layout(std430, binding = SHAPES_STORAGE) buffer Shapes { float shape_radius[]; };
#endif

void main()
{
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index >= particles)
        return;
    float x = (scalar_words[index * scalar_stride] - scalar_range.x) * scalar_range.y;
    float value = max(curve_at(is_nan(x) ? 1.0 : x), LEAST);
#ifdef VEILED
    veil[index] = vec2(value, id_share(index));
#elif defined ELLIPSOID
    shape[3u * index].w *= value;
#elif defined SCALED
    shape_radius[index] *= value;
#else
    shape_radius[index] = particle_radius * value;
#endif
}
