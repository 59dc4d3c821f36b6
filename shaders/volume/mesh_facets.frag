// A triangle of the mesh as a facet: the normal in the eye's frame, and the part of the pixel under edges. Triangles of a few
// pixels show no edges, since the whole mesh would be grey.
#include "common/frame.glsl"

layout(location = 0) in vec3 in_eye;
layout(location = 1) in vec3 corner_share; // 1 at one corner, 0 along the edge across
layout(location = 0) out vec4 facet;

void main()
{
    vec3 across = cross(dFdx(in_eye), dFdy(in_eye)), per_pixel = max(fwidth(corner_share), vec3(1e-6));
    vec3 pixels = corner_share / per_pixel;
    float nearest = min(min(pixels.x, pixels.y), pixels.z), half_width = 0.5 * max(fineness, picture_size.y / 720.0);
    float small = smoothstep(0.12, 0.4, max(max(per_pixel.x, per_pixel.y), per_pixel.z) / max(2.0 * half_width, 1.0));
    facet = vec4(across * inversesqrt(max(dot(across, across), 1e-30)), clamp(half_width + 0.5 - nearest, 0.0, 1.0) * (1.0 - small));
}
