// What the passes of pbf share: the kernel, the walk, images. Symbols are those of sim/pbf/passes.h.
#define KERNEL_WENDLAND_C2 1
#include "sim/constants.glsl"
#include "shaders/sim/pbf/pbf_block.h"
#include "sim/shapes.glsl"
#include "sim/images.glsl"
#include "sim/walk.glsl"
#include "sim/pair_direction.glsl"
#define BOUNDARY_ID 0x80000000u

uint self;

// Two at one place are taken for apart, along a direction that their ids decide, as far as sim/cpu/pair_loop.h has it. A
// macro, so that nobody else reads ids.
#define SEPARATE(a, b, d)                        \
    if (dot(d, d) < 1e-12 * support * support)   \
        d = 0.1 * support * direction_of_ids(a, b);

float q_of(vec3 d) { return length(d) * inverse_support; }

// Of an image next to its particle: not 0.
float image_q(vec3 d) { return max(q_of(d), 1e-6); }
