// level_sph of sim/points/points.h: the sum of V W over the neighbours.
#include "surface/sph_sum.glsl"

Sample field_at(vec3 p)
{
    Second f, unused;
    sum_about(p, 3u, f, unused);
    return Sample(f.value, f.slope, bend_of(f.slope, f.straight, f.across));
}
