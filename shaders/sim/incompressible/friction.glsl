// Friction in the form of Morris (friction_sums in sim/methods/shared/pair_incompressible.h); with surface tension all forces but pressure.
// Images in walls with slip take part, at distances of at least half a spacing. A pass declares volume_of, and FRICTION if
// different from `friction_gradient`.
#define KERNEL_WENDLAND_C2 1
#include "sim/force.glsl"
#include "sim/images.glsl"
#include "sim/shapes.glsl"
#ifndef FRICTION
#define FRICTION friction_gradient
#endif

float extra_of(uint fluid) { return 0.0; }

vec3 pair_force(Side one, Side other, vec3 d, float r2)
{
#ifdef RUBS
    float f = FRICTION * shape(sqrt(r2) * inverse_support);
    return f * one.volume * other.volume * pair_viscosity(one.viscosity, other.viscosity) * (other.v - one.v);
#else
    return vec3(0);
#endif
}

#if defined RUBS && !defined NO_SLIP
Side image_side; // self_side with the velocity in the mirror
vec3 image_force;

void rub_image(Side other, vec3 d)
{
    float r2 = dot(d, d);
    if (r2 < support * support)
        image_force += pair_force(image_side, other, d, max(r2, 0.25 * spacing * spacing));
}

void meet_image(uint j, vec3 d, float term) { rub_image(side_of(j, term), d); }

#ifdef SOLIDS
void meet_boundary_image(uint j, vec3 d, float volume)
{
    rub_image(Side(0.0, volume, boundary_velocity[j].w, 0.0, 0.0, boundary_velocity[j].xyz), d);
}
#endif

vec3 images_force(uint i, vec3 x, ivec3 at)
{
    vec3 force = vec3(0);
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_side = self_side;
        image_side.v *= image.sign;
        image_force = vec3(0);
        WALK_NEIGHBOURS(i, image.x, at, meet_image, meet_boundary_image, 0)
        force += image.sign * image_force;
    }
    return force;
}
#else
vec3 images_force(uint i, vec3 x, ivec3 at) { return vec3(0); }
#endif

vec3 other_forces(uint i)
{
#if defined RUBS || defined TENSION
    vec3 x = near[i].xyz, force = neighbours_force(i, x, cell_of(x));
    return force + images_force(i, x, cell_of(x));
#else
    return vec3(0);
#endif
}
