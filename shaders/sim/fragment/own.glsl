#include "sim/fragment/particles.glsl"

// The texel's own particle; the last row may go on past the last one.
int own_particle() { return (int(gl_FragCoord.y) << particle_bits) + int(gl_FragCoord.x); }
