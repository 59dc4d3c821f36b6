// Particles as the light sees them: triangles of the disc's area at the depth of the centre, which the blur and the
// bilinear texel round off. No discard and no depth written by the fragment, so that the driver's fast path does it.
#include "common/frame.glsl"
#include "common/particles.glsl"

const vec2 corners[3] = vec2[](vec2(-0.866, -0.5), vec2(0.866, -0.5), vec2(0.0, 1.0));

void main()
{
    uint index = uint(gl_VertexID) / 3u;
    vec3 at = (box_to_light * vec4(particle_position(index), 1.0)).xyz;
    float reach = 1.555 * 2.0 * particle.x / lens.w; // equal area; half the map is 1
    gl_Position = vec4(2.0 * at.xy - 1.0 + corners[uint(gl_VertexID) - 3u * index] * reach, at.z, 1.0);
}
