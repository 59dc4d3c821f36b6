#include "app/base/program.h"
#include "app/scene/scene_private.h"
#include "render/frame/view.h"
#include "render/renderer.h"
#include "sim/flow/flow.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"
#include "sim/state.h"
#include "sim/step/backend.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Checks periodic sides: wide enough, no turns of the box, no solids across. */
static bool scene_check_periodic(const SceneCheck *check)
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

static bool scene_check_lid(const SceneCheck *check)
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

/* Checks counts of particles and cells against the machine's memory. */

enum { BYTES_A_PARTICLE = 300, BYTES_A_CELL = 8 };

double scene_fluid_volume(const Scene *scene)
{
    double volume = 0;
    for (int f = 0; f < scene->world.fluid_count; f++)
        for (int i = 0; i < scene->world.fluids[f].fill_count; i++)
            volume += fill_volume(&scene->world.fluids[f].fills[i], scene->world.dimensions);
    return volume;
}

/* Count of lattice points visited by counting: the points of the block around each fill. */
static double points_walked(const WorldDef *world, double spacing)
{
    double sum = 0;
    for (int f = 0; f < world->fluid_count; f++)
        for (int i = 0; i < world->fluids[f].fill_count; i++) {
            const Fill *fill = &world->fluids[f].fills[i];
            double points = 1, low[3], high[3];
            fill_bounds(fill, low, high);
            for (int k = 0; k < world->dimensions; k++)
                points *= (high[k] - low[k]) / spacing + 2;
            sum += points;
        }
    return sum;
}

static bool too_many(const SceneCheck *check, double particles)
{
    return FAIL(
        check, "particles.spacing",
        "about %.3g particles are more than this machine can hold (at most %.3g); use a larger spacing than "
        "%g m",
        particles, fmin(0x1p31 - 1, memory_bytes() / BYTES_A_PARTICLE), check->scene->world.spacing);
}

bool scene_fits_memory(double particles)
{
    return particles < 0x1p31 && particles * BYTES_A_PARTICLE < memory_bytes();
}

/* Checks the count of cells of side h, which cover the whole box, filled or not. */
static bool check_cells(const SceneCheck *check)
{
    const WorldDef *world = &check->scene->world;
    const double h = world->support * world->spacing;
    double cells = 1;
    for (int k = 0; k < world->dimensions; k++)
        cells *= world->box_size[k] / h + 3;
    if (cells < 0x1p31 && cells * BYTES_A_CELL < memory_bytes())
        return true;
    return FAIL(
        check, "particles.spacing",
        "the box holds %.3g cells of %g m, more than this machine can; use a larger spacing or a smaller box",
        cells, h);
}

bool scene_check_bounds(const YamlTree *tree, const Scene *scene, double spacing, Error *error)
{
    const SceneCheck check = {tree, scene, error};
    double most = 0;
    for (int f = 0; f < scene->world.fluid_count; f++)
        for (int i = 0; i < scene->world.fluids[f].fill_count; i++)
            most = fmax(most, fill_volume(&scene->world.fluids[f].fills[i], scene->world.dimensions));
    most /= pow(spacing, scene->world.dimensions);
    if (!scene_fits_memory(0.5 * most)) /* half: rounding to the lattice can lose at most half of many */
        return too_many(&check, scene_fluid_volume(scene) / (spacing * spacing * spacing));
    if (points_walked(&scene->world, spacing) > 0x1p30) /* for example a wide fill thinner than a spacing */
        return too_many(&check, points_walked(&scene->world, spacing));
    return true;
}

