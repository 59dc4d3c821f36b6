// A particle becomes a point in the texel of its cell, with its id as depth: after Harada, Koshizuka and Kawaguchi
// 2007. Integers up to 2^24 times 2^-24 are exact in the depth buffer.
#include "sim/fragment/particles.glsl"
#include "sim/fragment/cells.glsl"
layout(location = 0) in uint listed; // index + 1: 0 is an empty place
flat out uint number;

void main()
{
    vec4 own = of_particle(position, int(listed) - 1);
    ivec2 texel = bucket_of(cell_index(cell_of(own.xyz)));
    vec2 at = (2.0 * vec2(texel) + 1.0) / vec2(1 << bucket_bits, bucket_height) - 1.0;
    number = listed;
    gl_Position = vec4(at, (own.w + 1.0) / 16777216.0, 1.0);
}
