// A solid's surface under the shared light.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/solid_light.glsl"
#include "common/surface.glsl"
#include "common/solid.glsl"

layout(location = 0) in vec3 in_eye;
layout(location = 1) in vec3 normal_in_eye;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(solid_surface(in_eye, normalize(normal_in_eye), albedo), 1.0);
}
