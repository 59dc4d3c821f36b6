// Lists the particles that are chosen, in their order (render/particles/particles.h, Selection). With MARK: a bit per
// particle, and the number of bits per word of 32. Then, after prefix sums of the numbers, the list. Before the include:
//   bool chosen(uint i);
//   void put(uint to, uint i);        entry `to` of the list
//   void finish(uint total);          once, by one invocation
#include "shaders/shared/bindings.h"
layout(local_size_x = 64) in;
layout(location = SELECT_COUNT_AT) uniform uint select_count;
layout(std430, binding = SELECT_BITS_STORAGE) buffer SelectBits { uint select_bits[]; };
layout(std430, binding = SELECT_STARTS_STORAGE) buffer SelectStarts { uint select_starts[]; }; // and one more: the total

#ifdef MARK
shared uint words[2];

void main()
{
    uint lane = gl_LocalInvocationID.x, word = lane >> 5;
    uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (lane < 2u)
        words[lane] = 0u;
    barrier();
    if (i < select_count && chosen(i))
        atomicOr(words[word], 1u << (lane & 31u));
    barrier();
    if ((lane & 31u) == 0u && i < select_count + 32u) {
        select_bits[i >> 5] = words[word];
        select_starts[i >> 5] = uint(bitCount(words[word]));
    }
}
#else
void main()
{
    uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (i == 0u)
        finish(select_starts[(select_count + 31u) / 32u]);
    if (i >= select_count)
        return;
    uint bits = select_bits[i >> 5], own = 1u << (i & 31u);
    if ((bits & own) != 0u)
        put(select_starts[i >> 5] + uint(bitCount(bits & (own - 1u))), i);
}
#endif
