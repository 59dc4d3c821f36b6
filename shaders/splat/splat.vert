// Four vertices per particle: the corners of its bound on the screen; with POINT one vertex, and the driver draws a square around
// the bound. With BLEND also passes the colour.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/listed.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "common/ball.glsl"
#include "splat/splat_body.glsl"
#include "shaders/splat/splat_bindings.h"
#ifdef BLEND
#include "common/particle_color.glsl"
layout(location = 2) flat out vec3 color;
#if defined DISCS && !defined ALONE
layout(location = 7) flat out float gain; // see splat/splat_small.glsl
#endif
#endif

#ifdef THICKNESS
layout(location = MAP_SIZE_AT) uniform vec2 texels;
layout(location = 2) flat out vec2 column;
#else
#define texels picture_size
#endif

#ifdef POINT
layout(location = 0) invariant flat out vec4 from; // of `at` over the point
layout(location = 3) invariant flat out vec4 across;
#else
layout(location = 0) invariant noperspective out vec4 at;
#endif
layout(location = 1) invariant flat out vec2 scale;
#if defined ELLIPSOID || defined DROPS
layout(location = 4) invariant flat out float radius;
#endif
#ifdef ELLIPSOID
layout(location = 5) invariant flat out vec3 inverse_own;
layout(location = 6) invariant flat out vec3 inverse_mixed;
#endif
invariant gl_Position;
invariant gl_PointSize;

vec4 at_corner(Body body, vec2 corner)
{
    vec2 ray = ray_of_ndc(corner).xy;
    return vec4((scale.x * ray - body.centre.xy) / drawn_radius(body.radius, body.centre), ray);
}

#ifdef POINT
void place(Body body, vec4 bounds, float depth)
{
    vec2 extent = (bounds.yw - bounds.xz) * texels / 2.0;
    float size = max(ceil(8.0 * max(extent.x, extent.y)) / 8.0, 1.0); // hardware rounds to such steps; the minimum is 1
    vec2 middle = 0.5 * (bounds.xz + bounds.yw), reach = size * vec2(1.0, -1.0) / texels; // gl_PointCoord counts from the top
    from = at_corner(body, middle - reach);
    across = at_corner(body, middle + reach) - from;
    gl_PointSize = size;
    gl_Position = extent.x > 0.0 ? vec4(middle, depth, 1.0) : vec4(2.0, 2.0, 0.5, 1.0);
}
#else
void place(Body body, vec4 bounds, float depth)
{
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? bounds.x : bounds.y, (gl_VertexID & 2) == 0 ? bounds.z : bounds.w);
    at = at_corner(body, corner);
    gl_Position = vec4(corner, depth, 1.0);
}
#endif

void describe(Body body)
{
    float s = body_scale(body);
    scale = vec2(s, (-s - body.centre.z) / body.radius);
#if defined ELLIPSOID || defined DROPS
    radius = body.radius;
#endif
#ifdef ELLIPSOID
    inverse_own = vec3(body.inverse[0].x, body.inverse[1].y, body.inverse[2].z);
    inverse_mixed = vec3(body.inverse[0].yz, body.inverse[1].z);
#endif
}

void main()
{
#ifdef POINT
    uint index = listed_particle(uint(gl_VertexID));
#else
    uint index = listed_particle(uint(gl_VertexID) >> 2);
#endif
    Body body = body_of(index);
    describe(body);
    float nearest = max(body_nearest(body), near_plane);
    place(body, body_bounds(body), min(near_plane / nearest * 1.00001, 1.0));
#ifdef BLEND
    color = particle_color(index);
#if defined DISCS && !defined ALONE
    gain = cover_gain(body.radius, drawn_radius(body.radius, body.centre));
#endif
#endif
#ifdef THICKNESS
    column = vec2(4.5 / 3.14159265 * particle_spacing * particle_spacing * particle_spacing / (splat_radius * splat_radius), near_plane / -body.centre.z);
#endif
}
