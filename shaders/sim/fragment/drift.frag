// Free flight between two poses of the box (sim/box/box.h), then the last guard of walls.
#include "sim/fragment/own.glsl"
uniform usampler2D held; // number of times the guard held each particle
uniform vec3 rotation[3], omega0, omega1, shift, velocity_change;
uniform float dt;
uniform int still; // 1: the box is at rest
layout(location = 0) out vec4 new_position;
layout(location = 1) out vec4 new_velocity;
layout(location = 2) out uint new_held;

bool guard(inout vec3 x, inout vec3 v)
{
    bool stopped = false;
    int axes = dimensions == 2 ? 2 : 3;
    for (int a = 0; a < axes; a++) {
        float low = a == 1 ? 0.0 : -half_size[a], high = a == 1 ? 2.0 * half_size.y : half_size[a];
        if (x[a] < low) {
            x[a] = low;
            v[a] = max(v[a], 0.0);
            stopped = true;
        } else if (x[a] > high) {
            x[a] = high;
            v[a] = min(v[a], 0.0);
            stopped = true;
        }
    }
    return stopped;
}

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    vec4 own = of_particle(position, i), moving = of_particle(velocity, i);
    vec3 x = own.xyz, v = moving.xyz;
    if (still == 1) {
        x += v * dt;
    } else {
        vec3 w = v + cross(omega0, x), y = x + (w * dt - shift);
        x = y + vec3(dot(rotation[0], y), dot(rotation[1], y), dot(rotation[2], y));
        v = w + vec3(dot(rotation[0], w), dot(rotation[1], w), dot(rotation[2], w)) - velocity_change -
            cross(omega1, x);
    }
    new_held = texelFetch(held, texel_of(i), 0).x + (guard(x, v) ? 1u : 0u);
    new_position = vec4(x, own.w);
    new_velocity = vec4(v, moving.w);
}
