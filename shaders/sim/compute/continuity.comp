// wcsph: the density that particles carry, by the equation of continuity with diffusion and the walls' images, then volume and
// pressure after it: rate_range in sim/cpu/pairs_wcsph.c, continuity_range in sim/cpu/wcsph.c, sim/cpu/pairs_images.c.
#include "sim/constants.glsl"
#include "sim/wcsph.glsl"
#include "sim/images.glsl"
#include "sim/rows.glsl"
#ifdef SOLIDS
#define BOUNDARY_ACCESS readonly
#include "sim/boundary.glsl"
#include "sim/solids.glsl"
layout(std430, binding = 6) readonly buffer Rests { vec4 rest[]; }; // w: which solid
#endif
layout(std430, binding = 0) buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = 1) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = 3) writeonly buffer Pressures { vec2 pressure[]; };  // p, p V^2
layout(std430, binding = 4) buffer Velocities { vec4 velocity[]; };           // w: rho / rho0 - 1, its own alone
#ifdef DIFFUSION
layout(std430, binding = 5) readonly buffer Slopes { vec4 slope[]; };         // w: rho / rho0 - 1 before this pass
#endif
layout(location = 0) uniform float dt;

// Sum of F v_ij . x_ij over what the images of the particle at x, in the cell `at`, find.
float images_flow(vec3 x, vec3 v, ivec3 at)
{
    float h = kernel.x, sum = 0.0;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        vec3 u = image.sign * v;
        for (int row = FIRST_ROW; row < LAST_ROW; row++) {
            uvec2 range = row_of(at, row);
            vec3 seen_from = row_seen(image.x, at, row);
            for (uint j = range.x; j < range.y; j++) {
                vec3 d = seen_from - position[j].xyz;
                float r2 = dot(d, d);
                if (r2 < h * h)
                    sum += image_shape(sqrt(r2)) * dot(u - velocity[j].xyz, d);
            }
#ifdef SOLIDS
            range = boundary_row_of(at, row);
            for (uint j = range.x; j < range.y; j++) {
                vec3 other = boundary_position[j].xyz, d = seen_from - other;
                float r2 = dot(d, d);
                if (r2 < h * h)
                    sum += image_shape(sqrt(r2)) *
                           dot(u - solid_velocity_at(int(rest[boundary_state[j].y].w), other), d);
            }
#endif
        }
    }
    return sum;
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz, v = velocity[i].xyz;
    float h = kernel.x, least = 1e-6 * h, sum = 0.0;
    uint fluid = name[i].y;
    ivec3 at = cell_of(x);
#ifdef DIFFUSION
    vec4 own = slope[i];
#endif
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {
        uvec2 range = row_of(at, row);
        vec3 seen_from = row_seen(x, at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec3 d = seen_from - position[j].xyz;
            float r2 = dot(d, d);
            if (r2 >= h * h || r2 < least * least)
                continue;
            float flow = dot(v - velocity[j].xyz, d);
#ifdef DIFFUSION
            if (name[j].y == fluid) {
                vec4 other = slope[j];
                flow -= term_scales.y * (other.w - own.w + 0.5 * dot(own.xyz + other.xyz, d));
            }
#endif
            sum += shape(sqrt(r2) * kernel.y) * flow;
        }
#ifdef SOLIDS
        range = boundary_row_of(at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec3 other = boundary_position[j].xyz, d = seen_from - other;
            float r2 = dot(d, d);
            if (r2 >= h * h || r2 < least * least)
                continue;
            int solid = int(rest[boundary_state[j].y].w); // whose own velocity it is, not the mirrored one
            sum += shape(sqrt(r2) * kernel.y) * dot(v - solid_velocity_at(solid, other), d);
        }
#endif
    }
    float rate = -term_scales.x * (sum + images_flow(x, v, at));
    float e = velocity[i].w + rate / kernel.z * dt;
    State state = state_of(e, fluid);
    velocity[i].w = e;
    position[i].w = state.volume;
    pressure[i] = state.pressure;
}
