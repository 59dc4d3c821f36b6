// The particles, as render/particles/particle_bind.c binds them; strides are in words since the owner of the buffers chose them. What else
// is known of them stands in blocks of their own, so that a shader declares what it reads: common/particle_scalars.glsl,
// common/particle_fluids.glsl.
layout(std430, binding = 0) readonly buffer Positions { float position_words[]; };
layout(location = 0) uniform uvec4 particle_strides; // position, scalar, fluid; -

vec3 particle_position(uint particle_index)
{
    uint at = particle_index * particle_strides.x;
    return vec3(position_words[at], position_words[at + 1u], position_words[at + 2u]);
}
