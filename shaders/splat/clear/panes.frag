// The surface cut at the box, for render/views/splat/splat_private.h: where a ray enters fluid through a wall, the surface is the wall.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"
#include "common/within_box.glsl"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = 0) out float cut;

// Particles are half a spacing from a wall, and their drawn surface ends a little before or behind the wall.
const float slack = 0.35; // spacings

void main()
{
    float z = texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x;
    Within box = within_box(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)));
    bool at_wall = box.enter > near_plane && (z - box.enter) * box.slope < slack * particle_spacing;
    cut = z >= min(box.leave, 1e29) || box.enter >= box.leave ? 1e30 : at_wall ? -box.enter : z;
}
