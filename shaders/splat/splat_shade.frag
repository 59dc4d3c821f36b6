// Pass 3, deferred shading of the blended surface. After: Adams et al. 2006, section 3.3. SHADING 0 phong, 1 water, 2 jelly; SHOW
// 1 depth, 2 normals, 3 weight, 4 thickness show earlier stages instead.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "shaders/splat/splat_bindings.h"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif
#include "common/environment.glsl"
#include "common/behind.glsl"
#include "common/surface.glsl"
#include "common/clear.glsl"
#ifdef PANES
#include "common/within_box.glsl"
#include "common/water_line.glsl"
#endif

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(binding = COLOR_SUM_UNIT) uniform sampler2D color_map;
layout(binding = NORMAL_SUM_UNIT) uniform sampler2D normal_map;
layout(binding = WEIGHT_SUM_UNIT) uniform sampler2D weight_map;
layout(binding = THICKNESS_UNIT) uniform sampler2D thickness_map;  // m, may be coarser
#ifdef PANES
layout(binding = FILLED_UNIT) uniform sampler2D filled_map;        // likewise for a full box
#endif
layout(location = NEAREST_DEPTH_AT) uniform float nearest_depth;   // of a particle, m
layout(location = FARTHEST_DEPTH_AT) uniform float farthest_depth; // m
#ifdef SETTLED // splat_settle.frag has skipped pixels without fluid, and the depth test follows
layout(early_fragment_tests) in;
#endif
layout(location = 0) out vec4 color;
#ifdef MIXING
#include "splat/splat_cover.glsl"
#endif

float thickness_here()
{
    return textureLod(thickness_map, gl_FragCoord.xy * pixel_size, 0.0).x;
}

#ifdef PANES
const float longest = 4.0; // times the straight chord: at a rim, the remaining chord is blurred

float round_there = 1.0;   // 0 if the ray enters through a pane, which is flat

// 1 if the straight ray leaves the fluid into air inside the box, 0 if through a wall; smooth between.
float leaves_inside(vec3 end)
{
    vec3 at = (end - box_to_eye[3].xyz) * mat3(box_to_eye), far = vec3(0.5, 0.5, 0.5) * box_size - abs(at - vec3(0.0, 0.5 * box_size.y, 0.0));
    float least = min(min(far.x, far.y), far.z);
#ifdef SOLIDS // objects in the fluid are seen through one refraction
    least = min(least, near_plane / max(texelFetch(behind_depth, ivec2(gl_FragCoord.xy), 0).x, 1e-30) + end.z);
#endif
    return smoothstep(0.75, 2.5, least / particle_spacing);
}

float full_share = 0.0; // fluid fraction of the straight ray from the surface to the wall

// A refracted ray through a tank full of fluid, reflected by the sides.
struct Tank {
    vec3 end, way;     // exit point and direction, in the eye's frame
    float first, size; // m to the first wall; total length
};

Tank tank_of(vec3 place, vec3 inner)
{
    vec3 middle = vec3(0.0, 0.5 * box_size.y, 0.0), at = (place - box_to_eye[3].xyz) * mat3(box_to_eye) - middle, to = inner * mat3(box_to_eye);
    vec3 sides = vec3(notEqual(walled & uvec3(1u, 0u, 4u), uvec3(0u)));
    float slanted = mirrored_cosine();
    Tank tank = Tank(place, inner, 0.0, 0.0);
    for (int i = 0; i < 4; i++) {
        vec3 ends = (mix(vec3(-0.5), vec3(0.5), greaterThanEqual(to, vec3(0.0))) * box_size - at) / to;
        float t = max(min(min(ends.x, ends.y), ends.z), 0.0);
        vec3 side = sides * vec3(lessThanEqual(ends, vec3(t)));
        float cosine = abs(dot(to, side));
        tank.size += t, at += t * to;
        tank.first = i == 0 ? t : tank.first;
        if (cosine <= 0.0 || cosine > slanted || to.y > 0.0)
            break;
        to -= 2.0 * to * side;
    }
    tank.end = (box_to_eye * vec4(at + middle, 1.0)).xyz, tank.way = mat3(box_to_eye) * to;
    return tank;
}

