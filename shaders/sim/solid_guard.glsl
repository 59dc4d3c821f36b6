// Keeps particles out of solids: solid_guard of sim/solids/solid_step.c, in the solid's frame.
#include "sim/solids.glsl"
#ifndef SOLID_BEGIN
#define SOLID_BEGIN(k) solids[k].begin
#endif

// The first part of the way, 0 .. 1, that meets the surface; more than 1: none. Advances by the distance to the
// surface, which cannot be met earlier.
real meeting(int k, rvec3 from, rvec3 to, real way, real slack)
{
    real t = 0.0;
    for (int i = 0; i < 64 && t <= 1.0; i++) {
        real d = solid_distance(k, from + t * (to - from));
        if (d <= slack)
            return t;
        t += d / way;
    }
    return t;
}

// Puts `to` slightly above the tangent plane of the surface at the meeting point, unless already there. False if the
// way stays clear of the solid.
bool hold(int k, rvec3 from, inout rvec3 to, out rvec3 normal)
{
    real slack = slack_share * SHAPES[k].reach, way = length(to - from), at_end = solid_distance(k, to);
    normal = rvec3(0.0, 1.0, 0.0);
    if (at_end >= 0.0 && solid_distance(k, from) + at_end >= way)
        return false;
    real t = way > 0.0 ? meeting(k, from, to, way, slack) : 0.0;
    if (t > 1.0 && at_end >= 0.0)
        return false;
    rvec3 entry = from + min(t, 1.0) * (to - from); // a mesh's distance may be slightly too large
    normal = solid_normal(k, entry);
    real depth = dot(entry - to, normal) + slack - solid_distance(k, entry);
    if (depth <= 0.0 && at_end >= 0.0) // started at the surface and leaves it
        return false;
    if (depth <= 0.0) {
        normal = solid_normal(k, to);
        depth = slack - at_end;
    }
    to += depth * normal;
    // on a surface curved towards the way, the tangent plane is slightly inside; a mesh's edge takes several rounds
    for (int i = 0; i < 8; i++) {
        depth = -solid_distance(k, to);
        if (depth <= 0.0)
            break;
        normal = solid_normal(k, to);
        to += (depth + slack) * normal;
    }
    return true;
}

bool out_of_reach(int k, vec3 before, vec3 x)
{
    float own = distance(SOLID_BEGIN(k).x, solids[k].end.x);
    return distance(x, solids[k].end.x) > solid_reach(k) + distance(before, x) + own;
}

#ifndef HELD_BY // reaction of a pass to velocity taken from a particle by solid k
#define HELD_BY(k, at, taken)
#endif

// True if a particle that moved from `before` to x was held.
bool solids_guard(vec3 before, inout vec3 x, inout vec3 v)
{
    bool held = false;
    for (int k = 0; k < solid_total; k++) {
        if (out_of_reach(k, before, x))
            continue;
        vec3 free = v;
        rvec3 from = rvec3(solid_from_box(SOLID_BEGIN(k), before)), to = rvec3(solid_from_box(solids[k].end, x)), normal;
        for (int i = 0; i < 3 && hold(k, from, to, normal); i++) { // again: an inner edge has two sides
            x = solid_to_box(solids[k].end, vec3(to));
            vec3 n = solid_to_box(Pose(vec3(0), solids[k].end.r), vec3(normal));
            v -= min(dot(v - solid_velocity_at(k, x), n), 0.0) * n;
            held = true;
        }
        HELD_BY(k, x, free - v)
    }
    return held;
}
