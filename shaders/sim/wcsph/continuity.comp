// wcsph: rate of density by the equation of continuity, with diffusion and the walls' images. Then density, volume
// and pressure: rate_range in sim/methods/wcsph/pairs_wcsph.c, rate_body in sim/methods/wcsph/wcsph_passes.c, sim/methods/wcsph/pairs_images.c.
#define BEHIND_DRIFT
#ifndef SOLIDS
#define OWN_ACCESS writeonly
#endif
#include "sim/constants.glsl"
#include "sim/wcsph/wcsph.glsl"
#include "sim/walk.glsl"
#include "sim/own.glsl"
#ifdef SOLIDS
#include "sim/solids.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // w: solid
#endif
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };  // p, p V^2
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };           // w: rho / rho0 - 1, read of itself only
#ifdef DIFFUSION
layout(std430, binding = SLOPES_BUFFER) readonly buffer Slopes { vec4 slope[]; };         // w: rho / rho0 - 1, by state.comp
#endif
#ifdef CORRECTED
#define CORRECTION_ACCESS readonly
#include "sim/wcsph/correction.glsl"
#endif
layout(location = PASS_DT_AT) uniform float dt;

// The particle, and the current image: velocities, and sums of F v_ij . x_ij.
uint self, own_fluid;
vec3 own_velocity, image_velocity, image_sign;
float sum = 0.0, image_sum = 0.0, beside = 0.0; // the last one: the part of boundary particles

// x_ij with the particle's corrected gradient; the same for an image.
vec3 along(vec3 d)
{
#ifdef CORRECTED
    d += corrected(self, d);
#endif
    return d;
}

vec3 along_image(vec3 d) { return image_sign * along(image_sign * d); }

// Subtracts diffusion from the flow between two particles of a fluid.
void diffuse(uint j, vec3 d, inout float flow)
{
#ifdef DIFFUSION
    if (FLUID_OF(j) != own_fluid)
        return;
    vec4 here = slope[self], there = slope[j];
    flow -= diffusion * (there.w - here.w + 0.5 * dot(here.xyz + there.xyz, d));
#endif
}

void meet(uint j, vec3 d, float volume)
{
    float h = support, least = 1e-6 * h, r2 = dot(d, d);
    if (r2 >= h * h || r2 < least * least)
        return;
    float flow = dot(own_velocity - velocity[j].xyz, along(d));
    flow *= 1.0 + contrast(fluids[own_fluid].density, fluids[FLUID_OF(j)].density);
    diffuse(j, d, flow);
    sum += shape(sqrt(r2) * inverse_support) * flow;
}

void meet_image(uint j, vec3 d, float volume)
{
    float r2 = dot(d, d);
    if (r2 < support * support)
        image_sum += image_shape(sqrt(r2)) * dot(image_velocity - velocity[j].xyz, along_image(d)) *
                     (1.0 + contrast(fluids[own_fluid].density, fluids[FLUID_OF(j)].density));
}

#ifdef SOLIDS
// The solid's own velocity there, not the mirrored velocity.
vec3 solid_velocity_of(uint j) { return solid_velocity_at(int(rest[boundary_state[j].y].w), boundary_position[j].xyz); }

void meet_boundary(uint j, vec3 d, float volume)
{
    float h = support, least = 1e-6 * h, r2 = dot(d, d);
    if (r2 >= h * h || r2 < least * least)
        return;
    vec3 flow = shape(sqrt(r2) * inverse_support) * (own_velocity - solid_velocity_of(j));
    sum += dot(flow, along(d));
    beside += dot(flow, d);
}

void meet_boundary_image(uint j, vec3 d, float volume)
{
    float r2 = dot(d, d);
    if (r2 >= support * support)
        return;
    vec3 flow = image_shape(sqrt(r2)) * (image_velocity - solid_velocity_of(j));
    image_sum += dot(flow, along_image(d));
    beside += dot(flow, d);
}
#endif

// Sums over the neighbours of the images of the particle at x, in the cell `at`.
void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_sign = image.sign;
        image_velocity = image.sign * own_velocity;
        WALK(image.x, at, meet_image, meet_boundary_image)
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
    own_velocity = velocity[i].xyz;
    own_fluid = FLUID_OF(i);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    walk_images(x, at);
    float rate = -gradient_scale * (sum + image_sum) / rest_number_density;
    float e = density_after(velocity[i].w, rate * dt);
    float more = 0.0;
#ifdef SOLIDS
    float boundary_rate = -gradient_scale * beside / rest_number_density;
    more = boundary_part_after(own[OWN_boundary_part + i], boundary_rate, dt);
    own[OWN_boundary_rate + i] = boundary_rate;
    own[OWN_boundary_part + i] = more;
#endif
    State state = state_of(e, more, own_fluid);
    own[OWN_rate + i] = rate;
    velocity[i].w = e;
    position[i].w = unit_volume * state.volume;
    pressure[i] = state.pressure;
}
