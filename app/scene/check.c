#include "app/scene/check_parts.h"

#include <math.h>
#include <stdio.h>

static bool check_range(const Check *check, const char *view, const char *key, bool automatic,
                        const double range[2])
{
    char path[64];
    snprintf(path, sizeof path, "%s.%s", view, key);
    if (!automatic && !(range[0] < range[1]))
        return FAIL(check, path, "the range's low (%g) is not below its high (%g); swap or move them",
                    range[0], range[1]);
    return true;
}

static bool check_view(const Check *check, const char *path, const ViewDef *view)
{
    char camera[64];
    snprintf(camera, sizeof camera, "%s.camera", path);
    if (!check_range(check, path, "range", view->range_auto, view->range) ||
        !check_range(check, path, "opacity.range", view->opacity.range_auto, view->opacity.range) ||
        !check_range(check, path, "size.range", view->size.range_auto, view->size.range))
        return false;
    const double *from = view->camera.from, *to = view->camera.to;
    if (!view->camera_auto && from[0] == to[0] && from[1] == to[1] && from[2] == to[2])
        return FAIL(check, camera, "the camera stands where it looks; move `from` or `to`");
    return true;
}

static bool check_views(const Check *check)
{
    for (int i = 0; i < check->scene->view_count; i++) {
        char path[32];
        snprintf(path, sizeof path, "views[%d]", i);
        if (!check_view(check, path, &check->scene->views[i]))
            return false;
    }
    return check_view(check, "view", &check->scene->view);
}

static bool check_spacing(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    double width = INFINITY;
    for (int k = 0; k < world->dimensions; k++)
        width = fmin(width, world->box_size[k]);
    if (world->spacing > 0.5 * width)
        return FAIL(check, "particles.spacing",
                    "the spacing of %g m is too large for the box; use at most %g m", world->spacing,
                    0.5 * width);
    return true;
}

bool scene_check(const Tree *tree, const Scene *scene, Error *error)
{
    const Check check = {tree, scene, error};
    for (int f = 0; f < scene->world.fluid_count; f++)
        if (!scene_check_fluid(&check, f))
            return false;
    for (int k = 0; k < scene->world.drain_count; k++)
        if (!scene_check_drain(&check, k))
            return false;
    for (int m = 0; m < scene->world.motion_count; m++)
        if (!scene_check_motion(&check, "motion", m, &scene->world.motions[m]))
            return false;
    for (int k = 0; k < scene->world.solid_count; k++)
        if (!scene_check_solid(&check, k))
            return false;
    for (int k = 0; k < scene->probes.count; k++)
        if (!scene_check_probe(&check, k))
            return false;
    return scene_check_plane(&check, "gravity", scene->world.gravity) && check_spacing(&check) &&
           scene_check_lid(&check) && scene_check_metrics(&check) && check_views(&check);
}
