// Force of surface tension by curvature: wcsph_curvature of sim/methods/wcsph/pairs_surface.c. No force without CURVATURE.
#ifdef CURVATURE
#define OUTWARD_ACCESS readonly
#include "sim/wcsph/surface.glsl"
#include "sim/wcsph/drops.glsl"

// A unit normal and its weight.
vec4 front_of(vec3 n)
{
    float weight = length(n);
    return weight > 1e-4 ? vec4(n / weight, weight) : vec4(0);
}

uint bend_fluid;
vec4 bend_front;                     // of the particle, or of an image
float bend_sum = 0.0, along_sum = 0.0; // sum w (n_i - n_j) . x_ij, sum w t^2

void bend_meet(uint j, vec3 d, float term)
{
    float r2 = dot(d, d);
    if (r2 >= support * support || FLUID_OF(j) != bend_fluid)
        return;
    vec4 n = bend_front, m = front_of(outward[j].xyz);
    float w = surface_slope(r2) * sqrt(m.w * n.w), mine = dot(n.xyz, d), its = dot(m.xyz, d), across = 0.5 * (mine + its);
    bend_sum += w * (mine - its);
    along_sum += w * (r2 - across * across);
}

// Adds the wall images; returns the sum of (1 - d/h)^2 over walls at distance d.
float bend_by_walls(vec3 x, ivec3 at, vec4 front)
{
    float next = 0.0;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        bend_front = vec4(image.sign * front.xyz, front.w);
        WALK_FLUID(image.x, at, bend_meet)
        float t = max(1.0 - 0.5 * length(x - image.x) * inverse_support, 0.0);
        next += dot(image.sign, vec3(1)) > 0.0 ? t * t : 0.0; // not for images of images
    }
    return next;
}

vec3 curvature_force(uint i, vec3 x, ivec3 at)
{
    vec4 front = front_of(outward[i].xyz);
    bend_fluid = FLUID_OF(i);
    bend_front = front;
    WALK_OWN_FLUID(i, x, at, bend_meet)
    float pull = fluid_terms[bend_fluid].wet * bend_by_walls(x, at, front);
    float along = max(along_sum, 0.0), tiny = 1e-20 * support * support, most = curvature_most;
    float whole = along + curvature_few * front.w + tiny;
    float curvature = clamp((float(dimensions - 1) * bend_sum - pull * along) / whole, -0.1 * most, most);
    float crowd = max(curvature_crowd * whole / max(front.w, 1e-4), curvature_crowd_least);
    float force = fluid_terms[bend_fluid].tension * curvature * (1.0 - curvature_offset * curvature) / pow(crowd, 0.375);
    drop_add(i, x, -force * outward[i].xyz, bend_fluid);
    return -force * outward[i].xyz;
}

// Near a wall no shift goes out through the surface: keep_notches of sim/methods/wcsph/wcsph_passes.c.
vec3 keep_notch(uint i, vec3 shift)
{
    vec3 n = outward[i].xyz, x = near[i].xyz;
    float squared = dot(n, n), out_of = dot(n, shift);
    return squared > 0.0 && out_of > 0.0 && images_end(x) > 1 ? shift - out_of / squared * n : shift;
}
#else
#define curvature_force(i, x, at) vec3(0)
#define keep_notch(i, shift) (shift)
#endif
