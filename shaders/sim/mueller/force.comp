// mueller: accelerations by pressure, viscosity and the walls' images: force_range in sim/methods/mueller/pairs_mueller.c, and
// sim/methods/mueller/mueller.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "sim/force.glsl"
#include "sim/images.glsl"
#include "sim/mueller/kernel.glsl"

float volume_of(uint i) { return velocity[i].w; }

float extra_of(uint fluid) { return 0.0; }

vec3 pair_force(Side own, Side other, vec3 d, float r2)
{
    float r = sqrt(r2);
    vec3 force = push_of(own.pressure + other.pressure, r) * d;
#ifdef RUBS
    float t = 1.0 - r * inverse_support;
    force += 0.5 * viscosity_scale * own.volume * t * other.volume * pair_viscosity(own.viscosity, other.viscosity) * (other.v - own.v);
#endif
    return force;
}

#ifdef FORCES_ON_SOLIDS
#include "sim/solid_forces.glsl"
#else
#include "sim/wall_lift.glsl"
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; }; // p, p V^2

vec3 image_push; // on an image, in its axes

void meet_image(uint j, vec3 d, float term)
{
    float r = max(length(d), 1e-6 * support);
    if (r < support)
        image_push += push_of(self_side.pressure + term, r) * d;
}

#ifdef SOLIDS
void meet_boundary_image(uint j, vec3 d, float volume) { meet_image(j, d, uintBitsToFloat(boundary_state[j].x)); }
#endif

// Force on the images of particle i at x, in the cell `at`.
vec3 images_force(uint i, vec3 x, ivec3 at)
{
    int end = images_end(x);
    vec3 force = vec3(0);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_push = vec3(0);
        WALK_NEIGHBOURS(i, image.x, at, meet_image, meet_boundary_image, 0)
        force += image.sign * image_push;
    }
    return force;
}

#include "sim/wall_cushion.glsl"
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    ivec3 at = cell_of(x);
    Fluid fluid = fluids[FLUID_OF(i)];
    vec3 force = neighbours_force(i, x, at) + images_force(i, x, at);
    vec3 g = apparent_at(x), held = lift_at(x, g, fluid.density, pressure[i].x) + cushion_at(x, velocity[i].xyz, g, dt, pressure[i].x / max(fluid.density * spacing * length(g), 1e-20));
    acceleration[i] = vec4(force / fluid.mass + held, 0.0);
}
#endif
