#include "app/scene/check_parts.h"

#include "render/renderer.h"
#include "sim/gl/particle_buffers.h"
#include "sim/world/column.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* The first scalar read by the view that no state of the world has; SCALAR_COUNT: none. Accelerations always
   exist, as they are computed on request. */
static Scalar missing_scalar(const ViewDef *view, const WorldDef *world)
{
    const uint32_t lacks = renderer_attributes(view) & (PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1) &
                           ~(columns_scalars(world) | 7U * PARTICLE_SCALAR(SCALAR_ACCELERATION_X) |
                             PARTICLE_SCALAR(SCALAR_BORN));
    int s = SCALAR_OWN;
    while (s < SCALAR_STATE_COUNT && !(lacks & PARTICLE_SCALAR(s)))
        s++;
    return s < SCALAR_STATE_COUNT ? (Scalar)s : SCALAR_COUNT;
}

/* The view's key that names the scalar. */
static const char *key_of(const ViewDef *view, Scalar scalar)
{
    return view_color_by(view) == scalar                                        ? "color_by"
           : view->opacity.by != 0 && scalar_of_curve(&view->opacity) == scalar ? "opacity.by"
           : view->size.by != 0 && scalar_of_curve(&view->size) == scalar       ? "size.by"
                                                                                : "glyphs.vector";
}

static bool check_scalars(const Check *check, const char *view, const ViewDef *def)
{
    const WorldDef *world = &check->scene->world;
    const Scalar lacks = missing_scalar(def, world);
    char path[64], has[256] = "";
    if (lacks == SCALAR_COUNT)
        return true;
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (columns_scalars(world) & PARTICLE_SCALAR(s))
            snprintf(has + strlen(has), sizeof has - strlen(has), "%s%s", *has ? ", " : "",
                     scalar_name((Scalar)s));
    snprintf(path, sizeof path, "%s.%s", view, key_of(def, lacks));
    return FAIL(check, path, "particles of this scene have no %s; solver.method %s keeps %s",
                scalar_name(lacks), world->method, *has ? has : "nothing of its own");
}

static bool check_view(const Check *check, const char *path, const ViewDef *view)
{
    char camera[64];
    snprintf(camera, sizeof camera, "%s.camera", path);
    if (!check_range(check, path, "range", view->range_auto, view->range) ||
        !check_range(check, path, "opacity.range", view->opacity.range_auto, view->opacity.range) ||
        !check_range(check, path, "size.range", view->size.range_auto, view->size.range) ||
        (scene_shows(check->scene, view) && !check_scalars(check, path, view)))
        return false;
    const double *from = view->camera.from, *to = view->camera.to;
    if (!view->camera_auto && from[0] == to[0] && from[1] == to[1] && from[2] == to[2])
        return FAIL(check, camera, "the camera stands where it looks; move `from` or `to`");
    return true;
}

/* Checks the keys for the source of states, allowed only in entries of `views`. */
static bool check_source(const Check *check, const char *path, const ViewDef *view)
{
    char key[64];
    snprintf(key, sizeof key, "%s.set", path);
    if (*view->file && *view->set)
        return FAIL(check, key,
                    "%s has `file` and `set`, a recorded run and what is simulated; leave one out", path);
    for (const char *line = view->set; *line; line += strcspn(line, "\n"), line += *line != 0)
        if (strncmp(line, "view", strlen("view")) == 0)
            return FAIL(check, key, "%s: %.*s is no setting of what is simulated; write it beside `set`", key,
                        (int)strcspn(line, "="), line);
    return true;
}

static bool check_sources(const Check *check)
{
    const Scene *scene = check->scene;
    static const char *const keys[] = {"view.file", "view.set"};
    int files = 0;
    for (int i = 0; i < 2; i++)
        if (tree_at(check->tree, keys[i]))
            return FAIL(check, keys[i], "%s is for entries of views: views: [{}, {%s: ...}]", keys[i],
                        keys[i] + strlen("view."));
    for (int i = 0; i < scene->view_count; i++) {
        char path[32];
        snprintf(path, sizeof path, "views[%d]", i);
        files += *scene->views[i].file != 0;
        if (!check_source(check, path, &scene->views[i]))
            return false;
    }
    return files == 0 || files < scene->view_count ||
           FAIL(check, "views",
                "each entry of views has a `file`; leave it out of one, which shows the scene");
}

/* Checks the camera's keyframes in order. */
static bool check_path(const Check *check, const char *path, const ViewDef *view)
{
    for (int i = 0; i < view->camera_path_count; i++) {
        char key[64];
        snprintf(key, sizeof key, "%s.camera_path[%d].to", path, i);
        const double *from = view->camera_path[i].at.from, *to = view->camera_path[i].at.to;
        if (from[0] == to[0] && from[1] == to[1] && from[2] == to[2])
            return FAIL(check, key, "the camera stands where it looks; move `from` or `to`");
        snprintf(key, sizeof key, "%s.camera_path[%d].time", path, i);
        if (i > 0 && view->camera_path[i].time <= view->camera_path[i - 1].time)
            return FAIL(check, key, "%s must be later than that of the keyframe before, %g s", key,
                        view->camera_path[i - 1].time);
    }
    return true;
}

static bool check_views(const Check *check)
{
    if (!check_sources(check))
        return false;
    for (int i = 0; i < check->scene->view_count; i++) {
        char path[32];
        snprintf(path, sizeof path, "views[%d]", i);
        if (!check_view(check, path, &check->scene->views[i]) ||
            !check_path(check, path, &check->scene->views[i]))
            return false;
    }
    return check_path(check, "view", &check->scene->view) && check_view(check, "view", &check->scene->view);
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
