// The shape of a particle in the view splat, in the eye's frame: a ball, or with ELLIPSOID an ellipsoid. Needs common/frame.glsl,
// common/particles.glsl, common/sphere.glsl and common/ball.glsl.
#include "common/nan.glsl"
#ifdef APART
#include "splat/clear/alone.glsl"
#endif
#ifdef ALONE
// Half a pixel larger, for a soft rim: shaders/splat/clear/spray.frag.
float drawn_radius(float radius, vec3 centre)
{
    return radius + view_tangent.y * pixel_size.y * -centre.z;
}
#elif defined DISCS
#include "splat/splat_small.glsl"
#else
#define drawn_radius(radius, centre) (radius)
#endif

struct Body {
    vec3 centre;
    float radius;
    float inner; // radius of a ball around the centre inside the ellipsoid
#ifdef ELLIPSOID
    mat3 inverse; // A
    mat3 axes;    // inverse of A times the radius: maps the unit sphere to the ellipsoid
#endif
};

// The drawn centre of a particle. With APART, isolated particles are not part of the surface, and are moved too far away to be
// visible.
vec3 body_centre(uint index, vec3 centre)
{
    vec3 in_eye = (box_to_eye * vec4(centre, 1.0)).xyz;
#if defined APART && !defined ALONE
    in_eye = is_alone(index) ? vec3(0.0, 0.0, -1e18) : in_eye;
#endif
    return in_eye;
}

#ifdef ELLIPSOID
Body body_of(uint index)
{
    Ball ball = ball_of(index);
    vec4 b = shape[3u * index + 1u], c = shape[3u * index + 2u];
    mat3 turn = mat3(box_to_eye);
    mat3 inverse = turn * mat3(b.x, c.xy, c.x, b.y, c.z, c.yz, b.z) * transpose(turn);
    mat3 axes = ball.radius * mat3(cross(inverse[1], inverse[2]), cross(inverse[2], inverse[0]), cross(inverse[0], inverse[1]));
    return Body(body_centre(index, ball.centre), ball.radius, 0.999 * ball.radius * b.w, inverse, axes);
}

float body_nearest(Body body) // the body's least depth
{
    return -body.centre.z - length(body.axes[2]);
}

// The slopes x / w of the tangent planes through the eye and along y, from x and w of the centre: with S = axes^2 and the plane's
// normal (1, 0, m), (c.n)^2 = n S n. In this form nothing cancels for small and far ellipsoids. If the ellipsoid reaches beside
// the eye, the slopes of a ball around.
vec2 ellipsoid_slopes(float a, float w, float saa, float saz, float szz, float around)
{
    if (w * w <= 1.01 * szz || w < 0.0)
        return sphere_slopes(a, w, around);
    float root = sqrt(max(w * w * saa + 2.0 * w * a * saz + a * a * szz - (saa * szz - saz * saz), 0.0));
    return (a * w + saz + vec2(-root, root)) / (w * w - szz);
}

// x0 x1 y0 y1 on the screen, clipped at the screen's edges; empty (x0 = x1) if invisible, as from inside.
vec4 body_bounds(Body body)
{
    vec3 c = body.centre, within = body.inverse * c, x = body.axes[0], y = body.axes[1], z = body.axes[2];
    float grown = drawn_radius(body.radius, c) / max(body.radius, 1e-30);
    x *= grown, y *= grown, z *= grown;
    float w = -c.z, szz = dot(z, z), around = sqrt(dot(x, x) + dot(y, y) + szz);
    float within2 = dot(within, within), c2 = dot(c, c);
    if (is_nan(within2 + c2) || within2 <= body.radius * body.radius || c2 >= 1e30 || w + sqrt(szz) <= near_plane)
        return vec4(0.0);
    vec4 bounds = vec4(ellipsoid_slopes(c.x, w, dot(x, x), dot(x, z), szz, around) / view_tangent.x,
                       ellipsoid_slopes(c.y, w, dot(y, y), dot(y, z), szz, around) / view_tangent.y);
    return clamp(bounds + view_centre.xxyy, -1.0, 1.0);
}
#else
Body body_of(uint index)
{
    Ball ball = ball_of(index);
    return Body(body_centre(index, ball.centre), ball.radius, ball.radius);
}

float body_nearest(Body body)
{
    return -body.centre.z - body.radius;
}

vec4 body_bounds(Body body)
{
#ifdef PAPER
    vec3 centre = body.centre;
    float w = -centre.z;
    if (is_nan(centre.xyzz) || w <= near_plane)
        return vec4(0.0);
    vec4 bounds = (centre.xxyy + drawn_radius(body.radius, centre) * vec4(-1.0, 1.0, -1.0, 1.0)) / (w * view_tangent.xxyy);
    return clamp(bounds + view_centre.xxyy, -1.0, 1.0);
#else
    return sphere_bounds(sphere_at(body.centre, drawn_radius(body.radius, body.centre)));
#endif
}
#endif

// The scale s of splat/splat.glsl.
float body_scale(Body body)
{
#ifdef PAPER
    return -body.centre.z;
#else
    return max(-body.centre.z, 0.5 * body.radius);
#endif
}
