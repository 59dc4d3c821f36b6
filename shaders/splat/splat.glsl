// A particle as a sphere or an ellipsoid of the view splat. After: Adams, Lenaerts, Dutré 2006, section 3.1. With centre c,
// radius r and view ray d = (x, y, -1): u = (s d - c) / r for a scale s near the centre's depth; the ray meets the sphere at the
// depth s - k r along the eye's axis, where |u - k d| = 1. Nothing cancels for small and far spheres. With PAPER the ray is
// parallel to the axis instead, from the point of the square through the centre: eq. 5. With ELLIPSOID |A (u - k d)| = 1.
#include "shaders/splat/splat_bindings.h"
#ifdef THICKNESS // for the field, which is of balls
#undef ELLIPSOID
#undef DROPS
layout(location = SPLAT_RADIUS_AT) uniform float splat_radius; // radius of the kernel, m
#define BALL_RADIUS splat_radius
#else
#define splat_radius particle_radius
#endif

// Two passes must find the same depth: the inputs are `precise`, and `invariant` as outputs of vertex shaders.
struct Splat {
    float depth;   // z_i, m
    float inside2; // 1 - (distance of the ray from the centre / r)^2: negative outside the sphere; for an ellipsoid, after mapping by A
    vec3 normal;   // in the eye's frame
    vec2 beside;   // x y of the ray's offset from the centre, in radii; for an ellipsoid A times this offset, after mapping by A
};

// `at`: u.x u.y and x y of the ray, linear on the screen; `scale`: s and u.z, which is 0 unless the eye is next to the sphere.
#ifdef ELLIPSOID
Splat splat_hit(vec4 at, vec2 scale, float radius, mat3 inverse)
{
    vec3 u = inverse * vec3(at.xy, scale.y), d = inverse * vec3(at.zw, -1.0);
    float length2 = dot(d, d), per = 1.0 / length2, slant = dot(u, d) * per;
    precise float e = slant * slant + (1.0 - dot(u, u)) * per, k = slant + sqrt(max(e, 0.0)), depth = scale.x - radius * k;
    return Splat(depth, e * length2, normalize(inverse * (u - k * d)), (inverse * (u - slant * d)).xy);
}
#else
Splat splat_hit(vec4 at, vec2 scale, float radius)
{
#ifdef PAPER
    precise float inside2 = 1.0 - dot(at.xy, at.xy), k = sqrt(max(inside2, 0.0)), depth = scale.x - radius * k;
    return Splat(depth, inside2, vec3(at.xy, k), at.xy);
#else
    float length2 = 1.0 + dot(at.zw, at.zw), per = 1.0 / length2;
    float slant = (dot(at.xy, at.zw) - scale.y) * per;
    precise float e = slant * slant + (1.0 - scale.y * scale.y - dot(at.xy, at.xy)) * per;
    precise float k = slant + sqrt(max(e, 0.0)), depth = scale.x - radius * k;
    return Splat(depth, e * length2, vec3(at.xy - k * at.zw, scale.y + k), at.xy - slant * at.zw);
#endif
}
#endif

bool splat_seen(Splat hit)
{
    return hit.inside2 >= 0.0 && hit.depth >= near_plane;
}