// Light through the fluid, refracted again at the exit: as by a ball, which the ray leaves at the angle of entry. This creates
// the rim of a small body: the rim shows objects beside instead of behind, and the refracted ray is longer than the straight
// chord, which ends there. Software drivers only skip loops.
vec3 through(inout Surface s)
{
    vec3 inner = refract(s.view, s.normal, 1.0 / refraction_index);
    float inside = round_there * leaves_inside(s.place + s.thickness * s.view), longer = dot(inner, s.normal) / min(dot(s.view, s.normal), -1.0 / longest);
    s.thickness *= mix(1.0, clamp(longer, 1.0, longest), inside);
    vec3 end = s.place + s.thickness * inner;
    Tank tank = tank_of(s.place, inner);
    float filled = (walled & 5u) == 5u ? (1.0 - inside) * smoothstep(0.7, 0.95, full_share) : 0.0, mirrored = tank.size > tank.first ? filled : 0.0;
#ifdef SOLIDS
    float solid = met_on(s.place, tank.first * inner);
    tank.size = solid < 1.0 ? solid * tank.first : tank.size;
    tank.end = solid < 1.0 ? s.place + tank.size * inner : tank.end;
    mirrored = solid < 1.0 ? 0.0 : stands_before(tank.end) ? filled : mirrored; // a solid in front of the exit is not visible there
#endif
    s.thickness = mix(s.thickness, tank.size, filled);
    end = mix(end, tank.end, filled - mirrored);
    for (int i = 0, rounds = inside > 0.0 ? 1 : 0; i < rounds; i++) {
        vec3 outward = s.normal - 2.0 * dot(inner, s.normal) * inner, outer = refract(inner, -outward, refraction_index);
        outer = normalize(mix(inner, dot(outer, outer) > 0.0 ? outer : inner, inside));
        end += inside * way_in_box(end, outer) * outer;
    }
    vec3 seen = behind_at(end, near_plane / -s.place.z, gl_FragCoord.xy);
    seen = mix(seen, environment(tank.end, tank.way), mirrored);
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation));
}
#elif SHADING > 0
vec3 through(inout Surface s) { return transmitted(s); }
#endif

#if SHADING == 0
vec3 shaded(Surface s)
{
    return mix(s.albedo, phong(s), shading);
}
#elif SHADING == 1
vec3 shaded(Surface s)
{
    vec3 inside = through(s);
    return mix(inside, with_surface(s, inside + scattered(s)), shading);
}
#else
// The paper's "Phong shading together with refraction and reflection": cloudier with more thickness.
vec3 shaded(Surface s)
{
    float clear = 0.8 * exp2(-2.0 * s.thickness / attenuation);
    vec3 inside = mix(mix(s.albedo, phong(s), shading), through(s), clear);
    return mix(inside, with_surface(s, inside), shading);
}
#endif

#ifdef PANES
#ifdef SOLIDS
// 1 if the ray of a coarse texel, as in thickness.frag, ends as far away; else next to nothing.
float as_far(vec2 texel, vec2 size, float end, float leave)
{
    ivec2 pixel = clamp(ivec2(texel / size * picture_size), ivec2(0), ivec2(picture_size) - 1);
    float there = near_plane / max(texelFetch(behind_depth, pixel, 0).x, 1e-30);
    return abs(min(there, leave) - end) < 2.0 * particle_spacing ? 1.0 : 1e-3;
}

// Means of own and full thickness of the four coarse texels around, for a ray that ends at `end`. Texels whose ray ends elsewhere, at
// or beside a solid, count next to nothing. After: Kopf, Cohen, Lischinski and Uyttendaele, Joint bilateral upsampling, 2007.
vec2 thickness_beside_solids(float end, float leave)
{
    vec2 size = vec2(textureSize(thickness_map, 0)), texel = gl_FragCoord.xy * pixel_size * size - 0.5, corner = floor(texel), part = texel - corner;
    vec4 own = textureGather(thickness_map, (corner + 1.0) / size), full = textureGather(filled_map, (corner + 1.0) / size);
    vec4 weight = vec4(1.0 - part.x, part.x, part.x, 1.0 - part.x) * vec4(part.y, part.y, 1.0 - part.y, 1.0 - part.y);
    weight *= vec4(as_far(corner + vec2(0.5, 1.5), size, end, leave), as_far(corner + vec2(1.5, 1.5), size, end, leave),
                   as_far(corner + vec2(1.5, 0.5), size, end, leave), as_far(corner + vec2(0.5, 0.5), size, end, leave));
    return vec2(dot(weight, own), dot(weight, full));
}
#endif

