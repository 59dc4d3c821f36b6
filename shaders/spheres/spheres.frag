// Finds the visible particle in each pixel, and its exact depth; shading follows, once per pixel.
#include "common/frame.glsl"
#include "common/sphere.glsl"

layout(location = 0) noperspective in vec3 offset;
layout(location = 1) flat in vec3 constants;
layout(location = 2) flat in uint index;
#ifdef VEILED
#include "common/veil.glsl"
layout(location = 3) flat in vec2 door;
#endif
layout(location = 0) out uint seen;
layout(depth_less) out float gl_FragDepth; // than the corner's: spheres.vert

void main()
{
    float e, depth = sphere_depth(offset, constants, e);
    if (e < 0.0 || depth <= 0.0 || depth > 1.0)
        discard;
#ifdef VEILED
    if (!veil_covers(door, gl_FragCoord.xy))
        discard;
#endif
    gl_FragDepth = depth;
    seen = index;
}
