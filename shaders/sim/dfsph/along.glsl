// Along a solid: along_solid and share_of in sim/methods/dfsph/dfsph_passes.c.
#include "sim/scratch.glsl"

vec3 along_solid(uint i, vec3 v)
{
    vec3 s = column_of(SCRATCH_solid_slope, i);
    float square = dot(s, s);
    return v - (square > 0.0 ? dot(s, v) / square : 0.0) * s;
}

float share_of(uint i) { return min(scratch[SCRATCH_solid_share + i], SHARE_MOST); }
