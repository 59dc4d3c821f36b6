// As spheres.frag. Pixels outside the sphere get depth 0 and fail the depth test: cheaper than discard; likewise gl_PointCoord is
// cheaper than gl_FragCoord.
layout(location = 0) flat in vec4 axes;
layout(location = 1) flat in uvec4 rest;
#ifdef VEILED
#include "common/veil.glsl"
layout(location = 2) flat in vec2 door;
#endif
layout(location = 0) out uint seen;

void main()
{
    vec3 depth = uintBitsToFloat(rest.xyz);
    vec2 at = gl_PointCoord - 0.5;
    float x = dot(axes.xy, at), y = dot(axes.zw, at);
    float e = 1.0 - x * x - y * y;
    gl_FragDepth = e < 0.0 ? 0.0 : depth.x + depth.y * x + depth.z * sqrt(e);
#ifdef VEILED
    if (!veil_covers(door, gl_FragCoord.xy))
        gl_FragDepth = 0.0;
#endif
    seen = rest.w;
}
