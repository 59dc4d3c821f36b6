// mueller: number density, volume, pressure: sim/methods/mueller/pairs_mueller.c and finish_density in sim/methods/mueller/mueller.c.
#include "sim/constants.glsl"
#include "sim/images.glsl"
#include "sim/mueller/kernel.glsl"
#define LISTS_FIRST
#include "sim/walk.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; }; // p, p V^2
// For the forces, which read of another both or the first alone: x y z, p V^2; velocity and volume.
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; };
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; };

float sum = 0.0; // of the kernel, but for its scale

void meet(uint j, vec3 d, float volume)
{
    sum += weight(d);
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    WALK_NEIGHBOURS(i, x, at, meet, meet, 0)
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++)
        if (image_of(x, walls, image))
            WALK_AGAIN(i, image.x, at, meet, meet)
    float n = kernel_scale * sum;
    float p = fluids[FLUID_OF(i)].stiffness * (n / rest_number_density - 1.0);
#ifndef NEGATIVE_PRESSURE
    p = max(p, 0.0);
#endif
    float volume = 1.0 / n;
    position[i].w = unit_volume * volume;
    velocity[i].w = volume;
    pressure[i] = vec2(p, p / (n * n));
    near[i] = vec4(x, p / (n * n));
}
