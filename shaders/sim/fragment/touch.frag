// A finger in the fluid: sim/world.h.
#include "sim/fragment/own.glsl"
#include "sim/finger.glsl"
uniform vec4 finger_at; // w: 1 / radius^2
uniform vec4 finger_velocity;
uniform float finger_kick;
layout(location = 0) out vec4 new_velocity;

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    vec4 own = of_particle(velocity, i);
    vec3 d = of_particle(position, i).xyz - finger_at.xyz;
    new_velocity = vec4(finger_moved(own.xyz, d, finger_at.w, finger_velocity, finger_kick), own.w);
}
