// Moves each particle to its place in a list.
#include "sim/fragment/own.glsl"
uniform usampler2D held;
uniform usamplerBuffer by_cell; // index + 1
layout(location = 0) out vec4 new_position;
layout(location = 1) out vec4 new_velocity;
layout(location = 2) out uint new_held;

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    ivec2 from = texel_of(int(texelFetch(by_cell, i).x) - 1);
    new_position = texelFetch(position, from, 0);
    new_velocity = texelFetch(velocity, from, 0);
    new_held = texelFetch(held, from, 0).x;
}
