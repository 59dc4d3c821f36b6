// pbf: places by what the multipliers grow: pbf_push in sim/pbf/pairs.c, pbf_images_push in sim/pbf/pairs_images.c, move_one in
// sim/pbf/passes.c.
#define LISTS_LATER
#define PLACES near
#include "sim/pbf/pbf.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
#ifdef SOLIDS
#define SOLID_BEGIN(k) solids[k].end // they stand
#include "sim/solid_guard.glsl"
#endif
layout(std430, binding = POSITIONS_BUFFER) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; }; // w: what k grows by, times dt^2

// What the particle's k grows by; sums of (dk_i + dk_j) F x_ij, and those of an image.
float own_growth;
vec3 sum = vec3(0), image_sum;

void meet(uint j, vec3 d, float growth)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    sum += (own_growth + growth) * shape(q_of(d)) * d;
}

void meet_image(uint j, vec3 d, float growth)
{
    if (dot(d, d) < support * support)
        image_sum += (own_growth + growth) * shape(image_q(d)) * d;
}

#ifdef SOLIDS
void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    sum += own_growth * shape(q_of(d)) * d;
}

void meet_boundary_image(uint j, vec3 d, float volume) { meet_image(j, d, 0.0); }
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_sum = vec3(0);
        WALK_NEIGHBOURS(self, image.x, at, meet_image, meet_boundary_image, 0)
        sum += image.sign * image_sum;
    }
}

vec3 shortened(vec3 way)
{
    float most = WAY_LONGEST * spacing, length2 = dot(way, way);
    if (length2 <= most * most)
        return way;
    return length2 < 1e38 ? most / sqrt(length2) * way : vec3(0);
}

// Puts x up to a solid, and no further into a wall than that asks for, else up to a little before the walls; true where it
// had to.
bool hold_back(vec3 from, inout vec3 x)
{
    vec3 asked = x;
    float apart = WALL_LEAST * spacing;
#ifdef SOLIDS
    vec3 v = vec3(0);
    if (solids_guard(from, x, v))
        apart = 0.0;
#endif
    int axes = dimensions == 2 ? 2 : 3;
    for (int a = 0; a < axes; a++) {
#ifdef PERIODIC
        if (periodic[a])
            continue;
#endif
        float low = a == 1 ? 0.0 : -half_size[a], high = a == 1 ? 2.0 * half_size.y : half_size[a];
        x[a] = min(max(x[a], low + apart), high - apart);
    }
    return x != asked;
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 from = near[i].xyz;
    ivec3 at = cell_of(from);
    self = i;
    own_growth = near[i].w;
    WALK_NEIGHBOURS(i, from, at, meet, meet_boundary, 0)
    walk_images(from, at);
    vec3 way = shortened(gradient * sum / fluids[FLUID_OF(i)].mass), x = from + way;
    if (hold_back(from, x))
        way = x - from;
    position[i].xyz = x;
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_moved + i] += way[a];
    own[OWN_term + i] += scratch[SCRATCH_change + i];
    scratch[SCRATCH_way + i] += length(way) / spacing;
}
