// A particle becomes a point in the texel of its id; the point's value is the particle's own texel.
#include "sim/fragment/particles.glsl"
flat out uint number;

void main()
{
    ivec2 texel = texel_of(int(of_particle(position, gl_VertexID).w));
    number = uint(gl_VertexID) + 1u;
    gl_Position = vec4((2.0 * vec2(texel) + 1.0) / vec2(textureSize(position, 0)) - 1.0, 0.0, 1.0);
}
