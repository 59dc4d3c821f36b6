// Addition to common/particles.glsl: ids, as the numbers of the scalar; without ids, the particles' indices.
#include "shaders/shared/bindings.h"
layout(std430, binding = IDS_STORAGE) readonly buffer Ids { float id_words[]; };
layout(location = ID_STRIDE_AT) uniform uint id_stride; // 0: no ids

// A fixed number in 0..1 per id, different for neighbouring ids. After: Wellons, Hash function prospector (lowbias32), 2018.
float id_share(uint index)
{
    uint x = id_stride > 0u ? uint(id_words[index * id_stride]) : index;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return float((x ^ x >> 16) >> 8) / 16777216.0;
}
