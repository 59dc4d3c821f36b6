// Particles where the field stays below the level, as balls of their own volume: four vertices each, the corners of the bound on
// the screen. Balls shrink to nothing as the surface forms around.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "common/particles.glsl"
#include "common/particle_color.glsl"
#include "common/sphere.glsl"
#include "shaders/volume/volume_bindings.h"
layout(binding = FIELD_UNIT) uniform sampler3D field_map;
layout(location = DROPS_FLAT_AT) uniform bool flat_scene;  // volumes are areas
layout(location = DROPS_CORNER_AT) uniform vec3 corner_at; // corner of the volume, m, box's frame
layout(location = DROPS_PER_SIDE_AT) uniform vec3 per_side; // 1/m
layout(location = DROPS_LOW_AT) uniform vec3 field_low;    // as in RaycastBlock
layout(location = DROPS_HIGH_AT) uniform vec3 field_high;
layout(location = DROPS_LEVEL_AT) uniform float surface_level;

layout(location = 0) noperspective out vec3 offset;
layout(location = 1) flat out vec3 constants;
layout(location = 2) flat out vec4 drop; // centre in the eye's frame, radius
layout(location = 3) flat out vec3 albedo;

const float pi = 3.14159265;

float own_radius(float volume)
{
    return flat_scene ? sqrt(volume / pi) : pow(0.75 / pi * volume, 1.0 / 3.0);
}

void main()
{
    uint index = uint(gl_VertexID) >> 2;
    vec3 at = particle_position(index);
    float volume = position_words[index * position_stride + 3u];
    vec3 place = clamp((at - corner_at) * per_side, field_low, field_high);
    // For a level of 0.5: a lone particle has a field of 0.17, three in a row at most 0.33, four touching particles 0.40 with a
    // surface between, an edge of fluid 0.4.
    float alone = 1.0 - smoothstep(0.6 * surface_level, 0.85 * surface_level, textureLod(field_map, place, 0.0).x);
#ifdef WATER
    alone *= 0.5; // a particle stands for spray of finer drops: balls of the whole volume look like glass beads
#endif
    float radius = own_radius(volume) * alone;
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    offset = constants = albedo = vec3(0.0);
    drop = vec4(0.0);
    if (is_nan(radius) || radius < 1e-6 * particle_radius || radius > 1e15)
        return;
    Sphere sphere = sphere_at((box_to_eye * vec4(at, 1.0)).xyz, radius);
    vec4 bounds = sphere_bounds(sphere);
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? bounds.x : bounds.y, (gl_VertexID & 2) == 0 ? bounds.z : bounds.w);
    offset = sphere_offset(sphere, ray_of_ndc(corner));
    constants = sphere_constants(sphere);
    drop = vec4(sphere.centre, radius);
    albedo = particle_color(index);
    gl_Position = vec4(corner, 0.5, 1.0);
}
