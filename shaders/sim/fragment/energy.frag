// Sums for the watch over energy (sim/state.h): a vector of four a pass, as in compute/energy.comp. First
// level of the reduction; gauge.frag adds further.
#include "sim/fragment/particles.glsl"
#include "sim/gauge.glsl"
layout(location = 0) out uvec4 found;
layout(location = 1) out uint greatest;
uniform sampler2D fields;
uniform float c2, which;

vec4 sum_of(ivec2 at)
{
    vec4 x = texelFetch(position, at, 0), v = texelFetch(velocity, at, 0);
    float compression = stiffness_scale * (1.0 / (texelFetch(fields, at, 0).x * rest_number_density) - 1.0),
          m = fluid_of(v.w).mass;
    vec4 gauge = gauge_of(m, compression, x.xyz, v.xyz, vec3(0.0), c2);
    if (which < 0.5)
        return vec4(gauge.y, gauge.w, m, 0.0);
    vec3 of = which < 1.5 ? v.xyz : which < 2.5 ? x.xyz : which < 3.5 ? x.xyz * x.xyz : which < 4.5 ? x.xyz * x.yzx : cross(x.xyz, v.xyz);
    return vec4(m * of, 0.0);
}

void main()
{
    ivec2 first = 8 * ivec2(gl_FragCoord.xy), end = min(first + 8, textureSize(position, 0));
    vec4 sum = vec4(0.0);
    for (int y = first.y; y < end.y; y++)
        for (int x = first.x; x < end.x; x++)
            if ((y << particle_bits) + x < particle_count)
                sum += sum_of(ivec2(x, y));
    found = floatBitsToUint(sum);
    greatest = 0u;
}
