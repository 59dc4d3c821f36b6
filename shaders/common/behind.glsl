// The background seen through the fluid, refracted; render/frame/edges.c binds the copy. Needs common/frame.glsl and, with
// FLOOR_SHADOW, common/environment.glsl.
#include "shaders/shared/bindings.h"
#include "common/nan.glsl"
layout(binding = BEHIND_COLOR_UNIT) uniform sampler2D behind_color;
#ifdef SOLIDS
layout(binding = BEHIND_DEPTH_UNIT) uniform sampler2D behind_depth; // reversed
#endif

vec3 environment(vec3 origin, vec3 ray) // both in the eye's frame
{
    return environment_light((eye_to_world * vec4(origin, 1.0)).xyz, mat3(eye_to_world) * ray);
}

// Adds the box's edges to `seen`, the light of a ray that leaves the box at `place` (eye's frame). For a copy that holds only
// edges (behind_take_edges).
vec3 with_edges(vec3 seen, vec3 place)
{
    vec2 at = 0.5 + 0.5 * ndc_of_eye(place);
    if (is_nan(at.xyxy) || place.z >= -near_plane || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        return seen;
    vec4 edges = textureLod(behind_color, at, 0.0);
    return seen * (1.0 - edges.a) + edges.rgb;
}

// The scene without the fluid, seen in the direction of `place` (eye's frame). Outside the picture: sky and floor. A solid in
// front of the surface (reversed depth `surface`) is not behind the fluid: then takes the pixel at `straight`.
vec3 behind_at(vec3 place, float surface, vec2 straight)
{
    vec2 at = 0.5 + 0.5 * ndc_of_eye(place);
    if (is_nan(at.xyxy) || place.z >= -near_plane || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        return environment(vec3(0.0), place);
#ifdef SOLIDS
    vec4 around = textureGather(behind_depth, at); // the four texels of the filtered colour
    if (max(max(around.x, around.y), max(around.z, around.w)) > surface)
        at = straight * pixel_size;
#endif
    return textureLod(behind_color, at, 0.0).rgb;
}

#ifdef SOLIDS
// Distance of a place behind the copied depth, m along the eye's axis.
float behind_shown(vec3 place)
{
    vec2 at = clamp(0.5 + 0.5 * ndc_of_eye(place), 0.0, 1.0);
    return -place.z - near_plane / max(textureLod(behind_depth, at, 0.0).x, 1e-30);
}

// True if the copy shows a solid in front of a place, in any of the four texels of the filtered colour.
bool stands_before(vec3 place)
{
    vec4 around = textureGather(behind_depth, clamp(0.5 + 0.5 * ndc_of_eye(place), 0.0, 1.0));
    return max(max(around.x, around.y), max(around.z, around.w)) > near_plane / max(-place.z, near_plane);
}

// The first point of a path from a fluid's surface on a solid shown in the copy, as a fraction of the path; 2: none. Excludes
// solids far in front that hide the path at an outline, as the part of a duck above the water.
float met_on(vec3 from, vec3 way)
{
    const int count = 8, halvings = 6;
    float met = 2.0, behind = 0.0;
    for (int i = 1; i <= count && met > 1.0; i++) {
        float share = float(i) / float(count);
        behind = behind_shown(from + share * way);
        met = behind > 0.0 ? share : met;
    }
    for (int i = 0, rounds = met > 1.0 ? 0 : halvings; i < rounds; i++) { // bisects to the visible solid
        float share = met - 0.5 / float(count << i), before = behind_shown(from + share * way);
        met = before > 0.0 ? share : met, behind = before > 0.0 ? before : behind;
    }
    return behind < 0.25 * particle_spacing + 4.0 * length(way) / float(count << halvings) ? met : 2.0;
}
#endif
