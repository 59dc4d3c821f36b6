// True if a translucent particle covers a pixel (render/particles/particles.h). `veil`: opacity, and start of the
// screen-door. After: Enderton, Sintorn, Shirley, Luebke, Stochastic transparency, 2010, with noise that is even over a
// particle's pixels.
#include "common/noise.glsl"

bool veil_covers(vec2 veil, vec2 pixel)
{
    return fract(pixel_noise(pixel) + veil.y) < veil.x;
}
