// dfsph: push.glsl, of the solver of divergence.
#define DIVERGENCE
#include "sim/dfsph/push.glsl"
