// Bubbles of the foaming particles, as points: a fixed number per particle, at offsets fixed by the particle's id. The first
// point is a soft patch as wide as the particle, which joins the bubbles.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/particles.glsl"
#include "common/particle_ids.glsl"
#include "water/foam.glsl"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(std430, binding = FOAM_LIST_STORAGE) readonly buffer List { uvec2 listed[]; };
layout(std430, binding = FOAM_COMMAND_STORAGE) readonly buffer Commands { uint command[5]; };
layout(binding = FOAM_SURFACE_UNIT) uniform sampler2D surface_depth; // reversed, like the target's depth
layout(location = 0) flat out vec4 light;  // colour; opacity
layout(location = 1) flat out vec3 bubble; // depth below the eye and radius, m; 1: the patch

// Even points in a ball by the golden ratio in three dimensions, with a start per particle.
vec3 in_ball(uint number, float begin)
{
    vec3 even = fract(begin * vec3(1.0, 7.31, 3.77) + float(number) * vec3(0.8191725, 0.6710436, 0.5497005));
    float z = 2.0 * even.x - 1.0, turn = 6.2831853 * even.y;
    return pow(even.z, 1.0 / 3.0) * vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(turn), sin(turn)), z);
}

// True if a position is so deep below the surface that foam.frag would draw nothing, as for most bubbles.
bool is_deep(vec3 at)
{
    vec2 on = clamp(0.5 + 0.5 * ndc_of_eye(vec3(at.xy, min(at.z, -near_plane))), 0.0, 1.0) * (picture_size - 1.0);
    float surface = near_plane / max(texelFetch(surface_depth, ivec2(on), 0).x, 1e-30);
    return -at.z - surface > FOAM_DEEP * particle_spacing;
}

void main()
{
    uint each_has = command[4], number = uint(gl_VertexID) % each_has;
    uvec2 entry = listed[uint(gl_VertexID) / each_has];
    float foam = uintBitsToFloat(entry.y), own = id_share(entry.x), size = fract(own * 31.7 + float(number) * 0.6180340);
    bool patch_one = number == 0u;
    // Bubbles appear one by one and grow from size 0.
    float there = clamp(foam * float(each_has) - float(number) + 1.0, 0.0, 1.0);
    vec3 offset = patch_one ? vec3(0.0) : 0.8 * particle_spacing * in_ball(number, own);
    float radius = particle_spacing * (patch_one ? 1.6 : there * (0.06 + 0.12 * size * size) * sqrt(float(FOAM_BUBBLES) / float(each_has)));
    vec3 half_box = 0.5 * box_size, place = particle_position(entry.x) + offset;
    place = clamp(place, vec3(-half_box.x, 0.0, -half_box.z), vec3(half_box.x, box_size.y, half_box.z));
    vec3 at = (box_to_eye * vec4(place, 1.0)).xyz;
    float key = fluid_light_at((eye_to_light * vec4(at, 1.0)).xyz), pixels = radius * picture_size.y / (view_tangent.y * max(-at.z, near_plane));
#ifdef SOLIDS
    key *= solid_light(at);
#endif
    float hides = patch_one ? 0.45 * foam : 0.6 * min(pixels * pixels, 1.0);
    vec3 white = ambient_light(up_in_eye) * 0.85 + 0.45 * key * light_color;
    light = vec4(mix(vec3(1.0), white, shading), hides);
    bubble = vec3(-at.z, radius, patch_one ? 1.0 : 0.0);
    bool seen = -at.z > near_plane && there > 0.0 && !is_deep(at);
    gl_Position = seen ? clip_of_eye(at) : vec4(2.0, 2.0, 0.5, 1.0);
    gl_PointSize = max(pixels, 1.0);
}
