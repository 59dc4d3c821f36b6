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

#ifdef SOLIDS
#include "shaders/sim/mueller/mueller_block.h"
#include "sim/own.glsl"
layout(location = PASS_DT_AT) uniform float dt;

float beside = 0.0; // the part of boundary particles

void meet_boundary(uint j, vec3 d, float volume)
{
    float w = weight(d);
    sum += w;
    beside += w;
}

// boundary_part of sim/methods/mueller/mueller.c.
float boundary_part(uint i)
{
    float mean = own[OWN_boundary_mean + i], now = kernel_scale * beside / rest_number_density;
    float part = mean == 0.0 ? 0.0 : clamp(now - mean, -boundary_most, boundary_most);
    if (dt > 0.0)
        own[OWN_boundary_mean + i] = now == 0.0 ? 0.0 : now - part / (1.0 + dt * boundary_fades);
    return now == 0.0 ? 0.0 : part;
}
#else
#define boundary_part(i) 0.0
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++)
        if (image_of(x, walls, image))
            WALK_AGAIN(i, image.x, at, meet, meet_boundary)
    float n = kernel_scale * sum;
    float p = fluids[FLUID_OF(i)].stiffness * (n / rest_number_density - 1.0 + boundary_part(i));
#ifndef NEGATIVE_PRESSURE
    p = max(p, 0.0);
#endif
    float volume = 1.0 / n;
    position[i].w = unit_volume * volume;
    velocity[i].w = volume;
    pressure[i] = vec2(p, p / (n * n));
    near[i] = vec4(x, p / (n * n));
}
