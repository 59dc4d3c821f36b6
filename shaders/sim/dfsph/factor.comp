// dfsph: what follows from places alone, number density and what a particle's k makes of its own rate: dfsph_factor in
// sim/dfsph/pairs.c, dfsph_images_factor in sim/dfsph/pairs_images.c, finish_factor in sim/dfsph/passes.c.
#define LISTS_FIRST
#define OWN_ACCESS readonly
#include "sim/dfsph/dfsph.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };             // w: volume
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };   // p, k
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; }; // w: volume
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; };                 // x y z, k

// Of W; F x_ij and of an image; F^2 r^2 / m_j.
float heights = 1.0, squares = 0.0;
vec3 slope = vec3(0), image_slope;

vec3 weigh(vec3 d, float q, float inverse_mass)
{
    vec3 force = gradient * shape(q) * d;
    heights += height(q);
    squares += dot(force, force) * inverse_mass;
    return force;
}

void meet(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    slope += weigh(d, q_of(d), 1.0 / fluids[FLUID_OF(j)].mass);
}

// The particle's own image has its k, too.
void meet_image(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    float inverse_mass = j == self ? 0.0 : 1.0 / fluids[FLUID_OF(j)].mass, times = j == self ? 2.0 : 1.0;
    image_slope += times * weigh(d, image_q(d), inverse_mass);
}

#ifdef SOLIDS
// They push with the particle's own k, too: sim/dfsph/passes.h.
void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    slope += 2.0 * weigh(d, q_of(d), 0.0);
}

void meet_boundary_image(uint j, vec3 d, float volume)
{
    if (dot(d, d) < support * support)
        image_slope += 2.0 * weigh(d, image_q(d), 0.0);
}
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_slope = vec3(0);
        WALK(image.x, at, meet_image, meet_boundary_image)
        slope += image.sign * image_slope;
    }
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    self = i;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    walk_images(x, at);
    float mass = fluids[FLUID_OF(i)].mass, n = kernel_scale * heights;
    float d = max(dot(slope, slope) / mass + squares, least_squares / mass);
    scratch[SCRATCH_factor + i] = d > 0.0 ? min(1.0, rest_number_density / n) / d : 0.0;
    position[i].w = velocity[i].w = 1.0 / n;
    pressure[i] = vec2(pressure_of_term * own[OWN_kept_term + i], 0.0);
    near[i] = vec4(x, 0.0);
}
