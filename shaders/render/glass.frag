// A thin glass pane: the outer side's reflection of sky and floor. The inner side reflects almost nothing at water, and is left
// out.
#include "common/frame.glsl"
#include "common/environment.glsl"
#include "common/fresnel.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) flat in vec3 normal;
layout(location = 0) out vec4 color;

const float ior = 1.5, most = 0.14; // window glass; at a slant more would turn the water behind grey

void main()
{
    vec3 view = normalize(place);
    vec3 mirrored = environment_light((eye_to_world * vec4(place, 1.0)).xyz, mat3(eye_to_world) * reflect(view, normal));
    color = vec4(mirrored, min(fresnel(clamp(-dot(view, normal), 0.0, 1.0), ior), most));
}
