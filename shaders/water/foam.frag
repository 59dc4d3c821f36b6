// A bubble of foam, or the soft patch under a particle's bubbles. Visible on the fluid's surface and, fainter with depth, a
// little below.
#include "common/frame.glsl"
#include "water/foam.glsl"

layout(binding = FOAM_SURFACE_UNIT) uniform sampler2D surface_depth; // reversed, like the target's depth
#ifdef SOLIDS
layout(binding = FOAM_SOLID_UNIT) uniform sampler2D solid_depth;
#endif
layout(location = 0) flat in vec4 light;
layout(location = 1) flat in vec3 bubble;
layout(location = 0) out vec4 color;

const float below = 0.8; // depth, in spacings, where a fifth of the cover is left

void main()
{
    vec2 from = 2.0 * gl_PointCoord - 1.0;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float far = min(dot(from, from), 1.0), surface = near_plane / max(texelFetch(surface_depth, pixel, 0).x, 1e-30);
    float deep = max(bubble.x - surface, 0.0) / (below * particle_spacing), cover = light.a * exp2(-2.2 * deep);
#ifdef SOLIDS
    cover *= step(bubble.x, near_plane / max(texelFetch(solid_depth, pixel, 0).x, 1e-30) + bubble.y);
#endif
    cover *= bubble.z > 0.0 ? (1.0 - far) * (1.0 - far) : 1.0 - smoothstep(0.5, 1.0, far);
    color = vec4(light.rgb * (bubble.z > 0.0 ? 1.0 : 1.05 - 0.2 * far), cover);
}
