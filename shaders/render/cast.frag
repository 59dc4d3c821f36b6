// The shadow map from the output of ball_shadow.comp.
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
layout(std430, binding = CAST_STORAGE) readonly buffer Lit { uint lit[]; };

void main()
{
    uvec2 texel = uvec2(gl_FragCoord.xy);
    gl_FragDepth = uintBitsToFloat(lit[texel.y * SHADOW_MAP_TEXELS + texel.x]);
}
