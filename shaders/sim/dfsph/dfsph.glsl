// Shared by the passes of dfsph's solvers. A boundary particle has the particle's k and the solid's velocity, mirrored:
// sim/methods/dfsph/dfsph_private.h.
#include "shaders/sim/dfsph/dfsph_block.h"
#define BOUNDARY_TIMES 2.0
#ifdef DIVERGENCE
#define MOMENTUM DIVERGENCE_MOMENTUM
#define BEGINS DIVERGENCE_BEGINS
#else
#define MOMENTUM DENSITY_MOMENTUM
#define BEGINS 1.0
#endif
layout(location = PASS_DT_AT) uniform float dt;
