#include "sim/fragment/particles.glsl"

// The particle of the texel; the last row may continue past the last particle.
int own_particle() { return (int(gl_FragCoord.y) << particle_bits) + int(gl_FragCoord.x); }
