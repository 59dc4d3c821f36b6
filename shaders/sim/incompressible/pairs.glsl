// Sums over neighbours for methods with a fixed number density: of a particle, and of the particle's images in the walls. A
// pass declares PLACES[], defines the part of a pair, and uses `whole`.
#define KERNEL_WENDLAND_C2 1
#include "sim/constants.glsl"
#include "sim/shapes.glsl"
#include "sim/images.glsl"
#include "sim/walk.glsl"
#include "sim/pair_direction.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#define BOUNDARY_ID 0x80000000u
#ifndef BOUNDARY_TIMES // weight of a boundary particle of solids
#define BOUNDARY_TIMES 1.0
#endif

// Viewer: particle `self`, or the particle's image with the signs `mirror`. `part` is a sum in the viewer's axes, `whole` the
// sum over all viewers in the particle's axes.
uint self;
vec3 mirror = vec3(1), part = vec3(0), whole;

// Defined by the pass: adds j to the sums, d away, q = |d| / h; `term` is the fourth number of j's place. An image sees the
// particle itself too.
void pair(uint j, vec3 d, float q, float term);
void boundary_pair(uint j, vec3 d, float q);

// Two particles at one place count as apart, along a direction given by their ids, by the distance of sim/cpu/pair_loop.h. A
// macro, so that other passes do not read ids.
#define SEPARATE(a, b, d)                        \
    if (dot(d, d) < 1e-12 * support * support)   \
        d = 0.1 * support * direction_of_ids(a, b);

float q_of(vec3 d) { return length(d) * inverse_support; }

// r / h of an image, above 0 even next to the particle.
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

// An image's neighbours are in the particle's list (sim/cpu/pair_loop.h), except while the list is made.
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

// Sums of particle i at x.
void walk_pairs(uint i, vec3 x)
{
    ivec3 at = cell_of(x);
    self = i;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    whole = part;
    walk_images(x, at);
}