// The thickness of the fluid on the straight ray. The field is blurred beyond the walls, and too small beside walls. Hence the
// field is divided by a full box's field: gives the fluid's fraction of the ray between the walls, as sharp as the walls.
float thickness_in_box(vec3 ray, float depth)
{
    Within box = within_box_of(ray, bvec3(true));
    float end = box.leave, enter = max(box.enter, near_plane);
#ifdef SOLIDS
    end = min(end, near_plane / max(texelFetch(behind_depth, ivec2(gl_FragCoord.xy), 0).x, 1e-30));
    vec2 around = thickness_beside_solids(end, box.leave);
#else
    vec2 around = vec2(thickness_here(), textureLod(filled_map, gl_FragCoord.xy * pixel_size, 0.0).x);
#endif
    if (end <= enter)
        return thickness_here();
    float way = min((end - enter) * min(around.x / max(around.y, 1e-30), 1.0), max(end - depth, 0.0));
    full_share = way / max(end - depth, 1e-30);
    return way * length(ray);
}
#endif

#ifdef PANES
// For a pixel of a pane: nonzero at the pane's upper end on the screen, without specks. The fluid's lower ends are at the box's.
float line_share(ivec2 pixel)
{
    ivec2 up = ivec2(0, int(water_line_width() + 0.5)), last = textureSize(nearest_map, 0) - 1;
    bool ends = texelFetch(nearest_map, min(pixel + up, last), 0).x >= 0.0 &&
                texelFetch(nearest_map, min(pixel + 5 * up, last), 0).x >= 0.0;
    return ends ? 0.7 : 0.0;
}
#endif

Surface surface_at(vec3 ray, float depth, vec3 normal, vec3 albedo)
{
    Surface s = Surface(depth * ray, normalize(ray), normal, albedo, 0.0, 0.0, 0.0, 1.0);
    s.lit = s.key = fluid_light(s.place, gl_FragCoord.xy);
#ifdef SOLIDS
    s.key *= solid_light(s.place);
#endif
#if SHADING > 0
    s.normal = facing(normal, s.view);
    s.thickness = thickness_here();
#ifdef PANES
    s.thickness = thickness_in_box(ray, depth);
    s.bare = glass == 2u && round_there == 0.0 ? 0.0 : 1.0;
#endif
#endif
    return s;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(nearest_map, pixel, 0).x, weight = texelFetch(weight_map, pixel, 0).x;
    vec3 normal = texelFetch(normal_map, pixel, 0).xyz;
    float length2 = dot(normal, normal);
#ifndef SETTLED
    if (is_nan(length2) || depth >= 1e29 || weight <= 0.0 || length2 <= 0.0) // no fluid, or only the rim of a lone sphere
        discard;
    gl_FragDepth = near_plane / abs(depth);
#endif
    normal *= inversesqrt(length2);
#ifdef PANES
    bool pane = depth < 0.0;
    normal = pane ? within_box(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy))).normal : normal;
    round_there = pane ? 0.0 : 1.0;
    depth = abs(depth);
#endif
#if SHOW == 1
    color = vec4(vec3(1.0 - 0.9 * clamp((depth - nearest_depth) / (farthest_depth - nearest_depth), 0.0, 1.0)), 1.0);
#elif SHOW == 2
    color = vec4(0.5 + 0.5 * normal, 1.0);
#elif SHOW == 3
    color = vec4(vec3(weight / (1.0 + weight)), 1.0);
#elif SHOW == 4
    color = vec4(vec3(thickness_here() / max(box_size.x, max(box_size.y, box_size.z))), 1.0);
#else
    vec3 albedo = texelFetch(color_map, pixel, 0).rgb / weight;
    float cover = 1.0;
#ifdef MIXING
    cover = cover_at(pixel, depth, albedo, normal);
#endif
    Surface s = surface_at(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)), depth, normal, albedo);
    color = vec4(shaded(s), cover);
#ifdef PANES
    int rounds = glass == 2u && pane ? 1 : 0; // software drivers only skip loops
    for (int i = 0; i < rounds; i++)
        color.rgb = with_water_line(color.rgb, line_share(pixel));
#endif
#endif
}
