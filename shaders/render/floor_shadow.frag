// The light that fluid and solids let through to the floor: the covered fraction of a disc in the shadow map; the disc's size
// represents the light's.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "shaders/shared/shadow_maps.h"

#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(location = CLEAR_AT) uniform float clear; // fraction of light that the fluid lets through
layout(location = 0) out float light_left;

const int taps = 24;

void main()
{
    vec2 xz = floor_map_corner + gl_FragCoord.xy / float(FLOOR_MAP_TEXELS) * floor_map_size;
    vec2 at = (world_to_light * vec4(xz.x, floor_height, xz.y, 1.0)).xy;
    float covered = 0.0;
    for (int i = 0; i < taps; i++) { // sunflower pattern: even over the disc
        float angle = 2.39996 * float(i), reach = sqrt((float(i) + 0.5) / float(taps)) * light_radius;
        vec2 tap = at + reach * vec2(cos(angle), sin(angle));
        float share = (1.0 - clear) * min(1.0, 1e6 * textureLod(shadow_map, tap, 0.0).x);
#ifdef SOLIDS
        share = max(share, 1.0 - textureLod(solid_map, vec3(tap, 0.0), 0.0));
#endif
        covered += share;
    }
    light_left = 1.0 - covered / float(taps);
}
