// Culling of hidden particles on a coarse map, for render/splat/cull.c. A cell holds a depth behind which nothing can be seen in it: that
// of the nearest sprite that covers all of its pixels' centres. A particle whose sprite lies behind all cells that it
// touches is hidden.
#include "shaders/splat/splat_bindings.h"
layout(location = CELLS_AT) uniform uvec2 cell_count; // columns, rows
layout(location = CELL_SIDE_AT) uniform uint cell_side; // pixels
layout(location = WIDEN_REACH_AT) uniform uint widen_reach; // how far maxima reach, cells
layout(location = CULL_PIXELS_AT) uniform vec2 cull_pixels; // of the picture, wide and high
layout(std430, binding = CULL_MAP_STORAGE) buffer Nearest { uint nearest[]; }; // bits of a depth that is not negative: ordered as it is

const uint nothing = 0x7f800000u; // infinity

