// How much light the fluid lets through to each place of the floor: the covered share of a disc in the shadow map, whose
// size stands for that of the light.
#include "common/frame.glsl"
#include "common/light.glsl"

layout(location = 0) uniform float texel; // as a share of the map's side
layout(location = 0) out float light_left;

const int taps = 24;

void main()
{
    vec2 xz = floor_map.xy + gl_FragCoord.xy * texel * floor_map.zw;
    vec2 at = (world_to_light * vec4(xz.x, floor_place.x, xz.y, 1.0)).xy;
    float covered = 0.0;
    for (int i = 0; i < taps; i++) { // a sunflower's seeds: even over the disc
        float angle = 2.39996 * float(i), reach = sqrt((float(i) + 0.5) / float(taps)) * light_to.w;
        covered += min(1.0, 1e6 * textureLod(shadow_map, at + reach * vec2(cos(angle), sin(angle)), 0.0).x);
    }
    light_left = 1.0 - covered / float(taps);
}
