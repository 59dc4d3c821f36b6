// The sky as a gradient, and the floor fading into the sky; with FLOOR_SHADOW, with the fluid's shadow.
#include "common/frame.glsl"
#include "common/environment.glsl"

layout(location = 0) flat in vec3 ray_corner;
layout(location = 1) flat in vec3 ray_x;
layout(location = 2) flat in vec3 ray_y;
layout(location = 0) out vec4 color;

// Hides the bands of 8-bit colours; after Jimenez, Next generation post processing in Call of Duty, 2014.
float grain()
{
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main()
{
    vec3 ray = ray_corner + gl_FragCoord.x * ray_x + gl_FragCoord.y * ray_y;
    color = vec4(environment_light(eye_to_world[3].xyz, ray) + background * (grain() * (1.5 / 255.0)), 1.0);
}
