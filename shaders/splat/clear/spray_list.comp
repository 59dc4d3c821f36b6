// Lists the isolated drops, in the particles' order, and writes the drawing command, for
// render/views/splat/splat_shapes.c.
#define ELLIPSOID 1
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "splat/clear/alone.glsl"
#include "shaders/splat/splat_bindings.h"

layout(location = VERTICES_AT) uniform uint vertices; // vertices per particle
layout(std430, binding = NEAREST_LIST_STORAGE) writeonly buffer List { uint list[]; };
layout(std430, binding = CULL_COMMANDS_STORAGE) writeonly buffer Commands { uint command[8]; }; // as in splat/cull_list.comp

bool chosen(uint i) { return is_alone(i); }

void put(uint to, uint i) { list[to] = i; }

void finish(uint total) { command = uint[8](vertices * total, 1u, 0u, 0u, 0u, 0u, 0u, 0u); }

#include "common/select.glsl"
