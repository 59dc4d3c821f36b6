// Where fluid comes and goes: the block FlowBlock in sim/gl/compute/flow.c.
#define DRAINS_MAX 8
#define GUIDES_MAX 32

struct Region {
    vec4 low;  // of a block, or a ball's centre; w: 1 for a ball
    vec4 high; // w: a ball's radius squared
};

struct Guide {
    vec4 centre;    // w: radius
    vec4 direction; // w: depth
    vec4 velocity;  // w: fluid
};

layout(std140, binding = 7) uniform Flow {
    ivec4 flow_counts;   // drains, guides, candidates of a layer, particles that the grid has
    ivec4 flow_layer;    // fluid, first id, most
    vec4 layer_velocity;
    Region drains[DRAINS_MAX];
    Guide guides[GUIDES_MAX];
};
