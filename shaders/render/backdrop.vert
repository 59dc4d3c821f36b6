// One triangle over the whole screen at infinite distance (reversed depth 0), with its view rays in the world.
#include "common/frame.glsl"

layout(location = 0) noperspective out vec3 ray;

void main()
{
    vec2 ndc = 2.0 * vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) - 1.0;
    ray = mat3(eye_to_world) * ray_of_ndc(ndc);
    gl_Position = vec4(ndc, 0.0, 1.0);
}
