// Values of each particle for the views besides position and velocity: shaders/sim/compute/show.comp.
#include "sim/fragment/own.glsl"
uniform sampler2D fields;
uniform int scalar; // sim/world.h; SCALAR_STATE_COUNT: the fluid as a number; SCALAR_STATE_COUNT + 1: the id
layout(location = 0) out uint word; // bits of a float, or a number

float compression_of(int i) { return stiffness_scale * (1.0 / (of_particle(fields, i).x * rest_number_density) - 1.0); }

float value_of(int i)
{
    float fluid = of_particle(velocity, i).w;
    switch (scalar) {
    case SCALAR_SPEED:
        return length(of_particle(velocity, i).xyz);
    case SCALAR_DENSITY:
        return fluid_of(fluid).density * (1.0 + compression_of(i));
    case SCALAR_PRESSURE:
        return of_particle(fields, i).y;
    case SCALAR_COMPRESSION:
        return compression_of(i);
    case SCALAR_FLUID:
        return fluid;
    case SCALAR_LOST: // in the last grid: density.frag
        return of_particle(fields, i).w;
    }
    return of_particle(position, i).w;
}

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    if (scalar > SCALAR_STATE_COUNT)
        word = uint(of_particle(position, i).w);
    else
        word = scalar == SCALAR_STATE_COUNT ? uint(of_particle(velocity, i).w) : floatBitsToUint(value_of(i));
}
