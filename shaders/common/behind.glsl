// What stands behind the fluid, bent by it; render/frame/behind.c binds it. Wants common/frame.glsl and, with FLOOR_SHADOW,
// common/environment.glsl.
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

// What is seen in a direction whose line leaves the box at a place (eye's frame), with those edges of the box that are before it; where
// the copy holds nothing else (behind_take_edges).
vec3 with_edges(vec3 seen, vec3 place)
{
    vec2 at = 0.5 + 0.5 * ndc_of_eye(place);
    if (is_nan(at.xyxy) || place.z >= -near_plane || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        return seen;
    vec4 edges = textureLod(behind_color, at, 0.0);
    return seen * (1.0 - edges.a) + edges.rgb;
}

// What the eye sees of the scene without the fluid in the direction of a place, in the eye's frame. Beside the picture it is sky
// and floor; a solid before the surface (at the reversed depth `surface`) is not behind it: what is straight behind `straight`
// then.
vec3 behind_at(vec3 place, float surface, vec2 straight)
{
    vec2 at = 0.5 + 0.5 * ndc_of_eye(place);
    if (is_nan(at.xyxy) || place.z >= -near_plane || any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        return environment(vec3(0.0), place);
#ifdef SOLIDS
    vec4 around = textureGather(behind_depth, at); // of what the colour is mixed
    if (max(max(around.x, around.y), max(around.z, around.w)) > surface)
        at = straight * pixel_size;
#endif
    return textureLod(behind_color, at, 0.0).rgb;
}

#ifdef SOLIDS
// How far behind what the copy shows a place is, m below the eye.
float behind_shown(vec3 place)
{
    vec2 at = clamp(0.5 + 0.5 * ndc_of_eye(place), 0.0, 1.0);
    return -place.z - near_plane / max(textureLod(behind_depth, at, 0.0).x, 1e-30);
}

// Whether the copy shows a solid before a place, or beside one that it shows: of what the colour is mixed.
bool stands_before(vec3 place)
{
    vec4 around = textureGather(behind_depth, clamp(0.5 + 0.5 * ndc_of_eye(place), 0.0, 1.0));
    return max(max(around.x, around.y), max(around.z, around.w)) > near_plane / max(-place.z, near_plane);
}

// Where a way from the surface of a fluid first meets a solid that the copy shows, as a share of the way; 2: nowhere. What it comes to lie
// behind at an outline, as of the part of a duck above the water, is far before it.
float met_on(vec3 from, vec3 way)
{
    const int count = 8, halvings = 5;
    float met = 2.0, behind = 0.0;
    for (int i = 1; i <= count && met > 1.0; i++) {
        float share = float(i) / float(count);
        behind = behind_shown(from + share * way);
        met = behind > 0.0 ? share : met;
    }
    for (int i = 0, rounds = met > 1.0 ? 0 : halvings; i < rounds; i++) { // the picture is looked up where it shows the solid
        float share = met - 0.5 / float(count << i), before = behind_shown(from + share * way);
        met = before > 0.0 ? share : met, behind = before > 0.0 ? before : behind;
    }
    return behind < 0.5 * particle_spacing + length(way) / float(count) ? met : 2.0;
}
#endif
