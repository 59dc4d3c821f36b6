// wcsph: velocity changes for shifts: sim/methods/wcsph/wcsph_passes.c, sim/methods/wcsph/pairs_wcsph.c.
#include "sim/constants.glsl"
#include "sim/wcsph/wcsph.glsl"
#include "sim/walk.glsl"
#include "sim/wcsph/renormalise.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = UNEVENS_BUFFER) buffer Unevens { vec4 uneven[]; }; // see shift.comp

vec3 own_velocity, diagonal = vec3(0), mixed = vec3(0);
mat3 slopes = mat3(0); // sum of F x_ij over columns, v_i - v_j over rows

void meet(uint j, vec3 d, float volume)
{
    float h = support, least = 1e-6 * h, r2 = dot(d, d);
    if (r2 >= h * h || r2 < least * least)
        return;
    vec3 fd = shape(sqrt(r2) * inverse_support) * d;
    diagonal += fd * d;
    mixed += fd * d.yzx;
    slopes += outerProduct(own_velocity - velocity[j].xyz, fd);
}

void meet_boundary(uint j, vec3 d, float volume) {}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    own_velocity = velocity[i].xyz;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    float scale = gradient_scale / rest_number_density;
    diagonal *= scale;
    if (dimensions == 2)
        diagonal.z = 0.5 * (diagonal.x + diagonal.y);
    uneven[2u * i + 1u].yzw = scale * slopes * renormalise(diagonal, scale * mixed, uneven[2u * i].xyz);
}
