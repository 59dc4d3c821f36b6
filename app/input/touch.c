#include "app/input/input.h"

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

int solid_drag_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                     double at[3])
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

bool solid_drag_press(SolidDrag *hold, const WorldDef *def, double time, const BoxState *floating,
                      const SightRay *ray, const double forward[3], bool turns)
{
    BoxState part;
    *hold = (SolidDrag){.pressed = true, .turns = turns, .dimensions = def->dimensions};
    hold->solid = solid_drag_under(def, time, floating, ray, hold->from);
    if (hold->solid < 0)
        return false;
    const SolidDef *solid = &def->solids[hold->solid];
    solid_hand_at(&solid->hand, time, &part);
    hold->holds = true;
    hold->reach = solid_reach(solid);
    memcpy(hold->at, part.position, sizeof hold->at);
    memcpy(hold->turn, part.orientation, sizeof hold->turn);
    memcpy(hold->sent, hold->at, sizeof hold->sent);
    memcpy(hold->spun, hold->turn, sizeof hold->spun);
    memcpy(hold->forward, forward, sizeof hold->forward);
    return true;
}

/* The solid rolls under the mouse like a ball under a hand. */
static void roll(const SolidDrag *hold, const double way[3], double turn[4])
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

bool solid_drag_move(SolidDrag *hold, const SightRay *ray, SolidCommand *command)
{
    static const double across[3] = {0, 0, 1};
    double hit[3], way[3];
    if (!hold->holds ||
        !sight_ray_plane(ray, hold->from, hold->dimensions == 2 ? across : hold->forward, hit))
        return false;
    for (int k = 0; k < 3; k++)
        way[k] = hit[k] - hold->from[k];
    *command = (SolidCommand){.act = SOLID_ACTION_MOVE, .solid = hold->solid};
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
                (k == 3 || fabs(command->at[k] - hold->sent[k]) < 1e-6 * hold->reach);
    if (same)
        return false;
    memcpy(hold->sent, command->at, sizeof hold->sent);
    memcpy(hold->spun, command->turn, sizeof hold->spun);
    return true;
}

void solid_drag_release(SolidDrag *hold)
{
    hold->pressed = hold->holds = false;
}

static const double ARROW = 0.08; /* of the box's diagonal */

static Handle arrow(const double size[3], int axis, int side)
{
    static const char *const helps[] = {"the box becomes wider or narrower",
                                        "the box becomes higher or lower",
                                        "the box becomes deeper or shallower"};
    const double length = ARROW * sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    Handle handle = {
        .help = helps[axis], .look = HANDLE_ARROW, .way = HANDLE_ALONG, .from = {0, 0.5 * size[1], 0}};
    handle.from[axis] = axis == 1 ? size[1] : 0.5 * side * size[axis];
    memcpy(handle.at, handle.from, sizeof handle.at);
    handle.at[axis] += side * length;
    handle.axis[axis] = side;
    return handle;
}

int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX])
{
    int count = 0;
    for (int axis = 0; axis < dimensions; axis++)
        for (int side = 1; side >= (axis == 1 ? 1 : -1) && !open[axis]; side -= 2)
            handles[count++] = arrow(size, axis, side);
    return count;
}

void wall_drag(const Handle *taken, const double at[3], double least, double size[3])
{
    int axis = 0;
    while (axis < 2 && taken->axis[axis] == 0)
        axis++;
    const double length = fabs(taken->at[axis] - taken->from[axis]),
                 out = taken->axis[axis] * at[axis] - length;
    size[axis] = fmax(axis == 1 ? out : 2 * out, least);
}

static const double NOTCH = 1.15; /* five notches double the value */

FingerWay touch_tool_other(FingerWay way)
{
    return way == FINGER_PULL ? FINGER_PUSH : FINGER_PULL;
}

void touch_tool_press(TouchTool *tool, FingerWay way, const double at[3])
{
    tool->holds = true;
    tool->way = way;
    memcpy(tool->at, at, sizeof tool->at);
}

void touch_tool_release(TouchTool *tool, bool behind)
{
    if (tool->spent && behind)
        touch_tool_reset(tool);
    tool->holds = tool->spent = false;
}

void touch_tool_reset(TouchTool *tool)
{
    tool->sent = (Finger){.way = FINGER_NONE};
}

void touch_tool_travel(TouchTool *tool, unsigned travels, bool scripted)
{
    if (tool->travels != travels && !tool->scripted)
        tool->spent = tool->holds;
    tool->travels = travels;
    tool->scripted = scripted;
}

bool touch_tool_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions)
{
    static const double across[3] = {0, 0, 1}, origin[3] = {0};
    const bool plane = dimensions == 2;
    double hit[3];
    if (!sight_ray_plane(ray, plane ? origin : tool->at, plane ? across : forward, hit))
        return false;
    memcpy(tool->at, hit, sizeof tool->at);
    return true;
}

static bool same(const Finger *a, const Finger *b)
{
    const bool none = a->way == (double)FINGER_NONE;
    return a->way == b->way &&
           (none || (a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2] &&
                     a->radius == b->radius && a->strength == b->strength));
}

bool touch_tool_finger(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger)
{
    *finger = (Finger){.way = FINGER_NONE};
    if (tool->spent)
        return false;
    if (tool->holds)
        *finger = touch_finger(def, tool->way, tool->at, spacing);
    if (same(finger, &tool->sent))
        return false;
    tool->sent = *finger;
    return true;
}

Handle touch_tool_outline(const TouchTool *tool, const TouchDef *def, double spacing, const double forward[3])
{
    Handle ring = {.look = HANDLE_RING};
    const FingerWay way = tool->holds ? tool->way : (FingerWay)(def->way + 1);
    const double *f = forward, radius = touch_radius(def, way, spacing);
    double beside[3] = {f[2], 0, -f[0]}; /* across `forward`, horizontal */
    const double length = hypot(beside[0], beside[2]);
    if (length < 1e-6)
        memcpy(beside, (double[3]){1, 0, 0}, sizeof beside);
    for (int k = 0; k < 3; k++) {
        const double out = beside[k] / (length < 1e-6 ? 1 : length);
        ring.axis[k] = forward[k];
        ring.from[k] = tool->at[k];
        ring.at[k] = tool->at[k] + radius * out;
    }
    return ring;
}

double touch_tool_notches(double value, double notches, double least, double most)
{
    return fmax(least, fmin(most, value * pow(NOTCH, notches)));
}
