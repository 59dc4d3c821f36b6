// Shared by the passes of dfsph's solvers. For velocities a boundary particle has the particle's k and the solid's velocity,
// mirrored; for positions a boundary particle has no k: sim/methods/dfsph/dfsph.h.
#include "shaders/sim/dfsph/dfsph_block.h"
#ifdef DIVERGENCE
#define BOUNDARY_TIMES 2.0
#define MOMENTUM DIVERGENCE_MOMENTUM
#define BEGINS DIVERGENCE_BEGINS
#else
#define MOMENTUM DENSITY_MOMENTUM
#define BEGINS 1.0
#endif
layout(location = PASS_DT_AT) uniform float dt;
