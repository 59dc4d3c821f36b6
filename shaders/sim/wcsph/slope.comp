// wcsph: gradient of relative density within a fluid, exact for linear fields (Antuono 2010): slope_range in
// sim/methods/wcsph/pairs_wcsph.c.
#define BEHIND_DRIFT
#include "sim/constants.glsl"
#include "sim/wcsph/wcsph.glsl"
#include "sim/walk.glsl"
#include "sim/wcsph/renormalise.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = SLOPES_BUFFER) buffer Slopes { vec4 slope[]; }; // w: the relative density, by state.comp

uint own_fluid;
float own_relative;
vec3 diagonal = vec3(0), mixed = vec3(0), b = vec3(0);
bool next_to_solid = false; // the slope of fluid at rest: diffusion there must level the gaps in the fluid's arrangement

void meet(uint j, vec3 d, float volume)
{
    float h = support, least = 1e-6 * h, r2 = dot(d, d);
    if (r2 >= h * h || r2 < least * least || FLUID_OF(j) != own_fluid)
        return;
    vec3 fd = shape(sqrt(r2) * inverse_support) * d;
    diagonal += fd * d;
    mixed += fd * d.yzx;
    b += fd * (own_relative - slope[j].w);
}

void meet_boundary(uint j, vec3 d, float volume)
{
    float reach = NEXT_TO_SOLID * support;
    next_to_solid = next_to_solid || dot(d, d) < reach * reach;
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    own_relative = slope[i].w;
    own_fluid = FLUID_OF(i);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    float scale = gradient_scale / rest_number_density;
    diagonal *= scale;
    if (dimensions == 2)
        diagonal.z = 0.5 * (diagonal.x + diagonal.y);
    slope[i].xyz = next_to_solid ? inverse_sound2 * apparent_at(x) : renormalise(diagonal, mixed * scale, b * scale);
}
