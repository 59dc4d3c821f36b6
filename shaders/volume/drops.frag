// A drop: opaque, or WATER with refraction at both sides of the ball.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/environment.glsl"
#include "common/behind.glsl"
#include "common/surface.glsl"
#include "common/clear.glsl"
#include "common/sphere.glsl"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(location = 0) noperspective in vec3 offset;
layout(location = 1) flat in vec3 constants;
layout(location = 2) flat in vec4 drop;
layout(location = 3) flat in vec3 albedo;
layout(location = 0) out vec4 color;

#ifdef WATER
// Straight through the ball after the first refraction; a ray from outside is never totally reflected at the other side.
vec3 seen_through(inout Surface s)
{
    vec3 to = refract(s.view, s.normal, 1.0 / refraction_index);
    s.thickness = 2.0 * drop.w * max(-dot(to, s.normal), 0.0);
    vec3 leave = s.place + s.thickness * to, on = refract(to, (drop.xyz - leave) / drop.w, refraction_index);
#ifdef SOLIDS
    vec3 seen = behind_at(leave + 0.3 * max(box_size.x, box_size.y) * on, near_plane / -s.place.z, gl_FragCoord.xy);
#else
    vec3 seen = environment(leave, on);
#endif
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation));
}
#endif

void main()
{
    float e, depth = sphere_depth(offset, constants, e);
    if (e < 0.0 || depth <= 0.0 || depth > 1.0)
        discard;
    gl_FragDepth = depth;
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)), place = near_plane / depth * ray;
    float lit = fluid_light(place, gl_FragCoord.xy), key = lit;
#ifdef SOLIDS
    key *= solid_light(place);
#endif
    Surface s = Surface(place, normalize(ray), normalize(place - drop.xyz), albedo, lit, key, 0.0, 1.0);
#ifdef WATER
    s.bare = rim_of_drop(drop.w, -drop.z);
    s.normal = facing(s.normal, s.view);
    vec3 inside = seen_through(s);
    color = vec4(mix(inside, with_surface(s, inside + scattered(s)), shading), 1.0);
#else
    color = vec4(mix(albedo, phong(s), shading), 1.0);
#endif
}
