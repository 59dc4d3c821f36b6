// The particles, as render/particle_bind.c binds them; strides are in words since the owner of the buffers chose them.
layout(std430, binding = 0) readonly buffer Positions { float position_words[]; };
layout(std430, binding = 1) readonly buffer Scalars { float scalar_words[]; };
layout(std430, binding = 2) readonly buffer Fluids { uint fluid_words[]; };
layout(location = 0) uniform uvec4 particle_strides; // position, scalar, fluid; -

vec3 particle_position(uint particle_index)
{
    uint at = particle_index * particle_strides.x;
    return vec3(position_words[at], position_words[at + 1u], position_words[at + 2u]);
}
