// wcsph with surface tension by curvature: bodies of connected fluid, and normals of the surfaces; their length is their weight: wcsph_normals of
// sim/methods/wcsph/pairs_surface.c. The first walk of a step.
#define LISTS_FIRST
#define OUTWARD_ACCESS writeonly
#include "sim/constants.glsl"
#include "shaders/sim/term_block.h"
#include "sim/wcsph/wcsph.glsl"
#include "sim/walk.glsl"
#include "sim/wcsph/surface.glsl"
#include "sim/wcsph/drops.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };

uint own_fluid;
vec3 slopes = vec3(0); // of the particle, or of an image
uint self, root;

void meet(uint j, vec3 d, float volume)
{
    if (FLUID_OF(j) == own_fluid)
        slopes += surface_slope(dot(d, d)) * d;
}

void meet_and_join(uint j, vec3 d, float volume)
{
    meet(j, d, volume);
    if (j < self && FLUID_OF(j) == own_fluid && dot(d, d) < support * support && drop[j] != root)
        root = drop_join(root, j);
}

vec3 slopes_of_images(vec3 x, ivec3 at)
{
    vec3 sum = vec3(0);
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        slopes = vec3(0);
        WALK_FLUID(image.x, at, meet)
        sum += image.sign * slopes;
    }
    return sum;
}

// curvature_weight of sim/def/fluids.h.
float weight_of(float x)
{
    float t = clamp((x - curvature_least) / (curvature_whole - curvature_least), 0.0, 1.0);
    return x * t * t * (3.0 - 2.0 * t);
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    own_fluid = FLUID_OF(i);
    self = i;
    root = drop_root(i);
    WALK_OWN_FLUID(i, x, at, meet_and_join)
    vec3 n = slopes; // copied before the images overwrite `slopes`
    n += slopes_of_images(x, at);
    float size = length(n);
    outward[i] = vec4(weight_of(curvature_full * size) / max(size, 1e-20) * n, 0.0);
}
