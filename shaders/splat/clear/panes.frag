// The surface cut to the box, for render/splat/panes.h: fluid that a ray enters by a wall is seen from that wall on.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"
#include "common/within_box.glsl"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = 0) out float cut;

// Particles stand half a spacing from a wall, and what is drawn of them ends a little before it or behind it.
const float slack = 0.35; // spacings

void main()
{
    float z = texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x;
    Within box = within_box(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)));
    bool at_wall = box.enter > near_plane && (z - box.enter) * box.slope < slack * particle_spacing;
    cut = z >= min(box.leave, 1e29) || box.enter >= box.leave ? 1e30 : at_wall ? -box.enter : z;
}