/* Checks memory for boundary particles, stored with the `fluid` particles. */
static bool check_boundary(const SceneCheck *check, size_t fluid)
{
    const WorldDef *world = &check->scene->world;
    double sum = 0;
    for (int k = 0; k < world->solid_count; k++)
        sum += boundary_estimate(&world->solids[k], world->dimensions, world->spacing,
                                 world->support * world->spacing);
    if (sum <= 0 || scene_fits_memory(sum + (double)flow_capacity(world, fluid)))
        return true;
    FAIL(
        check, "solids",
        "the solids' surfaces need about %.3g particles of their own, more than this machine can hold; use a "
        "larger spacing or smaller solids",
        sum);
    return scene_check_scale(check, NULL);
}

/* Whether the solid holds a lattice of 3 x 3 x 3 places from corner to corner. */
static bool holds_block(const WorldDef *world, const SolidDef *solid, const double low[3],
                        const double high[3])
{
    SolidPose pose;
    solid_pose_at(solid, 0, &pose);
    for (int n = 0; n < 27; n++) {
        const int at[3] = {n % 3, n / 3 % 3, n / 9};
        float x[3];
        for (int k = 0; k < 3; k++)
            x[k] = (float)(low[k] + 0.5 * at[k] * (high[k] - low[k]));
        if (solid_clearance(solid, &pose, world->dimensions, x, 0) >= 0)
            return false;
    }
    return true;
}

/* The solid around all of a fluid's fills; -1: none. */
static int covering(const WorldDef *world, const FluidDef *fluid)
{
    for (int k = 0; k < world->solid_count; k++) {
        bool all = true;
        for (int i = 0; i < fluid->fill_count && all; i++) {
            double low[3], high[3];
            fill_bounds(&fluid->fills[i], low, high);
            all = holds_block(world, &world->solids[k], low, high);
        }
        if (all)
            return k;
    }
    return -1;
}

static bool no_particles(const SceneCheck *check, int f)
{
    const WorldDef *world = &check->scene->world;
    const FluidDef *fluid = &world->fluids[f];
    const int k = covering(world, fluid);
    char path[64];
    snprintf(path, sizeof path, "fluids[%d].fill", f);
    if (k >= 0)
        FAIL(check, path,
             "the fluid '%s' has no particles: its fills lie within solids[%d]; move one of them",
             fluid->name, k);
    else
        FAIL(
            check, path,
            "the fluid '%s' has no particles: its fills hold no point of the lattice of spacing %g m that is "
            "free; use a smaller spacing or larger fills",
            fluid->name, world->spacing);
    return scene_check_scale(check, NULL);
}

/* Checks a view; `path` is the view's place in the scene, for its keys, which begin with "view". */
static bool check_view_size(const SceneCheck *check, const char *path, const ViewDef *view)
{
    const ViewKind *kind = view_find(view->kind);
    const Subject subject = {view, &check->scene->world};
    const char *key = "view.kind";
    char at[128];
    Error error;
    const bool drawn = !kind || !kind->check || kind->check(&subject, &key, &error);
    if (drawn && overlays_check(&subject, &key, &error))
        return true;
    snprintf(at, sizeof at, "%s%s", path, key + strlen("view"));
    return FAIL(check, at, "%s", error.message);
}

static bool check_view_sizes(const SceneCheck *check)
{
    for (int i = 0; i < check->scene->view_count; i++) {
        char path[32];
        snprintf(path, sizeof path, "views[%d]", i);
        if (!check_view_size(check, path, &check->scene->views[i]))
            return false;
    }
    return check_view_size(check, "view", &check->scene->view);
}

/* A formula without a value would leave fluid out in silence. */
static bool check_heights(const SceneCheck *check)
{
    const WorldDef *world = &check->scene->world;
    int fluid, index;
    double at[2];
    if (!seed_lacks_height(world, &fluid, &index, at))
        return true;
    char path[64];
    snprintf(path, sizeof path, "fluids[%d].fill[%d].below", fluid, index);
    return FAIL(check, path, "the height \"%s\" has no value at x %g, z %g m; write one that has",
                world->fluids[fluid].fills[index].below, at[0], at[1]);
}

