// dfsph: rate.glsl, of the solver of divergence.
#define DIVERGENCE
#include "sim/dfsph/rate.glsl"
