// Packs a unit vector as surface_normal_pack of sim/points/points.h.
uint packed_normal(vec3 slope)
{
    float sum = abs(slope.x) + abs(slope.y) + abs(slope.z);
    if (sum == 0.0 || is_nan(sum))
        return 0u;
    vec2 n = slope.xy / sum;
    if (slope.z < 0.0)
        n = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return packSnorm2x16(n);
}
