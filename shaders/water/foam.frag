// A bubble of foam, or the soft patch under a particle's bubbles. Visible on the fluid's surface and, fainter with distance, a
// little below and above.
#include "common/frame.glsl"
#include "water/foam.glsl"

layout(binding = FOAM_SURFACE_UNIT) uniform sampler2D surface_depth; // reversed, like the target's depth
#ifdef SOLIDS
layout(binding = FOAM_SOLID_UNIT) uniform sampler2D solid_depth;
#endif
layout(location = 0) flat in vec4 light;
layout(location = 1) flat in vec3 bubble;
layout(location = 0) out vec4 color;

const float beside = 0.8; // distance from the surface, in spacings, where a fifth of a bubble's cover is left

// A patch is where the surface is inside a soft ball around the particle.
float patch_cover(float far, float behind)
{
    float inside = max(1.0 - far - behind * behind / (bubble.y * bubble.y), 0.0);
    return inside * inside;
}

// 0 on the panes of the box, where water below its surface would be white; 1 from half a spacing inside on.
float off_panes(vec2 pixel, float surface)
{
    vec3 at = (ray_of_ndc(ndc_of_pixel(pixel)) * surface - box_to_eye[3].xyz) * mat3(box_to_eye);
    vec2 inside = 0.5 * box_size.xz - abs(at.xz);
    return smoothstep(0.1, 0.5, min(inside.x, inside.y) / particle_spacing);
}

float bubble_cover(float far, float behind)
{
    return exp2(-2.2 * behind / (beside * particle_spacing)) * (1.0 - smoothstep(0.5, 1.0, far));
}

void main()
{
    vec2 from = 2.0 * gl_PointCoord - 1.0;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float far = min(dot(from, from), 1.0), surface = near_plane / max(texelFetch(surface_depth, pixel, 0).x, 1e-30);
    float behind = min(abs(surface - bubble.x), 10.0 * particle_spacing);
    float cover = light.a * (bubble.z > 0.0 ? patch_cover(far, behind) * off_panes(gl_FragCoord.xy, surface) : bubble_cover(far, behind));
#ifdef SOLIDS
    cover *= step(bubble.x, near_plane / max(texelFetch(solid_depth, pixel, 0).x, 1e-30) + bubble.y);
#endif
    color = vec4(light.rgb * (bubble.z > 0.0 ? 1.0 : 1.05 - 0.2 * far), cover);
}
