// Lists the foaming particles in order, with their strength, and writes the drawing command of the bubbles: for
// render/water/water.c. One workgroup does all the work.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "water/foam.glsl"

layout(local_size_x = 256) in;
layout(location = FOAM_COUNT_AT) uniform uint count;
layout(location = FOAM_SPEEDS_AT) uniform vec4 speeds; // trapped air and speed, m/s: foam starts and is complete
layout(location = FOAM_VELOCITY_STRIDE_AT) uniform uint velocity_stride;
layout(location = FOAM_MOST_AT) uniform uint most; // limit of bubbles, but at least one per particle
layout(std430, binding = FOAM_VELOCITIES_STORAGE) readonly buffer Velocities { float velocity_words[]; };
layout(std430, binding = FOAM_LIST_STORAGE) writeonly buffer List { uvec2 listed[]; };
layout(std430, binding = FOAM_COMMAND_STORAGE) writeonly buffer Commands { uint command[5]; };
shared uint part[256];

// 0 for NaN.
float foam_of(uint i)
{
    uint at = i * velocity_stride;
    vec3 velocity = vec3(velocity_words[at], velocity_words[at + 1u], velocity_words[at + 2u]);
    float air = scalar_words[i * scalar_stride], speed2 = dot(velocity, velocity);
    if (is_nan(vec4(particle_position(i), air)) || is_nan(speed2))
        return 0.0;
    return smoothstep(speeds.x, speeds.y, air) * smoothstep(speeds.z, speeds.w, sqrt(min(speed2, 1e30)));
}

void main()
{
    uint lane = gl_LocalInvocationID.x, each = (count + 255u) / 256u, sum = 0u;
    uint first = min(lane * each, count), end = min(first + each, count);
    for (uint i = first; i < end; i++)
        sum += uint(foam_of(i) > FOAM_LEAST);
    part[lane] = sum;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) { // Hillis and Steele 1986
        uint before = lane >= reach ? part[lane - reach] : 0u;
        barrier();
        part[lane] += before;
        barrier();
    }
    uint to = part[lane] - sum;
    for (uint i = first; i < end; i++) {
        float foam = foam_of(i);
        if (foam > FOAM_LEAST)
            listed[to++] = uvec2(i, floatBitsToUint(foam));
    }
    uint each_has = clamp(most / max(part[255], 1u), 1u, FOAM_BUBBLES);
    if (lane < 5u)
        command[lane] = lane == 0u ? each_has * part[255] : lane == 1u ? 1u : lane == 4u ? each_has : 0u;
}
