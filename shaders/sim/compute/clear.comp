// Zeroes numbers of a buffer. As a pass, since glClearNamedBufferData is slow on a data-centre GPU, and in NVIDIA's driver
// (580) a clear overtakes a later glNamedBufferSubData. Four numbers an invocation.
#include "sim/constants.glsl"
layout(std430, binding = CLEARED_BUFFER) writeonly buffer Cleared { uint cleared[]; };
layout(location = WORDS_AT) uniform uvec3 words; // number, first

void main()
{
    uint i = invocation(), k = i / 64u * 256u + i % 64u, end = min(k + 256u, words.x);
    for (; k < end; k += 64u)
        cleared[words.y + k] = 0u;
}
