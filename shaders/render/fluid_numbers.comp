// A number of each particle's fluid, for sums and means (render/particles/particles.h).
#include "common/particles.glsl"
#include "common/particle_fluids.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Numbers { float numbers[]; };
layout(location = CURVE_PARTICLES_AT) uniform uint count;
layout(location = FLUID_VALUES_AT) uniform float of_fluid[FLUID_VALUES_MAX];

void main()
{
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index < count)
        numbers[index] = of_fluid[min(fluid_words[index * fluid_stride], FLUID_VALUES_MAX - 1u)];
}
