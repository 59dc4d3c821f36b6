#include "app/touch/hold.h"

#include "sim/matter/solid_step.h"

#include <math.h>
#include <string.h>

/* Distance along the ray to the solid, m; INFINITY: no hit. Steps by the distance to the surface. */
static double meets(const SolidDef *solid, const BoxState *pose, int dimensions, const SightRay *ray)
{
    enum { GOES = 256 };
    double way = 0, close = 1e-4 * solid_reach(solid), far = 0;
    for (int k = 0; k < 3; k++)
        far += (pose->position[k] - ray->from[k]) * ray->along[k];
    far += solid_reach(solid);
    for (int i = 0; i < GOES && way <= far; i++) {
        double in_box[3], at[3];
        for (int k = 0; k < 3; k++)
            in_box[k] = ray->from[k] + way * ray->along[k] - pose->position[k];
        quat_rotate_inverse(pose->orientation, in_box, at);
        const double distance = solid_distance(solid, dimensions, at);
        if (distance < close)
            return way;
        way += distance;
    }
    return INFINITY;
}

/* In two dimensions: tests the point where the ray meets the plane of the fluid. */
static double meets_flat(const SolidDef *solid, const BoxState *pose, const SightRay *ray)
{
    static const double across[3] = {0, 0, 1}, origin[3] = {0};
    double at[3], in[3], way = 0;
    if (!sight_ray_plane(ray, origin, across, at))
        return INFINITY;
    for (int k = 0; k < 3; k++) {
        way += (at[k] - ray->from[k]) * ray->along[k];
        in[k] = at[k] - pose->position[k];
    }
    quat_rotate_inverse(pose->orientation, in, in);
    in[2] = 0;
    return solid_distance(solid, 2, in) <= 0 ? way : INFINITY;
}

int hold_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray, double at[3])
{
    double nearest = INFINITY;
    int found = -1;
    for (int i = 0; i < def->solid_count; i++) {
        BoxState pose;
        solid_pose_in(&def->solids[i], time, &floating[i], &pose);
        const double way = def->dimensions == 2 ? meets_flat(&def->solids[i], &pose, ray)
                                                : meets(&def->solids[i], &pose, 3, ray);
        if (way < nearest) {
            nearest = way;
            found = i;
        }
    }
    for (int k = 0; k < 3 && found >= 0; k++)
        at[k] = ray->from[k] + nearest * ray->along[k];
    return found;
}

bool hold_press(Hold *hold, const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                const double forward[3], bool turns)
{
    BoxState part;
    *hold = (Hold){.pressed = true, .turns = turns, .dimensions = def->dimensions};
    hold->solid = hold_under(def, time, floating, ray, hold->from);
    if (hold->solid < 0)
        return false;
    const SolidDef *solid = &def->solids[hold->solid];
    solid_hand_at(&solid->hand, time, &part);
    hold->holds = true;
    hold->reach = solid_reach(solid);
    memcpy(hold->at, part.position, sizeof hold->at);
    memcpy(hold->turn, part.orientation, sizeof hold->turn);
    memcpy(hold->told, hold->at, sizeof hold->told);
    memcpy(hold->spun, hold->turn, sizeof hold->spun);
    memcpy(hold->forward, forward, sizeof hold->forward);
    return true;
}

/* The solid rolls under the mouse like a ball under a hand. */
static void roll(const Hold *hold, const double way[3], double turn[4])
{
    double by[3];
    cross_product(way, hold->forward, by);
    if (hold->dimensions == 2)
        by[0] = by[1] = 0, by[2] = -way[0];
    for (int k = 0; k < 3; k++)
        by[k] /= hold->reach;
    memcpy(turn, hold->turn, sizeof hold->turn);
    quat_turn(by, turn);
}

bool hold_move(Hold *hold, const SightRay *ray, SolidCommand *command)
{
    static const double across[3] = {0, 0, 1};
    double hit[3], way[3];
    if (!hold->holds ||
        !sight_ray_plane(ray, hold->from, hold->dimensions == 2 ? across : hold->forward, hit))
        return false;
    for (int k = 0; k < 3; k++)
        way[k] = hit[k] - hold->from[k];
    *command = (SolidCommand){.act = SOLID_ACT_MOVE, .solid = hold->solid};
    memcpy(command->at, hold->at, sizeof command->at);
    memcpy(command->turn, hold->turn, sizeof command->turn);
    if (hold->turns)
        roll(hold, way, command->turn);
    else
        for (int k = 0; k < 3; k++)
            command->at[k] += way[k];
    bool same = true;
    for (int k = 0; k < 4; k++)
        same &= fabs(command->turn[k] - hold->spun[k]) < 1e-6 &&
                (k == 3 || fabs(command->at[k] - hold->told[k]) < 1e-6 * hold->reach);
    if (same)
        return false;
    memcpy(hold->told, command->at, sizeof hold->told);
    memcpy(hold->spun, command->turn, sizeof hold->spun);
    return true;
}

void hold_release(Hold *hold)
{
    hold->pressed = hold->holds = false;
}
