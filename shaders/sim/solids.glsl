// Solids: where they are over half a step, their shapes and distances. Mirrors sim/solid_step.c and sim/solid.c, the block
// SolidsBlock in sim/gl/compute/boundary.c. In single precision, so normals come from the shapes, not from differences.
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
    vec4 change;   // rates of velocity and spin over the step; w: reach
    vec4 alpha;
    vec4 size;     // half the edges of a box; half the height of a cylinder in y; w: radius
    vec4 wall;     // of a bowl: thickness
};

layout(std140, binding = 6) uniform Solids {
    ivec4 solid_counts; // solids, boundary particles
    Solid solids[SOLIDS_MAX];
};

vec3 solid_to_box(Pose pose, vec3 x)
{
    return pose.x.xyz + vec3(dot(pose.r[0].xyz, x), dot(pose.r[1].xyz, x), dot(pose.r[2].xyz, x));
}

// In two dimensions in the solid's plane.
vec3 solid_from_box(Pose pose, vec3 x)
{
    vec3 d = x - pose.x.xyz, at = pose.r[0].xyz * d.x + pose.r[1].xyz * d.y + pose.r[2].xyz * d.z;
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

// From the nearest point of the surface to x, outside; less than 0 inside.
float solid_distance(int k, vec3 x)
{
    float radius = solids[k].size.w;
    switch (int(solids[k].spin.w)) {
    case SOLID_BOX: {
        vec3 d = abs(x) - solids[k].size.xyz;
        float inside = max(max(d.x, d.y), d.z);
        return inside > 0.0 ? length(max(d, 0.0)) : inside;
    }
    case SOLID_CYLINDER: {
        vec2 d = vec2(length(x.xz) - radius, abs(x.y) - solids[k].size.y);
        return d.x > 0.0 && d.y > 0.0 ? length(d) : max(d.x, d.y);
    }
    case SOLID_BOWL: {
        float thickness = solids[k].wall.x, across = length(x.xz);
        if (x.y > 0.0)
            return length(vec2(across - clamp(across, radius, radius + thickness), x.y));
        float wall = abs(length(x) - (radius + 0.5 * thickness)) - 0.5 * thickness;
        return wall > 0.0 ? wall : max(wall, x.y);
    }
    default:
        return length(x) - radius;
    }
}

vec3 unit(vec3 v)
{
    float norm = length(v);
    return norm > 0.0 ? v / norm : vec3(0, 1, 0);
}

vec3 block_normal(vec3 half_edges, vec3 x)
{
    vec3 d = abs(x) - half_edges, side = vec3(x.x < 0.0 ? -1.0 : 1.0, x.y < 0.0 ? -1.0 : 1.0, x.z < 0.0 ? -1.0 : 1.0);
    if (max(max(d.x, d.y), d.z) > 0.0)
        return unit(side * max(d, 0.0));
    return d.x >= d.y && d.x >= d.z ? vec3(side.x, 0, 0) : d.y >= d.z ? vec3(0, side.y, 0) : vec3(0, 0, side.z);
}

vec3 cylinder_normal(int k, vec3 x)
{
    vec2 d = vec2(length(x.xz) - solids[k].size.w, abs(x.y) - solids[k].size.y);
    vec3 side = unit(vec3(x.x, 0.0, x.z)), end = vec3(0.0, x.y < 0.0 ? -1.0 : 1.0, 0.0);
    if (d.x > 0.0 && d.y > 0.0)
        return unit(d.x * side + d.y * end);
    return d.x > d.y ? side : end;
}

vec3 bowl_normal(int k, vec3 x)
{
    float inner = solids[k].size.w, thickness = solids[k].wall.x, across = length(x.xz);
    if (x.y > 0.0) {
        float beside = across - clamp(across, inner, inner + thickness);
        return unit(beside * unit(vec3(x.x, 0.0, x.z)) + vec3(0.0, x.y, 0.0));
    }
    float from_middle = length(x) - (inner + 0.5 * thickness), wall = abs(from_middle) - 0.5 * thickness;
    return wall <= 0.0 && x.y > wall ? vec3(0, 1, 0) : (from_middle < 0.0 ? -1.0 : 1.0) * unit(x);
}

// Along which the distance grows fastest.
vec3 solid_normal(int k, vec3 x)
{
    switch (int(solids[k].spin.w)) {
    case SOLID_BOX:
        return block_normal(solids[k].size.xyz, x);
    case SOLID_CYLINDER:
        return cylinder_normal(k, x);
    case SOLID_BOWL:
        return bowl_normal(k, x);
    default:
        return unit(x);
    }
}

// Of x in the box's frame, or `far` and more where it is further away than that.
float solid_clearance(int k, vec3 x, float far)
{
    float reach = solids[k].change.w + far, r = distance(x, solids[k].end.x.xyz);
    return r > reach ? r - reach + far : solid_distance(k, solid_from_box(solids[k].end, x));
}
