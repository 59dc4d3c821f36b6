// Solids: where they are over half a step, their shapes and distances. Mirrors sim/solid_step.c and sim/solid.c, the block
// SolidsBlock in sim/gl/compute/boundary.c. Distances are in double precision as there: what lies on a surface is held or
// not by the last bit, and that should be the same bit.
#define SOLIDS_MAX 16
#define SOLID_BOX 1
#define SOLID_CYLINDER 2
#define SOLID_BOWL 3

struct Pose {
    vec4 x;
    vec4 r[3]; // rows: x_box = x + r x_solid
};

struct Solid {
    Pose begin, end;
    vec4 velocity; // at the end; w: 1 where viscous fluid would stick to it
    vec4 spin;     // w: kind
    vec4 change;   // rates of velocity and spin over the step
    vec4 alpha;
    dvec4 size;    // half the edges of a box; half the height of a cylinder in y; w: radius
    dvec4 wall;    // of a bowl: thickness; y: reach
};

layout(std140, binding = 6) uniform Solids {
    ivec4 solid_counts; // solids, boundary particles
    Solid solids[SOLIDS_MAX];
};

vec3 solid_to_box(Pose pose, vec3 x)
{
    precise vec3 at;
    for (int k = 0; k < 3; k++)
        at[k] = pose.x[k] + (pose.r[k].x * x.x + pose.r[k].y * x.y + pose.r[k].z * x.z);
    return at;
}

// In two dimensions in the solid's plane.
vec3 solid_from_box(Pose pose, vec3 x)
{
    precise vec3 d = x - pose.x.xyz, at = pose.r[0].xyz * d.x + pose.r[1].xyz * d.y + pose.r[2].xyz * d.z;
    return rows.x == 3 ? vec3(at.xy, 0.0) : at;
}

vec3 solid_velocity_at(int k, vec3 x)
{
    return solids[k].velocity.xyz + cross(solids[k].spin.xyz, x - solids[k].end.x.xyz);
}

vec3 solid_acceleration_at(int k, vec3 x)
{
    vec3 arm = x - solids[k].end.x.xyz, spin = solids[k].spin.xyz;
    return solids[k].change.xyz + cross(solids[k].alpha.xyz, arm) + cross(spin, cross(spin, arm));
}

float solid_reach(int k) { return float(solids[k].wall.y); }

// From the nearest point of the surface to x, outside; less than 0 inside.
double solid_distance(int k, dvec3 x)
{
    double radius = solids[k].size.w;
    switch (int(solids[k].spin.w)) {
    case SOLID_BOX: {
        dvec3 d = abs(x) - solids[k].size.xyz;
        double inside = max(max(d.x, d.y), d.z);
        return inside > 0.0 ? length(max(d, 0.0)) : inside;
    }
    case SOLID_CYLINDER: {
        dvec2 d = dvec2(length(x.xz) - radius, abs(x.y) - solids[k].size.y);
        return d.x > 0.0 && d.y > 0.0 ? length(d) : max(d.x, d.y);
    }
    case SOLID_BOWL: {
        double thickness = solids[k].wall.x, across = length(x.xz);
        if (x.y > 0.0)
            return length(dvec2(across - clamp(across, radius, radius + thickness), x.y));
        double wall = abs(length(x) - (radius + 0.5 * thickness)) - 0.5 * thickness;
        return wall > 0.0 ? wall : max(wall, x.y);
    }
    default:
        return length(x) - radius;
    }
}

// Along which the distance grows fastest, by differences.
dvec3 solid_normal(int k, dvec3 x)
{
    double step = 1e-6lf * solids[k].wall.y;
    dvec3 normal = dvec3(0.0);
    for (int a = 0; a < (rows.x == 3 ? 2 : 3); a++) {
        dvec3 aside = dvec3(0.0);
        aside[a] = step;
        normal[a] = solid_distance(k, x + aside) - solid_distance(k, x - aside);
    }
    double norm = length(normal);
    return norm > 0.0 ? normal / norm : dvec3(0.0, 1.0, 0.0);
}

// Of x in the box's frame, or `far` and more where it is further away than that.
float solid_clearance(int k, vec3 x, float far)
{
    float reach = solid_reach(k) + far, r = distance(x, solids[k].end.x.xyz);
    return r > reach ? r - reach + far : float(solid_distance(k, dvec3(solid_from_box(solids[k].end, x))));
}
