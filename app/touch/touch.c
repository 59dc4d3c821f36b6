#include "app/touch/touch.h"

#include <math.h>
#include <string.h>

static const double NOTCH = 1.15; /* five notches double the value */

FingerWay touch_other(FingerWay way)
{
    return way == FINGER_PULL ? FINGER_PUSH : FINGER_PULL;
}

void touch_press(TouchTool *tool, FingerWay way, const double at[3])
{
    tool->holds = true;
    tool->way = way;
    memcpy(tool->at, at, sizeof tool->at);
}

void touch_release(TouchTool *tool, bool behind)
{
    if (tool->spent && behind)
        touch_forget(tool);
    tool->holds = tool->spent = false;
}

void touch_forget(TouchTool *tool)
{
    tool->told = (Finger){.way = FINGER_NONE};
}

void touch_travel(TouchTool *tool, unsigned travels, bool scripted)
{
    if (tool->travels != travels && !tool->scripted)
        tool->spent = tool->holds;
    tool->travels = travels;
    tool->scripted = scripted;
}

bool touch_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions)
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

bool touch_asks(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger)
{
    *finger = (Finger){.way = FINGER_NONE};
    if (tool->spent)
        return false;
    if (tool->holds)
        *finger = touch_finger(def, tool->way, tool->at, spacing);
    if (same(finger, &tool->told))
        return false;
    tool->told = *finger;
    return true;
}

Handle touch_ring(const TouchTool *tool, const TouchDef *def, double spacing, const double forward[3])
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

double touch_notches(double value, double notches, double least, double most)
{
    return fmax(least, fmin(most, value * pow(NOTCH, notches)));
}
