// What the passes of dfsph's solvers share. A boundary particle has the particle's k and its solid's velocity, mirrored, where
// velocities are at stake, and no k where places are: sim/dfsph/passes.h.
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
