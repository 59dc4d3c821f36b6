// Parts beside and above the box are not drawn and cast no shadow. Parts below the floor do: sides away from the light.
#include "common/frame.glsl"
#include "shaders/shared/solid_block.h"

layout(location = 0) in vec3 in_box;
layout(location = 1) flat in uint number;

void main()
{
    vec3 off = abs(in_box - vec3(0.0, 0.5 * box_size.y, 0.0)) - 0.5 * box_size;
    bool outside = max(off.x, off.z) > 1e-4 * particle_spacing || in_box.y > box_size.y;
    if (solids[number].cut != 0u && outside)
        discard;
}
