// A ray through the volume, and the field along the ray. Needs common/frame.glsl.
#include "volume/raycast.glsl"
#include "shaders/volume/volume_bindings.h"

#ifdef FIELD_DIRECT
#include "volume/volume.glsl"
#include "volume/field_sum.glsl"

float field_at(vec3 at)
{
    return field_sum(at * volume_cells).x;
}
#else
layout(binding = FIELD_UNIT) uniform sampler3D field_map;

float field_at(vec3 at)
{
    return textureLod(field_map, clamp(at, field_low, field_high), 0.0).x;
}
#endif
layout(binding = ENTRY_UNIT) uniform sampler2D entry_map; // reversed depths of faces
layout(binding = EXIT_UNIT) uniform sampler2D exit_map;
#ifdef SOLIDS
layout(binding = TARGET_DEPTH_UNIT) uniform sampler2D solid_depth;
#endif

// A position on the ray is given by t: m along the eye's axis for a ray from the eye.
struct Ray {
    vec3 from, to;    // eye space: start, m; step for t = 1
    vec3 origin, way; // in volume space
    float slant;      // length of `to`
    float begin, end; // range of t to march through
    float wall;       // for t up to this value, the ray enters through a wall
};

vec3 ray_at(Ray ray, float t)
{
    return ray.origin + t * ray.way;
}

Ray ray_from(vec3 from, vec3 to)
{
    Ray ray;
    ray.from = from, ray.to = to;
    ray.origin = (eye_to_volume * vec4(from, 1.0)).xyz;
    ray.way = mat3(eye_to_volume) * to;
    ray.slant = length(to);
    ray.begin = 0.0, ray.end = 0.0, ray.wall = -1e30;
    return ray;
}

// t where the ray passes each of the sides ahead, of walls and volume; infinite if parallel.
vec3 ray_ends(Ray ray)
{
    return (clamp(mix(wall_low, wall_high, step(vec3(0.0), ray.way)), 0.0, 1.0) - ray.origin) / ray.way;
}

// t where the ray leaves the volume, if inside at t = 0.
float ray_end(Ray ray)
{
    vec3 end = ray_ends(ray);
    return min(min(end.x, end.y), end.z);
}

// Unit normal, towards the eye, of the last wall of entry.
vec3 wall_normal(Ray ray)
{
    vec3 at = (mix(wall_high, wall_low, step(vec3(0.0), ray.way)) - ray.origin) / ray.way;
    vec3 axis = at.x > at.y && at.x > at.z ? vec3(1.0, 0.0, 0.0) : at.y > at.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    return mat3(box_to_eye) * (axis * -sign(ray.way));
}

// Fluid ends at walls.
void cut_to_walls(inout Ray ray)
{
    vec3 begin = (mix(wall_high, wall_low, step(vec3(0.0), ray.way)) - ray.origin) / ray.way;
    vec3 end = (mix(wall_low, wall_high, step(vec3(0.0), ray.way)) - ray.origin) / ray.way;
    ray.wall = max(max(begin.x, begin.y), begin.z);
    ray.begin = max(ray.begin, ray.wall);
    ray.wall += 0.01 * cell_size / ray.slant; // the faces of bricks, also in walls, are rounded differently
    ray.end = min(ray.end, min(min(end.x, end.y), end.z));
}

float solid_end()
{
#ifdef SOLIDS
    return near_plane / max(texelFetch(solid_depth, ivec2(gl_FragCoord.xy), 0).x, 1e-30);
#else
    return 1e30;
#endif
}

// The ray of this pixel, from the entry into occupied bricks to the exit, or to a solid.
Ray eye_ray()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float entry = texelFetch(entry_map, pixel, 0).x, leave = texelFetch(exit_map, pixel, 0).x;
    Ray ray = ray_from(vec3(0.0), ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)));
    ray.begin = near_start > 0.0 ? near_start : near_plane / max(entry, 1e-30);
#ifdef MESH // entries are the mesh's triangles; an eye within the fluid sees the fluid at once
    if (near_start > 0.0 && field_at(ray_at(ray, near_start)) < surface_level)
        ray.begin = near_plane / max(entry, 1e-30);
#endif
    ray.end = min(near_plane / max(leave, 1e-30), solid_end());
    cut_to_walls(ray);
    return ray;
}

// A safe step from a position with field f that does not pass `level`, m. The field of a fluid with a plane end rises first as
// the fourth power of the distance into the kernel's reach. Half of that distance is safe in hollows and between drops too. In
// empty space steps are thus half the kernel's radius: reading a map of empty space on the way would cost more than it saves.
float step_from(float f, float level)
{
    return max(step_length, far_step * (1.0 - sqrt(sqrt(f / level))));
}

// The field's slope per cell, in eye space: from four values at the corners of a tetrahedron.
vec3 slope_at(vec3 at)
{
    const vec2 k = vec2(1.0, -1.0);
    const float reach = 0.6; // cells
    vec3 cell = reach / volume_cells;
    vec3 slope = k.xyy * field_at(at + k.xyy * cell) + k.yyx * field_at(at + k.yyx * cell) +
                 k.yxy * field_at(at + k.yxy * cell) + k.xxx * field_at(at + k.xxx * cell);
    return mat3(box_to_eye) * slope / (4.0 * reach);
}
