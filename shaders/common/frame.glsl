#include "shaders/shared/frame_block.h"

vec2 ndc_of_pixel(vec2 pixel)
{
    return pixel * pixel_size * 2.0 - 1.0;
}

// The point of the view ray at depth 1 below the eye.
vec3 ray_of_ndc(vec2 ndc)
{
    return vec3((ndc - view_centre) * view_tangent, -1.0);
}

// A position in the eye's frame on the screen; and in clip space.
vec2 ndc_of_eye(vec3 at)
{
    return at.xy / (-at.z * view_tangent) + view_centre;
}

vec4 clip_of_eye(vec3 at)
{
    return vec4(at.xy / view_tangent - at.z * view_centre, near_plane, -at.z);
}
