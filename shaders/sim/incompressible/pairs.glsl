// The sums over neighbours of methods that hold the number density: what a particle finds, and what its images in the walls
// find. A pass declares PLACES[], says what a pair adds, and takes `whole`.
#define KERNEL_WENDLAND_C2 1
#include "sim/constants.glsl"
#include "sim/shapes.glsl"
#include "sim/images.glsl"
#include "sim/walk.glsl"
#include "sim/pair_direction.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#define BOUNDARY_ID 0x80000000u
#ifndef BOUNDARY_TIMES // how often a boundary particle of solids counts
#define BOUNDARY_TIMES 1.0
#endif

// Who looks: particle `self`, or its image with the signs `mirror`. `part` is a sum in the axes of who looks, `whole` that
// of all of them in the particle's axes.
uint self;
vec3 mirror = vec3(1), part = vec3(0), whole;

// The pass's: j adds to the sums, d away, q = |d| / h; `term` is the fourth number of its place. An image sees its own
// particle, too.
void pair(uint j, vec3 d, float q, float term);
void boundary_pair(uint j, vec3 d, float q);

// Two at one place are taken for apart, along a direction that their ids decide, as far as sim/cpu/pair_loop.h has it. A
// macro, so that nobody else reads ids.
#define SEPARATE(a, b, d)                        \
    if (dot(d, d) < 1e-12 * support * support)   \
        d = 0.1 * support * direction_of_ids(a, b);

float q_of(vec3 d) { return length(d) * inverse_support; }

// Of an image next to its particle: not 0.
float image_q(vec3 d) { return max(q_of(d), 1e-6); }

void meet(uint j, vec3 d, float term)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    pair(j, d, q_of(d), term);
}

void meet_image(uint j, vec3 d, float term)
{
    if (dot(d, d) < support * support)
        pair(j, d, image_q(d), term);
}

#ifdef SOLIDS
void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    boundary_pair(j, d, q_of(d));
}

void meet_boundary_image(uint j, vec3 d, float volume)
{
    if (dot(d, d) < support * support)
        boundary_pair(j, d, image_q(d));
}
#endif

// Whom an image sees its particle has in its list (sim/cpu/pair_images.h), but not while the list is made.
#ifdef LISTS_FIRST
#define WALK_IMAGE(x, at) WALK(x, at, meet_image, meet_boundary_image)
#else
#define WALK_IMAGE(x, at) WALK_NEIGHBOURS(self, x, at, meet_image, meet_boundary_image, 0)
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        mirror = image.sign;
        part = vec3(0);
        WALK_IMAGE(image.x, at)
        whole += mirror * part;
    }
}

// Of particle i at x.
void walk_pairs(uint i, vec3 x)
{
    ivec3 at = cell_of(x);
    self = i;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    whole = part;
    walk_images(x, at);
}
