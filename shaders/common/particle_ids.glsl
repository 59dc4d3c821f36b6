// Addition to common/particles.glsl: ids, as the numbers of the scalar; without ids, the particles' indices.
#include "shaders/shared/bindings.h"
layout(std430, binding = IDS_STORAGE) readonly buffer Ids { float id_words[]; };
layout(location = ID_STRIDE_AT) uniform uint id_stride; // 0: no ids

uint id_of(uint index) { return id_stride > 0u ? uint(id_words[index * id_stride]) : index; }

// Mixed bits of the id. After: Wellons, Hash function prospector (lowbias32), 2018.
uint id_hash(uint index)
{
    uint x = id_of(index);
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

// A fixed number in 0..1 per id, different for neighbouring ids.
float id_share(uint index) { return float(id_hash(index) >> 8) / 16777216.0; }
