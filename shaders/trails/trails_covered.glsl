// The fraction of a pixel that a line covers; negative if the scalars of the ends are not the scalar shown.
#include "shaders/shared/bindings.h"
#include "shaders/trails/trails_bindings.h"

layout(location = HALF_WIDTH_AT) uniform float half_width; // pixels
layout(location = TRAIL_KNOWN_AT) uniform uint known;

float covered_of(float across)
{
    float covered = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
    return known != 0u ? covered : -covered;
}
