#include "shaders/shared/frame_block.h"

vec2 ndc_of_pixel(vec2 pixel)
{
    return pixel * pixel_size * 2.0 - 1.0;
}

// The point of the view ray at depth 1 below the eye.
vec3 ray_of_ndc(vec2 ndc)
{
    return vec3(ndc * view_tangent, -1.0);
}
