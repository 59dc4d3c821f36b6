// The field in the slice, by the colormap.
#include "common/frame.glsl"
#include "volume/field.glsl"

layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = 0) in vec3 box_point;
layout(location = 0) out vec4 color;

void main()
{
    float share = clamp((field_at(box_point) - range_low) * range_scale, 0.0, 1.0);
    color = texelFetch(colormap, ivec2(share * 255.0 + 0.5, 0), 0);
}
