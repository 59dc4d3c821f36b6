// level_sph_scalar of sim/points/points.h: s = A / F; grad s = (grad A - s grad F) / F; H s = (H A - s H F - grad s grad F -
// grad F grad s) / F.
#include "surface/sph_sum.glsl"

Sample field_at(vec3 p)
{
    Second f, a;
    sum_about(p, 4u, f, a);
    if (f.value <= 0.0)
        return Sample(0.0, vec3(0.0), 0.0);
    float s = a.value / f.value;
    vec3 g = (a.slope - s * f.slope) / f.value;
    vec3 straight = (a.straight - s * f.straight - 2.0 * g * f.slope) / f.value;
    vec3 across = (a.across - s * f.across - g * f.slope.yzx - g.yzx * f.slope) / f.value;
    return Sample(s, g, bend_of(g, straight, across));
}
