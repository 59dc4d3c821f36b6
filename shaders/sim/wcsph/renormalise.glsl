#include "common/nan.glsl"

// m^-1 b of the symmetric m; 0 where neighbours hardly span the space.
vec3 renormalise(vec3 diagonal, vec3 mixed, vec3 b)
{
    float xx = diagonal.x, yy = diagonal.y, zz = diagonal.z, xy = mixed.x, yz = mixed.y, zx = mixed.z;
    vec3 c = vec3(yy * zz - yz * yz, xx * zz - zx * zx, xx * yy - xy * xy);
    float cxy = yz * zx - xy * zz, cyz = xy * zx - yz * xx, czx = xy * yz - zx * yy;
    float det = xx * c.x + xy * cxy + zx * czx, mean = (xx + yy + zz) / 3.0;
    if (is_nan(det) || det <= 0.25 * (mean * mean * mean))
        return vec3(0);
    return vec3(c.x * b.x + cxy * b.y + czx * b.z, cxy * b.x + c.y * b.y + cyz * b.z,
                czx * b.x + cyz * b.y + c.z * b.z) / det;
}
