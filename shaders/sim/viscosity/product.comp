// Implicit viscosity: product of the matrix and the trial direction, and terms for the length of the next step. product_range
// in sim/methods/shared/pairs_viscosity.c, product_body in sim/methods/shared/viscosity.c.
#include "sim/viscosity/viscosity.glsl"
#include "sim/viscosity/columns.glsl"
#include "sim/images.glsl"
layout(std430, binding = TRIALS_BUFFER) readonly buffer Trials { vec4 trial[]; };

vec3 own, sum = vec3(0);

void meet(uint j, vec3 d, float volume)
{
    vec4 other = trial[j];
    sum += weight(d, other.w, inverse_unit_volume * volume) * dot(own - other.xyz, d) * d;
}

// Boundary particles have change 0: their part is in the blocks `held`.
void walk(uint i, vec3 x, ivec3 at)
{
#ifdef LISTS
    WALK_LISTED(i, x, at, meet)
#else
    WALK_FLUID(x, at, meet)
#endif
}

// Products for the particle's images behind walls with slip, each in the mirror's axes.
void walk_images(uint i, vec3 x, ivec3 at)
{
#ifndef NO_SLIP
    vec3 z = own, whole = sum;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        own = image.sign * z;
        sum = vec3(0);
        walk(i, image.x, at);
        whole += image.sign * sum;
    }
    own = z, sum = whole;
#endif
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 place = vec4(position[i].xyz, inverse_unit_volume * position[i].w), own_trial = trial[i];
    own = own_trial.xyz;
    own_viscosity = own_trial.w;
    ivec3 at = cell_of(place.xyz);
    walk(i, place.xyz, at);
    walk_images(i, place.xyz, at);
    vec3 product = friction_scale * place.w * sum + scratch[SCRATCH_viscosity_inertia + i] * own;
#ifdef SOLIDS
    product += times(column_of(SCRATCH_viscosity_held, i), column_of(SCRATCH_viscosity_held_mixed, i), own);
#endif
    column_set(SCRATCH_viscosity_product, i, product);
    scratch[SCRATCH_viscosity_power + i] = dot(column_of(SCRATCH_viscosity_residual, i), own);
    scratch[SCRATCH_viscosity_curvature + i] = dot(product, own);
}
