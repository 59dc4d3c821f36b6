// Pairs that age: shared forces in a method with additional columns. Only compiled.
#include "sim/constants.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
#include "sim/force.glsl"

float volume_of(uint i) { return velocity[i].w; }

float extra_of(uint fluid) { return scratch[SCRATCH_stiffness]; }

vec3 pair_force(Side one, Side other, vec3 d, float r2) { return own[OWN_age + self] * (other.v - one.v); }

void main()
{
    uint i = invocation();
    if (i < particle_count())
        acceleration[i] = vec4(neighbours_force(i, near[i].xyz, cell_of(near[i].xyz)), 0.0);
}
