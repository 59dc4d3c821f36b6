#include "app/scene/check_parts.h"
#include "sim/matter/solid_step.h"

#include <math.h>
#include <stdio.h>

char scene_axis_name(int k)
{
    return "xyz"[k];
}

bool scene_between_walls(const Check *check, const char *path, int k, double low, double high)
{
    const double size = check->scene->world.box_size[k];
    const double wall_low = k == 1 ? 0 : -0.5 * size, wall_high = wall_low + size, slack = 1e-9 * size;
    if (low >= wall_low - slack && high <= wall_high + slack)
        return true;
    return FAIL(check, path,
                "the fluid is outside the box: it reaches from %g to %g m in %c; the box from %g to %g m",
                low, high, scene_axis_name(k), wall_low, wall_high);
}

bool scene_check_axis(const Check *check, const char *path, const double axis[3])
{
    return hypot(hypot(axis[0], axis[1]), axis[2]) >= 1e-9 ||
           FAIL(check, path, "the axis has no direction; write one such as [1, 0, 0]");
}

bool scene_check_plane(const Check *check, const char *path, const double v[3])
{
    return check->scene->world.dimensions == 3 || v[2] == 0 ||
           FAIL(check, path, "the third number must be 0, or left out, in a 2D scene, not %g", v[2]);
}

double scene_clamp_to_box(const Check *check, int k, double x)
{
    const double size = check->scene->world.box_size[k], low = k == 1 ? 0 : -0.5 * size;
    return fmin(fmax(x, low), low + size);
}

double scene_outside_box(const Check *check, const double x[3])
{
    double d2 = 0;
    for (int k = 0; k < check->scene->world.dimensions; k++)
        d2 += pow(x[k] - scene_clamp_to_box(check, k, x[k]), 2);
    return sqrt(d2);
}

bool scene_check_motion(const Check *check, const char *list, int m, const Motion *motion)
{
    char path[96];
    snprintf(path, sizeof path, "%s[%d].%s.axis", list, m, motion_name(motion->kind));
    if (!scene_check_axis(check, path, motion->axis))
        return false;
    if (check->scene->world.dimensions == 2 && !motion_in_plane(motion))
        return FAIL(check, path,
                    "the motion leaves the plane of a 2D scene; shake along x and y, turn about [0, 0, 1]");
    return true;
}

/* Checks periodic sides: wide enough, no turns of the box, no solids across. */
bool scene_check_periodic(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    bool any = false;
    char path[64];
    for (int k = 0; k < 3; k++) {
        const double size = world->box_size[k], low = k == 1 ? 0 : -0.5 * size;
        if (!world->periodic[k])
            continue;
        any = true;
        if (k >= world->dimensions)
            return FAIL(check, "box.periodic", "a 2D scene has no sides in z; name x, y or both");
        if (!(size >= 2 * world->support * world->spacing))
            return FAIL(
                check, "box.periodic",
                "along %c the box is %g m wide, less than two support radii (%g m); use a smaller spacing",
                scene_axis_name(k), size, 2 * world->support * world->spacing);
        for (int i = 0; i < world->solid_count; i++) {
            snprintf(path, sizeof path, "solids[%d]", i);
            if (!solid_between(&world->solids[i], world->dimensions, k, low, low + size))
                return FAIL(check, path,
                            "the solid reaches over a periodic side in %c, or may come there; keep it inside",
                            scene_axis_name(k));
        }
    }
    for (int m = 0; any && m < world->motion_count; m++) {
        snprintf(path, sizeof path, "motion[%d]", m);
        if (!motion_translates(&world->motions[m]))
            return FAIL(check, path, "a box with periodic sides does not turn; shake or accelerate it");
    }
    return true;
}

bool scene_check_lid(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    const double *v = world->lid;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0)
        return true;
    if (world->wall_slip != SLIP_NONE)
        return FAIL(check, "box.lid", "the lid drags no fluid that glides along it; add slip: none");
    if (v[1] != 0)
        return FAIL(check, "box.lid", "the lid moves in its plane; its velocity in y must be 0, not %g",
                    v[1]);
    if (world->periodic[1])
        return FAIL(check, "box.lid", "a box that is periodic in y has no lid; leave one of them out");
    return scene_check_plane(check, "box.lid", v);
}
