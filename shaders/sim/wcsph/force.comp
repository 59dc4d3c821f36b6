// wcsph: accelerations by pressure, viscosity and the walls' images: wcsph_range in sim/methods/wcsph/pairs_wcsph.c, and
// sim/methods/wcsph/pairs_images.c.
#ifdef CORRECTED
#define MEET_MORE(j, d, r2, term) correct_meet(j, d, r2, term);
#define FORCES_FORCE(i, term, d, r2) \
    (pair_force(side_of(i, term), boundary_side, d, r2) + \
     gradient_scale * shape(sqrt(r2) * inverse_support) * term * corrected(i, d))
#elif !defined CURVATURE
#define LISTS_FIRST
#endif
#include "sim/constants.glsl"
#ifdef CORRECTED
void correct_meet(uint j, vec3 d, float r2, float term);
#endif
#include "sim/force.glsl"
#include "sim/wcsph/wcsph.glsl"
#include "sim/wcsph/curvature.glsl"
#include "sim/wcsph/evenness.glsl"

// Volume for friction: fluid counts as at least THINNEST dense.
float volume_bounded(float volume) { return min(volume, 1.0 / (THINNEST * rest_number_density)); }

#ifdef CORRECTED
#define CORRECTION_ACCESS readonly
#include "sim/wcsph/correction.glsl"

// push_of of sim/methods/wcsph/pairs_corrected.c: sums of F x_ij, the same for an image, and of p_j V_j^2 C_j F x_ij.
vec3 even_push = vec3(0), even_image_push, correction_push = vec3(0);
vec3 contrast_push = vec3(0), contrast_image_push; // the same sums times w of sim/methods/wcsph/pairs_surface.c

#ifdef SHIFTING
vec3 shift_push = vec3(0), shift_image_push; // of S_j F x_ij

float volume_squared(float volume)
{
    float v = rest_number_density * volume_bounded(volume);
    return volume > 0.0 ? v * v : 1.0;
}
#endif

// tr C / (2 d) of particle i.
float half_missing(uint i) { return dot(correction[2u * i].xyz, vec3(0.5 / float(dimensions))); }

// sim/methods/wcsph/pairs_wcsph.c.
vec3 more_friction(uint j, vec3 d, float f, float term)
{
    Side other = side_of(j, term);
    float both = volume_bounded(self_side.volume) * volume_bounded(other.volume);
    return f * radial_friction * both * pair_viscosity(self_side.viscosity, other.viscosity) *
           (half_missing(self) + half_missing(j)) * dot(other.v - self_side.v, d) * d;
}

void correct_meet(uint j, vec3 d, float r2, float term)
{
#if defined RUBS && defined RADIAL
    pair_sum += more_friction(j, d, gradient_scale * shape(sqrt(r2) * inverse_support), term);
#endif
    float share = 1.0 - contrast(self_side.density, fluids[FLUID_OF(j)].density);
    vec3 push = gradient_scale * shape(sqrt(r2) * inverse_support) * corrected(j, d);
    correction_push += share * term * push;
#ifdef SHIFTING
    shift_push += volume_squared(volume_of(j)) * push;
#endif
}
#endif

float volume_of(uint i) { return volume_at(velocity[i].w); }

float extra_of(uint fluid) { return wcsph_fluids[fluid].artificial_viscosity; }


// Laminar viscosity; f: the kernel's slope of the pair.
vec3 rub(Side own, Side other, vec3 d, float f)
{
#if defined RUBS && defined RADIAL
    return f * volume_bounded(own.volume) * volume_bounded(other.volume) * pair_viscosity(own.viscosity, other.viscosity) * radial_friction * dot(other.v - own.v, d) * d;
#elif defined RUBS
    return f * volume_bounded(own.volume) * volume_bounded(other.volume) * pair_viscosity(own.viscosity, other.viscosity) * (other.v - own.v);
#else
    return vec3(0);
#endif
}

// Pressure, and laminar or artificial viscosity.
vec3 pair_force(Side own, Side other, vec3 d, float r2)
{
    float f = gradient_scale * shape(sqrt(r2) * inverse_support), w = contrast(own.density, other.density);
    float push = BOTH_PRESS(own.pressure, other.pressure, w);
    even_meet(f, d, r2);
#ifdef CORRECTED
    even_push += f * d;
    contrast_push += w * f * d;
#ifdef SHIFTING
    shift_push += (volume_squared(other.volume) - 1.0) * f * d;
#endif
#endif
#ifdef ARTIFICIAL
    if (own.extra == other.extra || own.extra * other.extra == 0.0) // artificial_of of sim/methods/wcsph/pairs_wcsph.c
        push += volume_bounded(own.volume) * volume_bounded(other.volume) * (own.extra + other.extra) * dot(other.v - own.v, d) / (r2 + support * support / 400.0);
#endif
    return rub(own, other, d, f) + f * push * d;
}

