#include "sim/box/box.h"
#include "sim/solids/solid.h"

#include <math.h>

enum { LEAVES = 8 };

static void store(const double v[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)v[k];
}

void solid_pose_of(const BoxState *at, SolidPose *pose)
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    store(at->position, pose->x);
    store(at->velocity, pose->v);
    store(at->angular_velocity, pose->w);
    for (int column = 0; column < 3; column++) {
        double turned[3];
        quat_rotate(at->orientation, axes[column], turned);
        for (int row = 0; row < 3; row++)
            pose->r[row][column] = (float)turned[row];
    }
}

void solid_pose_at(const SolidDef *solid, double time, SolidPose *pose)
{
    BoxState at;
    solid_pose(solid, time, &at);
    solid_pose_of(&at, pose);
}

void solid_step_stand(const SolidDef *solid, const SolidPose *pose, SolidStep *step)
{
    const double slack = 1e-5 * solid_reach(solid); /* for rounding errors, and more than the slack of
                                                       hold() */
    double half[3];
    solid_half(solid, half);
    *step = (SolidStep){.begin = *pose, .end = *pose, .still = true};
    for (int k = 0; k < 3; k++) {
        const double reach = slack + fabsf(pose->r[k][0]) * half[0] + fabsf(pose->r[k][1]) * half[1] +
                             fabsf(pose->r[k][2]) * half[2];
        step->low[k] = (float)(pose->x[k] - reach);
        step->high[k] = (float)(pose->x[k] + reach);
    }
}

void solid_step_make(const SolidDef *solid, double begin, double end, SolidStep *step)
{
    SolidPose at;
    solid_pose_at(solid, begin, &at);
    if (!solid_moves(solid)) {
        solid_step_stand(solid, &at, step);
        return;
    }
    *step = (SolidStep){.begin = at};
    solid_pose_at(solid, end, &step->end);
    for (int k = 0; k < 3; k++) {
        const float dt = (float)(end - begin);
        step->change[k] = (step->end.v[k] - step->begin.v[k]) / dt;
        step->alpha[k] = (step->end.w[k] - step->begin.w[k]) / dt;
    }
}

void solid_step_mean(SolidStep *first, SolidStep *second)
{
    for (int k = 0; k < 3; k++) {
        first->change[k] = second->change[k] = 0.5f * (first->change[k] + second->change[k]);
        first->alpha[k] = second->alpha[k] = 0.5f * (first->alpha[k] + second->alpha[k]);
    }
}

void solid_to_box(const SolidPose *pose, const float in_solid[3], float x[3])
{
    for (int k = 0; k < 3; k++)
        x[k] = pose->x[k] +
               (pose->r[k][0] * in_solid[0] + pose->r[k][1] * in_solid[1] + pose->r[k][2] * in_solid[2]);
}

void solid_from_box(const SolidPose *pose, const float x[3], float in_solid[3])
{
    const float d[3] = {x[0] - pose->x[0], x[1] - pose->x[1], x[2] - pose->x[2]};
    for (int k = 0; k < 3; k++)
        in_solid[k] = pose->r[0][k] * d[0] + pose->r[1][k] * d[1] + pose->r[2][k] * d[2];
}

float solid_clearance(const SolidDef *solid, const SolidPose *pose, int dimensions, const float x[3],
                      float far)
{
    const float reach = (float)solid_reach(solid) + far;
    float r2 = 0, in_solid[3];
    for (int k = 0; k < 3; k++)
        r2 += (x[k] - pose->x[k]) * (x[k] - pose->x[k]);
    if (r2 > reach * reach)
        return sqrtf(r2) - reach + far;
    solid_from_box(pose, x, in_solid);
    const double at[3] = {in_solid[0], in_solid[1], dimensions == 2 ? 0 : in_solid[2]};
    return (float)solid_distance(solid, dimensions, at);
}

void solid_velocity_at(const SolidPose *pose, const float x[3], float v[3])
{
    const float arm[3] = {x[0] - pose->x[0], x[1] - pose->x[1], x[2] - pose->x[2]};
    box_cross(pose->w, arm, v);
    for (int k = 0; k < 3; k++)
        v[k] += pose->v[k];
}

void solid_acceleration_at(const SolidStep *step, const float x[3], float a[3])
{
    const SolidPose *pose = &step->end;
    const float arm[3] = {x[0] - pose->x[0], x[1] - pose->x[1], x[2] - pose->x[2]};
    float swirl[3], euler[3], inward[3];
    box_cross(pose->w, arm, swirl);
    box_cross(pose->w, swirl, inward);
    box_cross(step->alpha, arm, euler);
    for (int k = 0; k < 3; k++)
        a[k] = step->change[k] + euler[k] + inward[k];
}

/* A particle's way through the solid's frame, taken as straight although the solid's motion bends the way. */
typedef struct PointPath {
    const SolidDef *solid;
    int dimensions;
    double from[3], to[3];
} PointPath;

static void along(const PointPath *way, double t, double x[3])
{
    for (int k = 0; k < 3; k++)
        x[k] = way->from[k] + t * (way->to[k] - way->from[k]);
}

static double distance_on(const PointPath *way, double t)
{
    double x[3];
    along(way, t, x);
    return solid_distance(way->solid, way->dimensions, x);
}

