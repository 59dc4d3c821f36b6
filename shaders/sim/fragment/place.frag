// Positions for the views: x y z, volume, m3.
#include "sim/fragment/own.glsl"
uniform sampler2D fields;
layout(location = 0) out vec4 place;

void main()
{
    int i = own_particle();
    if (i >= particle_count)
        discard;
    place = vec4(of_particle(position, i).xyz, unit_volume * of_particle(fields, i).x);
}
