// Leaves only pixels that may be beside an outline, for render/splat/silhouette.c.
#include "common/frame.glsl"
#include "splat/silhouette.glsl"

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
    if (!may)
        discard;
}
