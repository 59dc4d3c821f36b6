#include "sim/def.h"
#include "sim/mesh/mesh_shape.h"
#include "sim/world.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

const char *solid_name(SolidKind kind)
{
    static const char *const names[] = {
#define X(NAME, name, help) name,
        SOLID_LIST(X)
#undef X
    };
    return names[kind];
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* The shortest turn from +y to `axis`. */
static void turn_from_y(const double axis[3], double q[4])
{
    const double norm = length(axis), a[3] = {axis[0] / norm, axis[1] / norm, axis[2] / norm};
    if (a[1] < -1 + 1e-12) { /* straight down: about z, to keep a scene's plane */
        q[0] = q[1] = q[3] = 0, q[2] = 1;
        return;
    }
    const double w = sqrt(0.5 * (1 + a[1])); /* cos of half the angle; y x a = (a_z, 0, -a_x) */
    q[0] = 0.5 * a[2] / w, q[1] = 0, q[2] = -0.5 * a[0] / w, q[3] = w;
}

void solid_turn(const double axis[3], double angle_deg, double q[4])
{
    const double angle = angle_deg * (M_PI / 180), norm = length(axis);
    const double turn[3] = {axis[0] / norm * angle, axis[1] / norm * angle, axis[2] / norm * angle};
    q[0] = q[1] = q[2] = 0, q[3] = 1;
    quat_turn(turn, q);
}

static void rest_orientation(const SolidDef *solid, double q[4])
{
    q[0] = q[1] = q[2] = 0, q[3] = 1;
    if (solid->kind == SOLID_CYLINDER || solid->kind == SOLID_BOWL) {
        turn_from_y(solid->axis, q);
    } else if (solid->angle_deg != 0 && (solid->kind == SOLID_BOX || solid->kind == SOLID_MESH)) {
        solid_turn(solid->axis, solid->angle_deg, q);
    }
}

/* x(s) = (a + (v + a / tau) s) e^(-s / tau): from a and v to rest at 0. */
static void settle(const double from[3], const double rate[3], double tau, double s, double x[3], double v[3])
{
    const double e = exp(-s / tau);
    for (int k = 0; k < 3; k++) {
        const double b = rate[k] + from[k] / tau, now = from[k] + b * s;
        x[k] = now * e;
        v[k] = (b - now / tau) * e;
    }
}

void solid_hand_at(const SolidHand *hand, double time, BoxState *part)
{
    double turned[3];
    *part = (BoxState){.orientation = {0, 0, 0, 1}};
    if (!hand->moved)
        return;
    const double s = fmax(time - hand->since, 0);
    settle(hand->apart, hand->rate, hand->response, s, part->position, part->velocity);
    settle(hand->turned, hand->turned_rate, hand->response, s, turned, part->angular_velocity);
    for (int k = 0; k < 3; k++)
        part->position[k] += hand->at[k];
    memcpy(part->orientation, hand->turn, sizeof part->orientation);
    quat_turn(turned, part->orientation);
}

/* The rotation vector of a * conj(b), the short way round. */
static void rotation_between(const double a[4], const double b[4], double out[3])
{
    const double inverse[4] = {-b[0], -b[1], -b[2], b[3]};
    double d[4];
    quat_multiply(a, inverse, d);
    const double sine = length(d), sign = d[3] < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++)
        out[k] = sine > 0 ? sign * 2 * atan2(sine, sign * d[3]) / sine * d[k] : 0;
}

static void limit(double v[3], double most)
{
    const double l = length(v);
    for (int k = 0; k < 3 && l > most; k++)
        v[k] *= most / l;
}

bool solid_hand_move(SolidHand *hand, const double at[3], const double turn[4], double time, double speed,
                     double turn_speed, int dimensions)
{
    static const double RESPONSE = 0.05, LONGEST = 100; /* s: a mouse reports places every 10 ms or so */
    BoxState now;
    const double norm = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
    if (!(norm > 0) || !isfinite(norm) || !isfinite(at[0] + at[1] + at[2]) || !(speed > 0) ||
        !(turn_speed > 0))
        return false;
    solid_hand_at(hand, time, &now);
    SolidHand next = {.moved = true, .since = time, .at = {at[0], at[1], dimensions == 2 ? 0 : at[2]}};
    for (int k = 0; k < 4; k++)
        next.turn[k] = dimensions == 2 && k < 2 ? 0 : turn[k] / norm;
    if (dimensions == 2 && !(hypot(next.turn[2], next.turn[3]) > 0.5))
        next.turn[2] = 0, next.turn[3] = 1;
    rotation_between(now.orientation, next.turn, next.turned);
    for (int k = 0; k < 3; k++)
        next.apart[k] = now.position[k] - next.at[k];
    memcpy(next.rate, now.velocity, sizeof next.rate);
    memcpy(next.turned_rate, now.angular_velocity, sizeof next.turned_rate);
    limit(next.rate, speed);
    limit(next.turned_rate, turn_speed);
    /* from rest the speed is greatest after one time constant: a / (e tau); a push at the begin adds at most
       the push's own speed */
    next.response = fmin(
        fmax(RESPONSE, fmax(length(next.apart) / (M_E * speed), length(next.turned) / (M_E * turn_speed))),
        LONGEST);
    *hand = next;
    return true;
}

