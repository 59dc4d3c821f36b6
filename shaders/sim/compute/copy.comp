// Copies numbers from a buffer to another buffer: clear.comp.
#include "sim/constants.glsl"
layout(std430, binding = COPIED_BUFFER) readonly buffer Copied { uint copied[]; };
layout(std430, binding = CLEARED_BUFFER) writeonly buffer Copies { uint copies[]; };
layout(location = WORDS_AT) uniform uvec3 words; // number, first, first of the copies

void main()
{
    uint i = invocation(), k = i / 64u * 256u + i % 64u, end = min(k + 256u, words.x);
    for (; k < end; k += 64u)
        copies[words.z + k] = copied[words.y + k];
}
