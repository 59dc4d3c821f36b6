// Number density, volume, pressure: sim/methods/mueller/pairs_mueller.c and finish_density in sim/methods/mueller/mueller.c.
#include "sim/fragment/own.glsl"
#include "sim/fragment/neighbours.glsl"
#include "sim/mueller/kernel.glsl"
layout(location = 0) out vec4 fields; // volume, p, 0; 1 for a particle without a place in the buckets, else 0
layout(location = 1) out vec4 near; // read of neighbours by force.frag: x y z, p V^2
#ifdef VISCOUS
layout(location = 2) out vec4 moving; // velocity, volume
#endif

vec3 here;
float sum;

void meet(int j) { sum += weight(here - of_particle(position, j).xyz); }

void meet_images(int j)
{
    vec3 x = of_particle(position, j).xyz;
    for (uint left = images; left != 0u; left &= left - 1u)
        sum += weight(first_image(left).x - x);
}

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    vec4 own = of_particle(position, i), speed = of_particle(velocity, i);
    here = own.xyz;
    sum = 1.0; // the particle itself, with or without a place
    bool placed = meet_neighbours(i, here);
    float n = kernel_scale * sum;
    float p = fluid_of(speed.w).stiffness * (n / rest_number_density - 1.0);
#ifndef NEGATIVE_PRESSURE
    p = max(p, 0.0);
#endif
    fields = vec4(1.0 / n, p, 0.0, placed ? 0.0 : 1.0);
    near = vec4(here, p / (n * n));
#ifdef VISCOUS
    moving = vec4(speed.xyz, 1.0 / n);
#endif
}
