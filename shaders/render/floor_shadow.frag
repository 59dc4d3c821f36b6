// The light that fluid and solids let through to the floor: the covered fraction of a disc in the shadow map; the disc's size
// represents the light's.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "shaders/shared/shadow_maps.h"

#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(location = 0) out float light_left;

const int taps = 8;

// Each texel of a block of 4 x 4 takes 8 of 128 places, even over the disc; floor_smooth.frag takes the mean of a
// block. Drops as small as the distance of a single texel's places would make combs of shadows.
void main()
{
    uvec2 texel = uvec2(gl_FragCoord.xy), in_block = texel & 3u;
    vec2 xz = floor_map_corner + (vec2(texel) + 1.0) / float(FLOOR_MAP_TEXELS) * floor_map_size; // half a texel on, to a block's middle
    vec2 at = (world_to_light * vec4(xz.x, floor_height, xz.y, 1.0)).xy;
    float block = 4.0 * length(floor_map_size) / (float(FLOOR_MAP_TEXELS) * light_depth); // diagonal; the mean over a block widens rims
    float wide = sqrt(max(light_radius * light_radius - block * block / 6.0, 0.25 * light_radius * light_radius));
    float covered = 0.0, own = float(in_block.x * 4u + in_block.y * 5u & 15u), turn = 2.3999632 * own;
    vec2 way = vec2(cos(turn), sin(turn));
    for (int i = 0; i < taps; i++) { // sunflower pattern
        vec2 tap = at + sqrt((16.0 * float(i) + own + 0.5) / (16.0 * float(taps))) * wide * way;
        float share = (1.0 - fluid_clear) * min(1.0, 1e6 * textureLod(shadow_map, tap, 0.0).x);
#ifdef SOLIDS
        share = max(share, 1.0 - textureLod(solid_map, vec3(tap, 0.0), 0.0));
#endif
        covered += share;
        way = mat2(0.7646490, 0.6444470, -0.6444470, 0.7646490) * way; // 16 golden angles
    }
    light_left = 1.0 - covered / float(taps);
}
