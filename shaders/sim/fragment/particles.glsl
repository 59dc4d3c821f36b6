// Particles are texels: particle i is texel (i mod width, i / width) of each of these textures, with width
// 2^particle_bits, until sim/gpu/fragment/grid.c moves particles. sim/gpu/fragment/fragment.c writes particle_count,
// particle_bits and further constants before the shader.
uniform sampler2D position; // x y z, id
uniform sampler2D velocity; // x y z, fluid
uniform vec4 fluid_numbers[FLUIDS];

struct Fluid { // as in sim/constant_block.h
    float mass, density, stiffness, viscosity;
};

Fluid fluid_of(float number)
{
    vec4 of = fluid_numbers[int(number)];
    return Fluid(of.x, of.y, of.z, of.w);
}

ivec2 texel_of(int i) { return ivec2(i & (1 << particle_bits) - 1, i >> particle_bits); }

vec4 of_particle(sampler2D values, int i) { return texelFetch(values, texel_of(i), 0); }