bool scene_check_count(const YamlTree *tree, const Scene *scene, Error *error)
{
    const SceneCheck check = {tree, scene, error};
    const double spacing = scene->world.spacing;
    if (!scene_check_widths(&check) || !scene_check_periodic(&check) || !check_boundary(&check, 0) ||
        !check_view_sizes(&check))
        return false;
    if (!scene_check_bounds(tree, scene, spacing, error) || !check_cells(&check))
        return false;
    size_t all = 0, counts[FLUIDS_MAX];
    if (!check_heights(&check))
        return false;
    seed_counts(&scene->world, counts);
    for (int f = 0; f < scene->world.fluid_count; f++) {
        all += counts[f];
        if (!scene_fits_memory((double)all))
            return too_many(&check, (double)all);
        if (counts[f] == 0 && scene->world.fluids[f].fill_count > 0)
            return no_particles(&check, f);
    }
    if (!check_boundary(&check, all))
        return false;
    if (!flow_emits(&scene->world))
        return true;
    if (!scene_fits_memory(scene->world.most))
        return FAIL(&check, "particles.most", "%d particles are more than this machine can hold; use fewer",
                    scene->world.most);
    return all <= (size_t)scene->world.most ||
           FAIL(
               &check, "particles.most",
               "the fills alone hold %zu particle%s, more than the %d that emitters may fill up to; raise it",
               all, plural(all), scene->world.most);
}

static bool check_range(const SceneCheck *check, const char *view, const char *key, bool automatic,
                        const double range[2])
{
    char path[64];
    snprintf(path, sizeof path, "%s.%s", view, key);
    if (!automatic && !(range[0] < range[1]))
        return FAIL(check, path, "the range's low (%g) is not below its high (%g); swap or move them",
                    range[0], range[1]);
    return true;
}

/* Of FILE_SCALAR_LIST; whether a file has them is known to its reader. */
#define FILE_SCALARS (PARTICLE_SCALAR(SCALAR_BORN) - PARTICLE_SCALAR(SCALAR_COLUMN_1))

/* The first scalar read by the view that no state of the world has; SCALAR_COUNT: none. Accelerations always
   exist, as they are computed on request. */
static Scalar missing_scalar(const ViewDef *view, const WorldDef *world, bool recorded)
{
    const uint32_t lacks = renderer_attributes(view) & (PARTICLE_SCALAR(SCALAR_STATE_COUNT) - 1) &
                           ~(columns_scalars(world) | 7U * PARTICLE_SCALAR(SCALAR_ACCELERATION_X) |
                             PARTICLE_SCALAR(SCALAR_BORN) | (recorded ? FILE_SCALARS : 0));
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

static bool check_scalars(const SceneCheck *check, const char *view, const ViewDef *def)
{
    const WorldDef *world = &check->scene->world;
    const Scalar lacks = missing_scalar(def, world, check->scene->recorded);
    char path[64], has[256] = "";
    if (lacks == SCALAR_COUNT)
        return true;
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (columns_scalars(world) & PARTICLE_SCALAR(s))
            snprintf(has + strlen(has), sizeof has - strlen(has), "%s%s", *has ? ", " : "",
                     scalar_name((Scalar)s));
    snprintf(path, sizeof path, "%s.%s", view, key_of(def, lacks));
    for (const Backend *const *backend = backend_list(); *backend; backend++)
        if ((*backend)->scalars & PARTICLE_SCALAR(lacks))
            return FAIL(check, path,
                        "only particles of backend %s have %s; set solver.backend or leave it out",
                        (*backend)->name, scalar_name(lacks));
    if (PARTICLE_SCALAR(lacks) & FILE_SCALARS)
        return FAIL(check, path, "%s is of files of other programs; a scene has no such column",
                    scalar_name(lacks));
    return FAIL(check, path, "particles of this scene have no %s; solver.method %s keeps %s",
                scalar_name(lacks), world->method, *has ? has : "nothing of its own");
}

static bool check_view(const SceneCheck *check, const char *path, const ViewDef *view)
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
static bool check_source(const SceneCheck *check, const char *path, const ViewDef *view)
{
    char key[64];
    snprintf(key, sizeof key, "%s.set", path);
    if (view->file && view->set)
        return FAIL(check, key,
                    "%s has `file` and `set`, a recorded run and what is simulated; leave one out", path);
    for (const char *line = text_or_empty(view->set); *line; line += strcspn(line, "\n"), line += *line != 0)
        if (strncmp(line, "view", strlen("view")) == 0)
            return FAIL(check, key, "%s: %.*s is no setting of what is simulated; write it beside `set`", key,
                        (int)strcspn(line, "="), line);
    return true;
}

static bool check_sources(const SceneCheck *check)
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
        files += scene->views[i].file != NULL;
        if (!check_source(check, path, &scene->views[i]))
            return false;
    }
    return files == 0 || files < scene->view_count ||
           FAIL(check, "views",
                "each entry of views has a `file`; leave it out of one, which shows the scene");
}