void solid_pose(const SolidDef *solid, double time, BoxState *pose)
{
    double rest[4];
    rest_orientation(solid, rest);
    box_state_at(solid->motions, solid->motion_count, 0, time, pose);
    for (int k = 0; k < 3; k++)
        pose->position[k] += solid->centre[k];
    quat_multiply(pose->orientation, rest, pose->orientation);
    if (!solid->hand.moved)
        return;
    BoxState hand;
    double spin[3];
    solid_hand_at(&solid->hand, time, &hand);
    quat_rotate(hand.orientation, pose->angular_velocity, spin);
    for (int k = 0; k < 3; k++) {
        pose->position[k] += hand.position[k];
        pose->velocity[k] += hand.velocity[k];
        pose->angular_velocity[k] = spin[k] + hand.angular_velocity[k];
    }
    quat_multiply(hand.orientation, pose->orientation, pose->orientation);
}

void solid_pose_in(const SolidDef *solid, double time, const BoxState *floating, BoxState *pose)
{
    const double *q = floating->orientation;
    if (solid_floats(solid) && (q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0))
        *pose = *floating;
    else
        solid_pose(solid, time, pose);
}

static double block_distance(const double half[3], int dimensions, const double x[3])
{
    const int axes = dimensions == 2 ? 2 : 3;
    double outside = 0, inside = -INFINITY;
    for (int k = 0; k < axes; k++) {
        const double d = fabs(x[k]) - half[k];
        outside += d > 0 ? d * d : 0;
        inside = fmax(inside, d);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

static double cylinder_distance(const SolidDef *solid, const double x[3])
{
    const double side = sqrt(x[0] * x[0] + x[2] * x[2]) - solid->radius,
                 end = fabs(x[1]) - 0.5 * solid->height;
    return side > 0 && end > 0 ? sqrt(side * side + end * end) : fmax(side, end);
}

/* Below the rim the nearest point is on one of the two spheres, above the rim on the ring. */
static double bowl_distance(const SolidDef *solid, const double x[3])
{
    const double inner = solid->radius, outer = inner + solid->thickness;
    if (x[1] > 0) {
        const double across = sqrt(x[0] * x[0] + x[2] * x[2]), ring = fmin(fmax(across, inner), outer);
        return sqrt((across - ring) * (across - ring) + x[1] * x[1]);
    }
    const double wall = fabs(length(x) - 0.5 * (inner + outer)) - 0.5 * solid->thickness;
    return wall > 0 ? wall : fmax(wall, x[1]);
}

double mesh_use_distance(const MeshUse *mesh, const double x[3])
{
    const double scale = mesh->scale, at[3] = {x[0] / scale, x[1] / scale, x[2] / scale};
    return mesh->shape ? scale * distance_at(&mesh->shape->distance, at, NULL) : INFINITY;
}

double mesh_use_reach(const MeshUse *mesh)
{
    return mesh->shape ? mesh->scale * mesh->shape->reach : 0;
}

double solid_distance(const SolidDef *solid, int dimensions, const double x[3])
{
    const double half[3] = {0.5 * solid->size[0], 0.5 * solid->size[1], 0.5 * solid->size[2]};
    switch (solid->kind) {
    case SOLID_BOX:
        return block_distance(half, dimensions, x);
    case SOLID_CYLINDER:
        return cylinder_distance(solid, x);
    case SOLID_BOWL:
        return bowl_distance(solid, x);
    case SOLID_MESH:
        return mesh_use_distance(&solid->mesh, x);
    default:
        return length(x) - solid->radius;
    }
}

/* By differences: only for the few particles inside a solid. */
void solid_normal(const SolidDef *solid, int dimensions, const double x[3], double normal[3])
{
    const double step = 1e-6 * solid_reach(solid);
    const int axes = dimensions == 2 ? 2 : 3;
    normal[2] = 0;
    for (int k = 0; k < axes; k++) {
        double low[3] = {x[0], x[1], x[2]}, high[3] = {x[0], x[1], x[2]};
        low[k] -= step;
        high[k] += step;
        normal[k] = solid_distance(solid, dimensions, high) - solid_distance(solid, dimensions, low);
    }
    const double norm = length(normal);
    for (int k = 0; k < 3; k++)
        normal[k] = norm > 0 ? normal[k] / norm : k == 1;
}

double solid_reach(const SolidDef *solid)
{
    switch (solid->kind) {
    case SOLID_BOX:
        return 0.5 * length(solid->size);
    case SOLID_CYLINDER:
        return hypot(solid->radius, 0.5 * solid->height);
    case SOLID_BOWL:
        return solid->radius + solid->thickness;
    case SOLID_MESH:
        return mesh_use_reach(&solid->mesh);
    default:
        return solid->radius;
    }
}

void solid_half(const SolidDef *solid, double half[3])
{
    const double reach = solid_reach(solid);
    for (int k = 0; k < 3; k++)
        half[k] = reach;
    if (solid->kind == SOLID_CYLINDER) {
        half[0] = half[2] = solid->radius;
        half[1] = 0.5 * solid->height;
    }
    for (int k = 0; k < 3 && solid->kind == SOLID_BOX; k++)
        half[k] = 0.5 * solid->size[k];
    for (int k = 0; k < 3 && solid->kind == SOLID_MESH && solid->mesh.shape; k++)
        half[k] = solid->mesh.scale * solid->mesh.shape->half[k];
}

/* Greatest way of the motions along the axis, m; INFINITY if unbounded. */
static double way_along(const SolidDef *solid, int axis)
{
    double way = solid_floats(solid) ? INFINITY : 0;
    for (int i = 0; i < solid->motion_count; i++) {
        const Motion *motion = &solid->motions[i];
        const double along = fabs(motion->axis[axis]) / length(motion->axis);
        if (motion->kind == MOTION_SHAKE)
            way += motion->amplitude * along;
        if (motion->kind == MOTION_PATH)
            way += motion_farthest(motion) * along;
        if (motion->kind == MOTION_ACCELERATE && along > 0)
            way = INFINITY;
    }
    return way;
}

bool solid_between(const SolidDef *solid, int dimensions, int axis, double low, double high)
{
    const MeshUse *mesh = solid->kind == SOLID_MESH && solid->mesh.shape ? &solid->mesh : NULL;
    bool turned = (solid->kind != SOLID_BOX && !mesh) || solid->angle_deg != 0;
    if (solid->hand.moved)
        return false;
    for (int i = 0; i < solid->motion_count; i++)
        turned |= !motion_translates(&solid->motions[i]);
    SolidDef flat = *solid;
    if (dimensions == 2)
        flat.size[2] = 0;
    const double half = turned ? solid_reach(&flat)
                        : mesh ? mesh->scale * mesh->shape->half[axis]
                               : 0.5 * solid->size[axis];
    const double reach = (1 - 1e-9) * half + way_along(solid, axis);
    return solid->centre[axis] - reach >= low && solid->centre[axis] + reach <= high;
}

void push_add(Push *to, double times, const Push *push)
{
    for (int k = 0; k < 3; k++) {
        to->force[k] += times * push->force[k];
        to->torque[k] += times * push->torque[k];
    }
}

void push_about(Push *push, const double to[3])
{
    const double none[3] = {0}, from[3] = {-to[0], -to[1], -to[2]};
    double force[3];
    for (int k = 0; k < 3; k++)
        force[k] = push->force[k];
    push_at(push, from, force);
    push_at(push, none, (double[3]){-force[0], -force[1], -force[2]});
}

void forces_add(Forces *to, const Forces *sum)
{
    to->seconds += sum->seconds;
    push_add(&to->box, 1, &sum->box);
    for (int k = 0; k < SOLIDS_MAX; k++)
        push_add(&to->solid[k], 1, &sum->solid[k]);
}

void forces_add_mean(Forces *to, const Forces *mean)
{
    to->seconds += mean->seconds;
    push_add(&to->box, mean->seconds, &mean->box);
    for (int k = 0; k < SOLIDS_MAX; k++)
        push_add(&to->solid[k], mean->seconds, &mean->solid[k]);
}

static void scale(Push *push, double factor)
{
    for (int k = 0; k < 3; k++) {
        push->force[k] *= factor;
        push->torque[k] *= factor;
    }
}

void forces_mean(Forces *forces)
{
    const double factor = forces->seconds > 0 ? 1 / forces->seconds : 0;
    scale(&forces->box, factor);
    for (int k = 0; k < SOLIDS_MAX; k++)
        scale(&forces->solid[k], factor);
}
