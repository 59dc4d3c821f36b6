// Of common/particles.glsl: ids, as the numbers that the scalar has; where there are none, particles' places.
#include "shaders/shared/bindings.h"
layout(std430, binding = IDS_STORAGE) readonly buffer Ids { float id_words[]; };
layout(location = ID_STRIDE_AT) uniform uint id_stride; // 0: there are none

// A number in 0..1 that an id keeps, not like that of its neighbours. After: Wellons, Hash function prospector (lowbias32), 2018.
float id_share(uint index)
{
    uint x = id_stride > 0u ? uint(id_words[index * id_stride]) : index;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return float((x ^ x >> 16) >> 8) / 16777216.0;
}
