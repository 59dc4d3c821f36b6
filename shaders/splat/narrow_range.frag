// One pass of the filter of render/views/splat/splat_private.h: along one axis, or with CLEAN over 5 x 5 pixels. Pairs of opposite
// samples are taken from the middle outwards; a pair partly outside the picture is left out.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D depth_map;
layout(location = FILTER_REACH_AT) uniform float filter_reach;   // half the kernel's width at a depth of 1 m, pixels
layout(location = FILTER_RANGE_AT) uniform float filter_range;   // m
layout(location = FILTER_AXIS_AT) uniform ivec2 along;           // the axis
layout(location = 0) out float filtered;

// t = middle / z - 1 of a sample: positive if nearer; linear on the screen for a plane. A pane of the box (z below 0) is another
// surface in front.
float nearness(float middle, ivec2 pixel)
{
    float z = texelFetch(depth_map, pixel, 0).x;
    return z < 0.0 ? 1e9 : z < 1e29 ? (middle - z) / z : -1e9;
}

// True if t is between `limits`, which then widen; other samples are of another surface. A pair with only one valid sample is
// left out entirely: a single sample would pull an inclined surface towards the side with more samples.
bool admit(float t, inout vec2 limits, float range)
{
    if (t < limits.x || t > limits.y)
        return false;
    limits = vec2(min(limits.x, t - range), max(limits.y, t + range));
    return true;
}

// Sums of weight t and of weight; for a constant depth the first sum is exactly 0.
#ifdef CLEAN
const ivec2 steps[12] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1), ivec2(2, 0), ivec2(0, 2), ivec2(2, 1),
                                ivec2(2, -1), ivec2(1, 2), ivec2(-1, 2), ivec2(2, 2), ivec2(2, -2));

vec2 sum_up(float middle, ivec2 pixel, ivec2 room)
{
    float range = filter_range / middle;
    vec2 limits = vec2(-range, range), sums = vec2(0.0, 1.0);
    for (int i = 0; i < 12; i++) {
        ivec2 offset = steps[i];
        if (any(greaterThan(abs(offset), room)))
            continue;
        float one = nearness(middle, pixel + offset), other = nearness(middle, pixel - offset);
        float w = 1.0 - float(offset.x * offset.x + offset.y * offset.y) / 9.0;
        bool first = admit(one, limits, range), second = admit(other, limits, range);
        if (first && second)
            sums += w * w * w * vec2(one + other, 2.0);
    }
    return sums;
}
#else
vec2 sum_up(float middle, ivec2 pixel, ivec2 room)
{
    float range = filter_range / middle;
    vec2 ahead = vec2(-range, range), back = ahead, sums = vec2(0.0, 1.0);
    float reach = filter_reach / middle, stride = max(ceil(reach / float(TAPS)), 1.0);
    int taps = min(int(ceil(reach / stride)) - 1, (along.x != 0 ? room.x : room.y) / int(stride));
    for (int i = 1; i <= taps; i++) {
        ivec2 offset = i * int(stride) * along;
        float one = nearness(middle, pixel + offset), other = nearness(middle, pixel - offset);
        float q = float(i) * stride / reach, w = 1.0 - q * q;
        bool first = admit(one, ahead, range), second = admit(other, back, range);
        if (first && second)
            sums += w * w * w * vec2(one + other, 2.0);
    }
    return sums;
}
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float middle = texelFetch(depth_map, pixel, 0).x;
    vec2 sums = vec2(0.0, 1.0);
    if (middle > 0.0 && middle < 1e29)
        sums = sum_up(middle, pixel, min(pixel, ivec2(picture_size) - 1 - pixel));
    filtered = middle / (1.0 + sums.x / sums.y);
}
