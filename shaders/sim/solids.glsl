// Solids: shapes and distances. Mirrors sim/solids/solid_step.c and sim/solids/solid.c. Distances are in single
// precision, since most GPUs are 32 to 64 times slower in double precision. With REPRODUCIBLE, distances are in
// double precision like on the CPU: the last bit decides if a particle on a surface is held, and then the bit is the
// same.
#include "shaders/sim/solid_steps_block.h"
#ifdef REPRODUCIBLE
#include "shaders/sim/exact_shapes_block.h"
#define SHAPES exact_shapes
#define real double
#define rvec2 dvec2
#define rvec3 dvec3
const real slack_share = 1e-6lf; // of the reach: height above a surface at which particles are put
#else
#define SHAPES solids
#define real float
#define rvec2 vec2
#define rvec3 vec3
const real slack_share = 4e-6;
#endif

#ifdef MESHES
#include "sim/mesh_distance.glsl"
#endif

vec3 solid_to_box(Pose pose, vec3 x)
{
    precise vec3 at;
    for (int k = 0; k < 3; k++)
        at[k] = pose.x[k] + (pose.r[k].x * x.x + pose.r[k].y * x.y + pose.r[k].z * x.z);
    return at;
}

// For two dimensions in the solid's plane.
vec3 solid_from_box(Pose pose, vec3 x)
{
    precise vec3 d = x - pose.x, at = pose.r[0].xyz * d.x + pose.r[1].xyz * d.y + pose.r[2].xyz * d.z;
    return dimensions == 2 ? vec3(at.xy, 0.0) : at;
}

vec3 solid_velocity_at(int k, vec3 x)
{
    return solids[k].velocity + cross(solids[k].spin, x - solids[k].end.x);
}

vec3 solid_acceleration_at(int k, vec3 x)
{
    vec3 arm = x - solids[k].end.x, spin = solids[k].spin;
    return solids[k].change + cross(solids[k].alpha, arm) + cross(spin, cross(spin, arm));
}

float solid_reach(int k) { return solids[k].reach; }

// Distance to the surface for x outside; less than 0 inside.
real solid_distance(int k, rvec3 x)
{
    real radius = SHAPES[k].radius;
    switch (solids[k].kind) {
    case SOLID_BOX: {
        rvec3 d = abs(x) - SHAPES[k].half_edges;
        real inside = max(max(d.x, d.y), d.z);
        return inside > 0.0 ? length(max(d, rvec3(0.0))) : inside;
    }
    case SOLID_CYLINDER: {
        rvec2 d = rvec2(length(x.xz) - radius, abs(x.y) - SHAPES[k].half_edges.y);
        return d.x > 0.0 && d.y > 0.0 ? length(d) : max(d.x, d.y);
    }
    case SOLID_BOWL: {
        real thickness = SHAPES[k].thickness, across = length(x.xz);
        if (x.y > 0.0)
            return length(rvec2(across - clamp(across, radius, radius + thickness), x.y));
        real wall = abs(length(x) - (radius + 0.5 * thickness)) - 0.5 * thickness;
        return wall > 0.0 ? wall : max(wall, x.y);
    }
#ifdef MESHES
    case SOLID_MESH:
        return mesh_distance(k, x);
#endif
    default:
        return length(x) - radius;
    }
}

#ifdef REPRODUCIBLE
double solid_difference(int k, dvec3 x, dvec3 aside)
{
    return solid_distance(k, x + aside) - solid_distance(k, x - aside);
}

// Direction of the fastest growth of the distance, by differences. No component with a variable index: NVIDIA's
// compiler supports that for single precision only.
dvec3 solid_normal(int k, dvec3 x)
{
    double step = 1e-6lf * exact_shapes[k].reach;
    dvec3 normal = dvec3(solid_difference(k, x, dvec3(step, 0.0, 0.0)), solid_difference(k, x, dvec3(0.0, step, 0.0)), 0.0);
    if (dimensions != 2)
        normal.z = solid_difference(k, x, dvec3(0.0, 0.0, step));
    double norm = length(normal);
    return norm > 0.0 ? normal / norm : dvec3(0.0, 1.0, 0.0);
}
#else
vec3 box_slope(vec3 size, vec3 x)
{
    vec3 d = abs(x) - size, side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(x, vec3(0.0)));
    float nearest = max(max(d.x, d.y), d.z);
    return side * (nearest > 0.0 ? max(d, 0.0) : vec3(greaterThanEqual(d, vec3(nearest))));
}

vec3 cylinder_slope(float radius, float half_height, vec3 x)
{
    float across = length(x.xz);
    vec2 d = vec2(across - radius, abs(x.y) - half_height);
    vec3 out_of = vec3(x.x, 0.0, x.z) / max(across, 1e-30), up = vec3(0.0, x.y < 0.0 ? -1.0 : 1.0, 0.0);
    return d.x > 0.0 && d.y > 0.0 ? d.x * out_of + d.y * up : d.x > d.y ? out_of : up;
}

vec3 bowl_slope(float radius, float thickness, vec3 x)
{
    if (x.y > 0.0) {
        float across = length(x.xz), ring = clamp(across, radius, radius + thickness);
        return vec3(x.xz * ((across - ring) / max(across, 1e-30)), x.y).xzy;
    }
    float off = length(x) - (radius + 0.5 * thickness);
    return abs(off) - 0.5 * thickness <= x.y ? vec3(0.0, 1.0, 0.0) : off < 0.0 ? -x : x; // the rim is nearer, or the wall
}

// Direction of the fastest growth of the distance. Analytic: a difference of two distances would have only a few
// digits.
vec3 solid_normal(int k, vec3 x)
{
    int kind = solids[k].kind;
    vec3 slope = kind == SOLID_BOX        ? box_slope(solids[k].half_edges, x)
                 : kind == SOLID_CYLINDER ? cylinder_slope(solids[k].radius, solids[k].half_edges.y, x)
                 : kind == SOLID_BOWL     ? bowl_slope(solids[k].radius, solids[k].thickness, x)
                                          : x;
#ifdef MESHES
    if (kind == SOLID_MESH)
        slope = mesh_slope(k, x);
#endif
    float norm = length(slope);
    return norm > 0.0 ? slope / norm : vec3(0.0, 1.0, 0.0);
}
#endif

// Distance of x in the box's frame to the solid; at least `far` if it is further away.
float solid_clearance(int k, vec3 x, float far)
{
    float reach = solid_reach(k) + far, r = distance(x, solids[k].end.x);
    return r > reach ? r - reach + far : float(solid_distance(k, rvec3(solid_from_box(solids[k].end, x))));
}
