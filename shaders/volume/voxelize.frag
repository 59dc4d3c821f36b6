// A particle's contribution to a voxel, or with PACKED to four stacked voxels; blending sums.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

#ifdef PACKED
layout(location = PASS_SLICE_AT) uniform int pass_slice;
#define SUM vec4
#else
#define SUM float
#endif
layout(location = 0) flat in vec4 disc;
layout(location = 0) out SUM field;
#ifdef SCALAR
layout(location = 1) flat in float carried;
layout(location = 1) out SUM scalar;
#endif

void main()
{
    vec2 away = gl_FragCoord.xy - disc.xy;
#ifdef PACKED
    vec4 z = float(pass_slice) + vec4(0.5, 1.5, 2.5, 3.5) - disc.z;
    vec4 t = max(1.0 - (dot(away, away) + z * z) * radius2_inverse, 0.0);
    field = disc.w * t * t * t;
#else
    field = disc.w * poly6_shape(disc.z - dot(away, away) * radius2_inverse);
#endif
#ifdef SCALAR
    scalar = field * carried;
#endif
}
