// Accelerations by pressure, viscosity and walls: sim/cpu/pairs.c and sim/cpu/forces.c.
#include "sim/constants.glsl"
#include "sim/terms.glsl"
#include "sim/walls.glsl"
#include "sim/rows.glsl"
#include "sim/pair_direction.glsl"
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
#ifdef SHIFTING
layout(std430, binding = 6) writeonly buffer Unevens { vec4 uneven[]; }; // see shift.comp

// What shifting goes by: sums of F x_ij, of F r^2, of W; wcsph_range of sim/cpu/pairs_wcsph.c.
vec4 even_sum = vec4(0);
float dense_sum = 1.0;
#endif

vec3 felt_at(vec3 x)
{
    return felt_origin.xyz - cross(felt_alpha.xyz, x) - cross(felt_omega.xyz, cross(felt_omega.xyz, x));
}

// What a pair takes of one of the two.
struct Side {
    float pressure, volume, viscosity, artificial; // pressure: p V^2
    vec3 v;
};

Side side_of(uint i, float volume)
{
    uint fluid = name[i].y;
#ifdef CONTINUITY
    float artificial = fluid_terms[fluid].y;
#else
    float artificial = 0.0;
#endif
    return Side(pressure[i].y, volume, fluids[fluid].w, artificial, velocity[i].xyz);
}

#ifdef CONTINUITY
// Pressure and laminar or artificial viscosity: wcsph_range in sim/cpu/pairs_wcsph.c.
vec3 pair_force(Side own, Side other, vec3 d, float r2)
{
    float f = term_scales.x * shape(sqrt(r2) * kernel.y), push = own.pressure + other.pressure;
#ifdef SHIFTING
    even_sum += f * vec4(d, r2);
    dense_sum += height(sqrt(r2) * kernel.y);
#endif
    vec3 force = vec3(0), u = other.v - own.v;
    float both = own.volume * other.volume;
#ifdef VISCOUS
    force += f * both * (own.viscosity + other.viscosity) * u;
#endif
#ifdef ARTIFICIAL
    push += both * (own.artificial + other.artificial) * dot(u, d) / (r2 + kernel.x * kernel.x / 400.0);
#endif
    return force + f * push * d;
}
#else
// Pressure and viscosity: force_range in sim/cpu/pairs.c.
vec3 pair_force(Side own, Side other, vec3 d, float r2)
{
    float r = sqrt(r2), t = 1.0 - r * kernel.y;
    vec3 force = scales.y * (t * t) * (own.pressure + other.pressure) / r * d;
#ifdef VISCOUS
    force += 0.5 * scales.z * own.volume * t * other.volume * (own.viscosity + other.viscosity) * (other.v - own.v);
#endif
    return force;
}
#endif

bool coincident(float r2) { return r2 < 1e-12 * kernel.x * kernel.x; }

void separate(uint a, uint b, out vec3 d, out float r2)
{
    float least = 1e-6 * kernel.x;
    d = least * direction_of_ids(a, b);
    r2 = least * least;
}

#ifdef SOLIDS
vec3 boundary_force(uint i, Side own, vec3 x, uvec2 range)
{
    vec3 force = vec3(0);
    for (uint j = range.x; j < range.y; j++) {
        vec4 other = boundary_position[j], wall = boundary_velocity[j];
        vec3 d = x - other.xyz;
        float r2 = dot(d, d);
        if (r2 >= kernel.x * kernel.x)
            continue;
        uvec2 state = boundary_state[j];
        if (coincident(r2))
            separate(name[i].x, BOUNDARY_ID + state.y, d, r2);
        force += pair_force(own, Side(uintBitsToFloat(state.x), other.w, wall.w, 0.0, wall.xyz), d, r2);
    }
    return force;
}
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz, force = vec3(0);
    ivec3 at = cell_of(x);
    Side own = side_of(i, position[i].w);
#ifdef TENSION
    vec4 tension_sum = vec4(0);
    uint fluid = name[i].y;
#endif
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {
        uvec2 range = row_of(at, row);
        vec3 seen_from = row_seen(x, at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec4 other = position[j];
            vec3 d = seen_from - other.xyz;
            float r2 = dot(d, d);
            if (r2 >= kernel.x * kernel.x || j == i)
                continue;
#ifdef TENSION
            if (name[j].y == fluid)
                tension_add(d, r2, other.w, tension_sum);
#endif
            if (coincident(r2))
                separate(name[i].x, name[j].x, d, r2);
            force += pair_force(own, side_of(j, other.w), d, r2);
        }
#ifdef SOLIDS
        force += boundary_force(i, own, seen_from, boundary_row_of(at, row));
#endif
    }
#ifdef TENSION
    force += tension_force(tension_sum, position[i].w, fluid_terms[name[i].y].z);
#endif
    vec4 own_fluid = fluids[name[i].y];
    WallSums walls = walls_at(x, false);
    force += wall_force(walls, felt_at(x), own_fluid.y, position[i].w, pressure[i].x, pressure[i].y);
    acceleration[i] = vec4(force / own_fluid.x, 0.0);
#ifdef SHIFTING
    // cpu_shift_walls of sim/cpu/shift.c
    float trace = walls.diagonal.x + walls.diagonal.y + (rows.x == 3 ? 0.0 : walls.diagonal.z);
    float share = clamp(((even_sum.w + trace) / (term_shift.z * kernel.z) - 0.8) / 0.15, 0.0, 1.0);
    uneven[2u * i] = vec4(share * (even_sum.xyz + walls.uneven), share);
    uneven[2u * i + 1u] = vec4((scales.x * dense_sum + walls.density) / kernel.z - 1.0, 0.0, 0.0, 0.0);
#endif
}
