// pbf: positions by the multipliers to begin with: first_body in sim/methods/pbf/pbf_passes.c.
#define FIRST_MOVE
#include "sim/pbf/move.comp"
