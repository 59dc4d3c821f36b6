// Whether a particle that is not opaque covers a pixel (render/particles/particle_curves.h); `veil`: its opacity, and where its
// screen-door begins. After: Enderton, Sintorn, Shirley, Luebke, Stochastic transparency, 2010, with noise that is even over the
// pixels of one particle.
#include "common/noise.glsl"

bool veil_covers(vec2 veil, vec2 pixel)
{
    return fract(pixel_noise(pixel) + veil.y) < veil.x;
}
