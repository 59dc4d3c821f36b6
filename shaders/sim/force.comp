// Accelerations by pressure, viscosity and walls: sim/cpu/pairs.c and sim/cpu/forces.c.
#include "sim/constants.glsl"
#include "sim/terms.glsl"
#include "sim/walls.glsl"
#include "sim/rows.glsl"
#ifdef CONTINUITY
#include "sim/wcsph.glsl"
#endif
#ifdef TENSION
#include "sim/tension.glsl"
#endif
#ifdef SOLIDS
#define BOUNDARY_ACCESS readonly
#include "sim/boundary.glsl"
#define BOUNDARY_ID 0x80000000u
#endif
layout(std430, binding = 0) readonly buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = 1) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = 3) readonly buffer Pressures { vec2 pressure[]; };
layout(std430, binding = 4) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = 5) writeonly buffer Accelerations { vec4 acceleration[]; };

// A direction that only the two ids decide, opposite for (a, b) and (b, a): sim/cpu/pair_loop.h.
vec3 direction_of_ids(uint a, uint b)
{
    uint low = min(a, b), high = max(a, b);
    uint hash = low * 0x9e3779b1u ^ (high * 0x85ebca77u + 0x165667b1u);
    vec3 d;
    for (int k = 0; k < 3; k++) {
        hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        d[k] = float(hash >> 8) * exp2(-23.0) - 1.0 + exp2(-24.0);
    }
    return normalize(d) * (a < b ? 1.0 : -1.0);
}

vec3 wall_force(uint i, vec3 x)
{
    WallSums sums = walls_at(x, false);
    vec3 g = felt_origin.xyz - cross(felt_alpha.xyz, x) - cross(felt_omega.xyz, cross(felt_omega.xyz, x));
    float density = fluids[name[i].y].y, layer = density * kernel.w * length(g);
    float fade = layer > 0.0 ? clamp(pressure[i].x / layer, 0.0, 1.0) : 0.0;
    float weight = fade * density * position[i].w / kernel.z;
    vec3 d = sums.diagonal, m = sums.mixed;
    vec3 moment_g = vec3(d.x * g.x + m.x * g.y + m.z * g.z, m.x * g.x + d.y * g.y + m.y * g.z,
                         m.z * g.x + m.y * g.y + d.z * g.z);
    vec3 force = vec3(0);
    for (int k = 0; k < 3; k++) {
        float push = pressure[i].y * sums.push[k], hydrostatic = -weight * moment_g[k];
        bool pulls = pressure[i].x >= 0.0 && sums.push[k] * (push + hydrostatic) < 0.0;
        force[k] = pulls ? 0.0 : push + hydrostatic;
    }
    return force;
}

#ifdef CONTINUITY
struct Side {
    float pressure, volume, viscosity, artificial; // pressure: p V^2
    vec3 v;
};

Side side_of(uint i, float volume)
{
    uint fluid = name[i].y;
    return Side(pressure[i].y, volume, fluids[fluid].w, fluid_terms[fluid].y, velocity[i].xyz);
}

// Pressure and laminar or artificial viscosity of one pair, over term_scales.x: wcsph_range in
// sim/cpu/pairs_wcsph.c.
vec3 wcsph_force(Side own, Side other, vec3 d, float r2)
{
    float f = shape(sqrt(r2) * kernel.y), push = own.pressure + other.pressure;
    float both = own.volume * other.volume;
    vec3 force = vec3(0), u = other.v - own.v;
#ifdef VISCOUS
    force += f * both * (own.viscosity + other.viscosity) * u;
#endif
#ifdef ARTIFICIAL
    push += both * (own.artificial + other.artificial) * dot(u, d) / (r2 + kernel.x * kernel.x / 400.0);
#endif
    return force + f * push * d;
}
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz, force = vec3(0);
    ivec3 at = cell_of(x);
    float h = kernel.x, least = 1e-6 * h, p = pressure[i].y;
#ifdef VISCOUS
    vec3 v = velocity[i].xyz;
    float mu = fluids[name[i].y].w, drag_scale = 0.5 * scales.z * position[i].w;
#endif
#ifdef TENSION
    vec4 tension_sum = vec4(0);
    uint fluid = name[i].y;
#endif
#ifdef CONTINUITY
    Side own = side_of(i, position[i].w);
#endif
    for (int row = rows.x; row < rows.y; row++) {
        uvec2 range = row_of(at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec4 other = position[j];
            vec3 d = x - other.xyz;
            float r2 = dot(d, d);
            if (r2 >= h * h || j == i)
                continue;
#ifdef TENSION
            if (name[j].y == fluid)
                tension_add(d, r2, other.w, tension_sum);
#endif
            if (r2 < least * least) {
                d = least * direction_of_ids(name[i].x, name[j].x);
                r2 = least * least;
            }
            float r = sqrt(r2), t = 1.0 - r * kernel.y;
#ifdef CONTINUITY
            force += wcsph_force(own, side_of(j, other.w), d, r2);
#else
            force += scales.y * (t * t) * (p + pressure[j].y) / r * d;
#ifdef VISCOUS
            force += drag_scale * t * other.w * (mu + fluids[name[j].y].w) * (velocity[j].xyz - v);
#endif
#endif
        }
#ifdef SOLIDS
        range = boundary_row_of(at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec4 other = boundary_position[j];
            vec3 d = x - other.xyz;
            float r2 = dot(d, d);
            if (r2 >= h * h)
                continue;
            uvec2 state = boundary_state[j];
            if (r2 < least * least) {
                d = least * direction_of_ids(name[i].x, BOUNDARY_ID + state.y);
                r2 = least * least;
            }
            float r = sqrt(r2), t = 1.0 - r * kernel.y;
#ifdef CONTINUITY
            vec4 wall = boundary_velocity[j];
            force += wcsph_force(own, Side(uintBitsToFloat(state.x), other.w, wall.w, 0.0, wall.xyz), d, r2);
#else
            force += scales.y * (t * t) * (p + uintBitsToFloat(state.x)) / r * d;
#ifdef VISCOUS
            vec4 wall = boundary_velocity[j];
            force += drag_scale * t * other.w * (mu + wall.w) * (wall.xyz - v);
#endif
#endif
        }
#endif
    }
#ifdef CONTINUITY
    force *= term_scales.x;
#endif
#ifdef TENSION
    force += tension_force(tension_sum, position[i].w, fluid_terms[name[i].y].z);
#endif
    acceleration[i] = vec4((force + wall_force(i, x)) / fluids[name[i].y].x, 0.0);
}
