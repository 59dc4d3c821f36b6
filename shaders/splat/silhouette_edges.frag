// Neighbours across an outline of the fluid: on the right, above, on the left, below. 1 if one of the two pixels is fluid in
// front of the other, 0.5 if fluid and a solid meet in another way.
#include "common/frame.glsl"
#include "splat/silhouette.glsl"

layout(location = 0) out vec4 edges;

// False for partly covered pixels, which are already blended with the background.
bool whole(ivec2 pixel)
{
#ifdef DISCS
    return texelFetch(weight_map, pixel, 0).y >= 1e8;
#else
    return true;
#endif
}

// True for a continuous surface: the slope on one side is about as steep as the step.
bool goes_on(ivec2 pixel, ivec2 along, float here, float next)
{
    float before = abs(here - seen_at(pixel - along).depth), after = abs(seen_at(pixel + 2 * along).depth - next);
    return abs(here - next) <= least + 2.0 * min(before, after);
}

float across(ivec2 pixel, ivec2 along, Seen here)
{
    Seen next = seen_at(pixel + along);
    if (here.fluid && next.fluid ? abs(here.depth - next.depth) <= least : here.fluid == next.fluid)
        return 0.0;
    bool first = here.fluid && here.depth < next.depth - least, second = next.fluid && next.depth < here.depth - least;
    if (!first && !second)
        return 0.5;
    if (here.fluid && next.fluid && goes_on(pixel, along, here.depth, next.depth))
        return 0.0;
    return whole(first ? pixel : pixel + along) ? 1.0 : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Seen here = seen_at(pixel);
    edges = vec4(across(pixel, ivec2(1, 0), here), across(pixel, ivec2(0, 1), here), across(pixel, ivec2(-1, 0), here),
                 across(pixel, ivec2(0, -1), here));
}
