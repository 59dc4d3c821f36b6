// dfsph: push.glsl, of the solver of density.
#include "sim/dfsph/push.glsl"
