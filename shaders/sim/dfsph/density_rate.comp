// dfsph: rate.glsl, of the solver of density.
#include "sim/dfsph/rate.glsl"
