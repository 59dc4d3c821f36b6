// Marks pixels that may be beside an outline by the depth of a triangle at depth 0, for render/views/splat/splat_shade.c; clears the
// edges.
#include "common/frame.glsl"
#include "splat/silhouette.glsl"

layout(location = 0) out vec4 edges;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Seen here = seen_at(pixel);
    bool may = false;
    for (int i = 0; i < 4; i++) {
        int step = 1 - (i & 2);
        Seen next = seen_at(pixel + ((i & 1) == 0 ? ivec2(step, 0) : ivec2(0, step)));
        may = may || here.fluid != next.fluid || (here.fluid && abs(here.depth - next.depth) > least);
    }
    edges = vec4(0.0);
    gl_FragDepth = may ? 0.0 : 1.0;
}
