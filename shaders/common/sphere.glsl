// A sphere under perspective: exact bound, hit and depth.
//
// With centre c, radius r, eye at the origin and ray direction d = (x, y, -1), let u = (s d - c) / r for a scale s of
// our choice (s = -c.z makes u.z = 0). Then the ray hits where
//   E = M^2 + (1 - u.u) >= 0,  M = (u.c + r) / sqrt(q),  q = c.c - r^2,
// at the reversed depth near / t = near / s + near r / (s sqrt q) (M + sqrt E).
// u and M are linear on the screen and of the size of 1 on the sphere, so nothing cancels when it is small and far.
#include "common/nan.glsl"
struct Sphere {
    vec3 centre;
    float radius;
    float scale;   // s
    float inverse; // 1 / sqrt(q); 0 if the eye is inside, where no outside is visible, and for NaN
};

Sphere sphere_at(vec3 centre, float radius)
{
    float q = dot(centre, centre) - radius * radius;
    return Sphere(centre, radius, max(-centre.z, 0.5 * radius), is_nan(q) || q <= 0.0 ? 0.0 : inversesqrt(q));
}

// u.x, u.y and M of a ray.
vec3 sphere_offset(Sphere s, vec3 ray)
{
    vec3 u = (s.scale * ray - s.centre) / s.radius;
    return vec3(u.xy, (dot(u, s.centre) + s.radius) * s.inverse);
}

// 1 - u.z^2, and the two terms of the depth.
vec3 sphere_constants(Sphere s)
{
    float uz = (-s.scale - s.centre.z) / s.radius;
    return vec3(1.0 - uz * uz, near_plane / s.scale, near_plane * s.radius * s.inverse / s.scale);
}

float sphere_depth(vec3 offset, vec3 constants, out float e)
{
    e = offset.z * offset.z + constants.x - dot(offset.xy, offset.xy);
    return constants.y + constants.z * (offset.z + sqrt(max(e, 0.0)));
}

// After: Mara and McGuire, 2D polyhedral bounds of a clipped, perspective-projected 3D sphere, 2013. The tangents' slopes in the
// plane of one axis and the depth w > -radius; unbounded where a tangent points behind the eye.
vec2 sphere_slopes(float a, float w, float radius)
{
    const float open = 1e9;
    float l2 = a * a + w * w, t2 = l2 - radius * radius;
    if (t2 <= 0.0)
        return vec2(-open, open);
    float t = sqrt(t2);
    float low = w * t + a * radius, high = w * t - a * radius;
    return vec2(low > 1e-6 * l2 ? (a * t - w * radius) / low : -open,
                high > 1e-6 * l2 ? (a * t + w * radius) / high : open);
}

// x0 x1 y0 y1 on the screen, clipped at the screen's edges; empty if the sphere is invisible.
vec4 sphere_bounds(Sphere s)
{
    float w = -s.centre.z;
    if (s.inverse == 0.0 || w + s.radius <= near_plane)
        return vec4(0.0);
    vec4 bounds = vec4(sphere_slopes(s.centre.x, w, s.radius) / view_tangent.x, sphere_slopes(s.centre.y, w, s.radius) / view_tangent.y);
    return clamp(bounds + view_centre.xxyy, -1.0, 1.0);
}
