// Accelerations by pressure, viscosity and walls: sim/cpu/pairs.c, sim/cpu/pairs_images.c and sim/cpu/forces.c.
#include "sim/constants.glsl"
#include "sim/terms.glsl"
#include "sim/rows.glsl"
#include "sim/pair_direction.glsl"
#ifdef CONTINUITY
#include "sim/wcsph.glsl"
#include "sim/images.glsl"
#else
#include "sim/walls.glsl"
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
#if defined VISCOUS && defined RADIAL
    push += both * (own.viscosity + other.viscosity) * term_scales.w * dot(u, d);
#elif defined VISCOUS
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

#ifdef CONTINUITY
// p V0^2 of the image of a particle of such a term, d from the image of the one at x: rise_of and image_term of
// sim/cpu/pairs_images.c.
float image_term(float term, vec3 rise, float rise0, float inverse_layer, vec3 d)
{
    float share = clamp(term * inverse_layer, 0.0, 1.0);
    return max(term + share * (rise0 + 2.0 * dot(rise, d)), min(term, 0.0));
}

// Pressure of the images behind the walls on the particle at x, in the cell `at`, of the fluid's rest density.
vec3 images_force(vec3 x, ivec3 at, float density, float own_term)
{
    float h = kernel.x, weight = density / (kernel.z * kernel.z);
    vec3 g = felt_at(x), force = vec3(0);
    float layer = weight * kernel.w * length(g), inverse_layer = layer > 0.0 ? 1.0 / layer : 0.0;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        vec3 rise = weight * mix(vec3(0), g, lessThan(image.sign, vec3(0))), push = vec3(0);
        float rise0 = dot(rise, x - image.x);
#ifdef SHIFTING
        vec4 even = vec4(0);
#endif
        for (int row = FIRST_ROW; row < LAST_ROW; row++) {
            uvec2 range = row_of(at, row);
            vec3 seen_from = row_seen(image.x, at, row);
            for (uint j = range.x; j < range.y; j++) {
                vec3 d = seen_from - position[j].xyz;
                float r2 = dot(d, d);
                if (r2 >= h * h)
                    continue;
                float f = image_shape(sqrt(r2));
                push += f * (own_term + image_term(pressure[j].y, rise, rise0, inverse_layer, d)) * d;
#ifdef SHIFTING
                even += f * vec4(d, r2);
                dense_sum += height(sqrt(r2) * kernel.y);
#endif
            }
#ifdef SOLIDS
            range = boundary_row_of(at, row);
            for (uint j = range.x; j < range.y; j++) {
                vec3 d = seen_from - boundary_position[j].xyz;
                float r2 = dot(d, d), term = uintBitsToFloat(boundary_state[j].x);
                if (r2 >= h * h)
                    continue;
                float f = image_shape(sqrt(r2));
                push += f * (own_term + image_term(term, rise, rise0, inverse_layer, d)) * d;
#ifdef SHIFTING
                even += f * vec4(d, r2);
                dense_sum += height(sqrt(r2) * kernel.y);
#endif
            }
#endif
        }
        force += image.sign * push;
#ifdef SHIFTING
        even_sum += term_scales.x * even * vec4(image.sign, 1.0);
#endif
    }
    return term_scales.x * force;
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
#ifdef CONTINUITY
    force += images_force(x, at, own_fluid.y, own.pressure);
#else
    force += wall_force(walls_at(x, false), felt_at(x), own_fluid.y, position[i].w, pressure[i].x, pressure[i].y);
#endif
    acceleration[i] = vec4(force / own_fluid.x, 0.0);
#ifdef SHIFTING
    // cpu_shift_share of sim/cpu/shift.c
    float share = clamp((even_sum.w / (term_shift.z * kernel.z) - 0.8) / 0.15, 0.0, 1.0);
    uneven[2u * i] = vec4(share * even_sum.xyz, share);
    uneven[2u * i + 1u] = vec4(scales.x * dense_sum / kernel.z - 1.0, 0.0, 0.0, 0.0);
#endif
}
