// Accelerations by pressure, viscosity and walls: sim/methods/mueller/pairs_mueller.c and sim/methods/mueller/mueller.c.
#include "sim/fragment/own.glsl"
#include "sim/fragment/neighbours.glsl"
#include "sim/wall_lift.glsl"
#include "sim/wall_cushion.glsl"
#include "sim/pair_direction.glsl"
#include "sim/pair_viscosity.glsl"
#include "sim/mueller/kernel.glsl"
uniform sampler2D fields, near, moving; // of density.frag
uniform vec3 apparent_origin, apparent_alpha, apparent_omega; // apparent gravity
uniform float dt;
layout(location = 0) out vec4 acceleration;

int self;
vec3 here, force;
float pressure_term;
#ifdef VISCOUS
vec3 speed;
float viscosity, drag_scale;
#endif

void meet_images(int j)
{
    vec4 other = of_particle(near, j);
    for (uint left = images; left != 0u; left &= left - 1u) {
        Image image = first_image(left);
        vec3 d = image.x - other.xyz;
        force += image.sign * (push_of(pressure_term + other.w, max(length(d), 1e-6 * support)) * d);
    }
}

void meet(int j)
{
    vec4 other = of_particle(near, j);
    vec3 d = here - other.xyz;
    float r2 = dot(d, d), h = support, least = 1e-6 * h;
    if (r2 >= h * h)
        return;
    if (r2 < least * least) {
        d = least * direction_of_ids(uint(of_particle(position, self).w), uint(of_particle(position, j).w));
        r2 = least * least;
    }
    float r = sqrt(r2), t = 1.0 - r * inverse_support;
    force += push_of(pressure_term + other.w, r) * d;
#ifdef VISCOUS
    vec4 its = of_particle(moving, j);
#if FLUIDS > 1
    float mu = pair_viscosity(viscosity, fluid_of(of_particle(velocity, j).w).viscosity);
#else
    float mu = 2.0 * viscosity;
#endif
    force += drag_scale * t * its.w * mu * (its.xyz - speed);
#endif
}

void main()
{
    self = own_particle();
    if (self >= particle_count)
        discard;
    vec4 own = of_particle(near, self), known = of_particle(fields, self);
    Fluid fluid = fluid_of(of_particle(velocity, self).w);
    here = own.xyz;
    pressure_term = own.w;
    force = vec3(0);
#ifdef VISCOUS
    speed = of_particle(moving, self).xyz;
    viscosity = fluid.viscosity;
    drag_scale = 0.5 * viscosity_scale * known.x;
#endif
    meet_neighbours(self, here);
    vec3 g = apparent_origin - cross(apparent_alpha, here) - cross(apparent_omega, cross(apparent_omega, here));
    vec3 held = lift_at(here, g, fluid.density, known.y) + cushion_at(here, of_particle(velocity, self).xyz, g, dt, known.y / max(fluid.density * spacing * length(g), 1e-20));
    acceleration = vec4(force / fluid.mass + held, 0.0);
}