/* Checks the camera's keyframes in order. */
static bool check_path(const SceneCheck *check, const char *path, const ViewDef *view)
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

static bool check_views(const SceneCheck *check)
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

static bool check_spacing(const SceneCheck *check)
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

static bool check_fluids(const SceneCheck *check)
{
    for (int f = 0; f < check->scene->world.fluid_count; f++)
        if (!scene_check_fluid(check, f))
            return false;
    return true;
}

static bool check_drains(const SceneCheck *check)
{
    for (int k = 0; k < check->scene->world.drain_count; k++)
        if (!scene_check_drain(check, k))
            return false;
    return true;
}

static bool check_motions(const SceneCheck *check)
{
    for (int m = 0; m < check->scene->world.motion_count; m++)
        if (!scene_check_motion(check, "motion", m, &check->scene->world.motions[m]))
            return false;
    return true;
}

static bool check_solids(const SceneCheck *check)
{
    for (int k = 0; k < check->scene->world.solid_count; k++)
        if (!scene_check_solid(check, k))
            return false;
    return true;
}

static bool check_probes(const SceneCheck *check)
{
    for (int k = 0; k < check->scene->probes.count; k++)
        if (!scene_check_probe(check, k))
            return false;
    return true;
}

static bool check_gravity(const SceneCheck *check)
{
    return scene_check_plane(check, "gravity", check->scene->world.gravity);
}

/* The rules of a scene, each with the first parts of the paths of all read keys. */
static const struct {
    const char *reads;
    bool (*holds)(const SceneCheck *check);
} rules[] = {
    {" fluids box solids ", check_fluids},
    {" drains box ", check_drains},
    {" motion box ", check_motions},
    {" solids box ", check_solids},
    {" probes box solids particles ", check_probes},
    {" gravity box ", check_gravity},
    {" particles box ", check_spacing},
    {" box ", scene_check_lid},
    {" metrics probes ", scene_check_metrics},
    {" view views solver ", check_views},
};
enum { RULES = sizeof rules / sizeof *rules };

bool scene_check(const YamlTree *tree, const Scene *scene, Error *error)
{
    const SceneCheck check = {tree, scene, error};
    for (int i = 0; i < RULES; i++)
        if (!rules[i].holds(&check))
            return false;
    return true;
}

bool scene_check_key(const Scene *scene, const char *path)
{
    YamlNode root = {.kind = NODE_MAPPING};
    const YamlTree tree = {.path = "", .root = &root};
    char part[64];
    Error error;
    const SceneCheck check = {&tree, scene, &error};
    snprintf(part, sizeof part, " %.*s ", (int)strcspn(path, ".["), path);
    for (int i = 0; i < RULES; i++)
        if (strstr(rules[i].reads, part) && !rules[i].holds(&check))
            return false;
    return true;
}
