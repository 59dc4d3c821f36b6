// The light on the floor: light after shadows, times the light focused by the fluid's surface. Near the map's sides points from
// outside are missing: two rows of texels, without fluid, keep 1.
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
layout(binding = FLOOR_LIGHT_UNIT) uniform sampler2D shadow_left;
layout(binding = CAUSTIC_UNIT) uniform sampler2D caustic_map;
layout(location = 0) out float light;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy), from_side = min(texel, CAUSTIC_TEXELS - 1 - texel);
    float gathered = min(from_side.x, from_side.y) < 2 ? 1.0 : texelFetch(caustic_map, texel, 0).x;
    light = textureLod(shadow_left, gl_FragCoord.xy / float(CAUSTIC_TEXELS), 0.0).x * gathered;
}
