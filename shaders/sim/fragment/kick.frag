// v += (acceleration + gravity) dt.
#include "sim/fragment/own.glsl"
uniform sampler2D acceleration;
uniform vec3 gravity;
uniform float dt;
layout(location = 0) out vec4 new_velocity;

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    vec3 a = of_particle(acceleration, i).xyz + gravity;
    vec4 own = of_particle(velocity, i);
    new_velocity = vec4(own.xyz + a * dt, own.w);
}
