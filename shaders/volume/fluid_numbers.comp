// Fluids as numbers that can be averaged (render/volume/fluid_numbers.h).
#include "common/particles.glsl"
#include "common/particle_fluids.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 4) writeonly buffer Numbers { float numbers[]; };
layout(location = 1) uniform uint count;

void main()
{
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index < count)
        numbers[index] = float(fluid_words[index * particle_strides.z]);
}