/* The first part of the way, 0 .. 1, where the way meets the surface; more than 1: nowhere. Goes forward by
   the distance to the surface: no meeting can be sooner. */
static double meeting(const PointPath *way, double length, double slack)
{
    double t = 0;
    for (int i = 0; i < 64 && t <= 1; i++) {
        const double d = distance_on(way, t);
        if (d <= slack)
            return t;
        t += d / length;
    }
    return t;
}

/* Push `to` out of the solid. Where the surface bends towards the way, the tangent plane is a little inside.
   At edges of a mesh the distance grows more slowly than the way: more than one round is needed. */
static void leave(PointPath *way, double slack, double normal[3])
{
    for (int i = 0; i < LEAVES; i++) {
        const double depth = -solid_distance(way->solid, way->dimensions, way->to);
        if (depth <= 0)
            return;
        solid_normal(way->solid, way->dimensions, way->to, normal);
        for (int k = 0; k < 3; k++)
            way->to[k] += (depth + slack) * normal[k];
    }
}

/* Put `to` a little above the tangent plane at the meeting with the surface, unless `to` is above already.
   False if the way keeps clear of the solid. */
static bool hold(PointPath *way, double normal[3])
{
    const double reach = solid_reach(way->solid), slack = 1e-6 * reach;
    const double d[3] = {way->to[0] - way->from[0], way->to[1] - way->from[1], way->to[2] - way->from[2]};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double at_end = distance_on(way, 1);
    if (at_end >= 2 * length) /* then the start is at least `length` away, even with the rough distance of a
                                 mesh */
        return false;
    if (at_end >= 0 && distance_on(way, 0) + at_end >= length)
        return false;
    const double t = length > 0 ? meeting(way, length, slack) : 0;
    if (t > 1 && at_end >= 0)
        return false;
    double entry[3], depth = 0;
    along(way, fmin(t, 1), entry); /* a mesh's distance may be a little too long, and lead past the end */
    solid_normal(way->solid, way->dimensions, entry, normal);
    for (int k = 0; k < 3; k++)
        depth += (entry[k] - way->to[k]) * normal[k];
    depth += slack - solid_distance(way->solid, way->dimensions, entry);
    if (depth <= 0 && at_end >= 0) /* began at the surface and leaves the solid */
        return false;
    if (depth <= 0) {
        solid_normal(way->solid, way->dimensions, way->to, normal);
        depth = slack - at_end;
    }
    for (int k = 0; k < 3; k++)
        way->to[k] += depth * normal[k];
    leave(way, slack, normal);
    return true;
}

/* True if a ball about the solid keeps clear of all points as near to x as `before`, the solid's own way
   included. */
static bool out_of_reach(const SolidStep *step, const float before[3], const float x[3], float reach)
{
    float r2 = 0, way2 = 0, own2 = 0;
    for (int k = 0; k < 3; k++) {
        const float r = x[k] - step->end.x[k], way = x[k] - before[k],
                    own = step->end.x[k] - step->begin.x[k];
        r2 += r * r;
        way2 += way * way;
        own2 += own * own;
    }
    const float most = reach + sqrtf(way2) + sqrtf(own2);
    return r2 > most * most;
}

/* The same for a block, possibly long and thin: true if one side alone is far enough away. */
static bool beside_block(const SolidDef *solid, const PointPath *way)
{
    double gap = 0, way2 = 0;
    if (solid->kind != SOLID_BOX)
        return false;
    for (int k = 0; k < way->dimensions; k++) {
        const double d = way->to[k] - way->from[k];
        gap = fmax(gap, fabs(way->to[k]) - 0.5 * solid->size[k]);
        way2 += d * d;
    }
    return gap > 0 && gap * gap > 5 * way2;
}

static void place(const SolidPose *pose, const PointPath *way, const double normal[3], float x[3], float v[3])
{
    float in_solid[3], out[3], wall[3], into = 0;
    store(way->to, in_solid);
    solid_to_box(pose, in_solid, x);
    solid_velocity_at(pose, x, wall);
    for (int k = 0; k < 3; k++) {
        out[k] = pose->r[k][0] * (float)normal[0] + pose->r[k][1] * (float)normal[1] +
                 pose->r[k][2] * (float)normal[2];
        into += (v[k] - wall[k]) * out[k];
    }
    for (int k = 0; k < 3 && into < 0; k++)
        v[k] -= into * out[k];
}

bool solid_guard(const SolidDef *solid, const SolidStep *step, int dimensions, const float before[3],
                 float x[3], float v[3])
{
    const float reach = (float)solid_reach(solid);
    if (out_of_reach(step, before, x, reach))
        return false;
    PointPath way = {.solid = solid, .dimensions = dimensions};
    float from[3], to[3];
    solid_from_box(&step->begin, before, from);
    solid_from_box(&step->end, x, to);
    for (int k = 0; k < 3; k++) {
        way.from[k] = k < dimensions ? from[k] : 0;
        way.to[k] = k < dimensions ? to[k] : 0;
    }
    if (beside_block(solid, &way))
        return false;
    double normal[3];
    bool held = false;
    for (int i = 0; i < 3 && hold(&way, normal); i++) { /* again: an inner edge has two sides */
        place(&step->end, &way, normal, x, v);
        held = true;
    }
    return held;
}