// Pressure on an image. Of the hydrostatic part, the rise from a particle to its own image is rise0 + 2 rise . d,
// with d from the particle to the current image; rise_of of sim/methods/wcsph/pairs_images.c.
vec3 image_push, rise;
float rise0, inverse_layer;

// p V0^2 of the image of a particle with this `term`: image_term of sim/methods/wcsph/pairs_images.c.
float image_term(float term, vec3 d)
{
    float share = clamp(term * inverse_layer, 0.0, 1.0);
    return max(term + share * (rise0 + 2.0 * dot(rise, d)), min(term, 0.0));
}

void push_image(float term, vec3 d, float w)
{
    float r2 = dot(d, d);
    if (r2 >= support * support)
        return;
    float f = image_shape(sqrt(r2));
    image_push += f * BOTH_PRESS(self_side.pressure, image_term(term, d), w) * d;
    even_meet_image(f, d, r2);
#ifdef CORRECTED
    even_image_push += f * d;
    contrast_image_push += w * f * d;
#endif
}

// Friction of slip walls: image_rub of sim/methods/wcsph/pairs_images.c. A macro, so that a side is read only if needed.
#if defined RUBS && !defined NO_SLIP
#ifdef RADIAL
#define RUB_NEAREST 1e-6
#else
#define RUB_NEAREST (0.5 * spacing * inverse_support)
#endif
Side image_side; // self_side with the mirrored velocity
#define RUB_IMAGE(other, d)                                                                        \
    if (dot(d, d) < support * support)                                                             \
        image_push += rub(image_side, other, d, shape(max(length(d) * inverse_support, RUB_NEAREST)));
#else
#define RUB_IMAGE(other, d)
#endif

void meet_image(uint j, vec3 d, float term)
{
    float w = contrast(self_side.density, fluids[FLUID_OF(j)].density);
    push_image(term, d, w);
    RUB_IMAGE(side_of(j, term), d)
#ifdef CORRECTED
    float r2 = dot(d, d);
    if (r2 >= support * support)
        return;
    vec3 push = image_shape(sqrt(r2)) * corrected(j, d);
    image_push += (1.0 - w) * image_term(term, d) * push;
#ifdef SHIFTING
    float v2 = volume_squared(volume_of(j));
    shift_image_push += v2 * push + (v2 - 1.0) * image_shape(sqrt(r2)) * d;
#endif
#endif
}

#ifdef SOLIDS
void meet_boundary_image(uint j, vec3 d, float volume)
{
    float term = uintBitsToFloat(boundary_state[j].x);
    push_image(term, d, 0.0);
    RUB_IMAGE(Side(term, volume, boundary_velocity[j].w, 0.0, 0.0, boundary_velocity[j].xyz), d)
#if defined CORRECTED && defined SHIFTING
    float r2 = dot(d, d);
    if (r2 < support * support)
        shift_image_push += (volume_squared(volume) - 1.0) * image_shape(sqrt(r2)) * d;
#endif
}
#endif

// Pressure and friction of the wall images on the particle at x, in the cell `at`, with the fluid's rest density.
vec3 images_force(vec3 x, ivec3 at, float density)
{
    float weight = density / (rest_number_density * rest_number_density);
    vec3 g = apparent_at(x), force = vec3(0);
    float layer = weight * spacing * length(g);
    inverse_layer = layer > 0.0 ? 1.0 / layer : 0.0;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        rise = weight * mix(vec3(0), g, lessThan(image.sign, vec3(0)));
        rise0 = dot(rise, x - image.x);
        image_push = vec3(0);
#if defined RUBS && !defined NO_SLIP
        image_side = self_side;
        image_side.v *= image.sign;
#endif
#ifdef CORRECTED
        even_image_push = contrast_image_push = vec3(0);
#ifdef SHIFTING
        shift_image_push = vec3(0);
#endif
#endif
        WALK(image.x, at, meet_image, meet_boundary_image)
        force += image.sign * image_push;
#ifdef CORRECTED
        even_push += gradient_scale * image.sign * even_image_push;
        contrast_push += gradient_scale * image.sign * contrast_image_push;
#ifdef SHIFTING
        shift_push += gradient_scale * image.sign * shift_image_push;
#endif
#endif
        even_end_image(image.sign);
    }
    return gradient_scale * force;
}

#ifdef FORCES_ON_SOLIDS
#include "sim/solid_forces.glsl"
#else
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
    vec3 force = neighbours_force(i, x, at) + images_force(x, at, fluid.density);
#ifdef CORRECTED
    vec3 here = corrected(i, even_push);
    force += self_side.pressure * (here + corrected(i, contrast_push)) + correction_push;
#ifdef SHIFTING
    float v2 = volume_squared(self_side.volume);
    even_sum.xyz += 0.5 * ((v2 - 1.0) * even_push + v2 * here + shift_push);
#endif
#endif
    force += curvature_force(i, x, at);
    acceleration[i] = vec4(force / fluid.mass + cushion_at(x, velocity[i].xyz, apparent_at(x), dt, self_side.pressure * inverse_layer), 0.0);
    even_write(i);
}
#endif
