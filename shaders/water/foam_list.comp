// Lists the foaming particles in order, with their strength, and writes the drawing command of the bubbles: for
// render/water/foam.c.
#include "water/foam.glsl"

layout(location = FOAM_MOST_AT) uniform uint most; // limit of bubbles, but at least one per particle
layout(std430, binding = FOAM_AMOUNTS_STORAGE) readonly buffer Amounts { float amounts[]; };
layout(std430, binding = FOAM_LIST_STORAGE) writeonly buffer List { uvec2 listed[]; };
layout(std430, binding = FOAM_COMMAND_STORAGE) writeonly buffer Commands { uint command[5]; };

bool chosen(uint i) { return amounts[i] > 0.0; }

void put(uint to, uint i) { listed[to] = uvec2(i, floatBitsToUint(amounts[i])); }

void finish(uint total)
{
    uint each_has = clamp(most / max(total, 1u), 1u, FOAM_BUBBLES);
    command = uint[5](each_has * total, 1u, 0u, 0u, each_has);
}

#include "common/select.glsl"
