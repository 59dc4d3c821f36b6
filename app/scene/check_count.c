/* Checks counts of particles and cells against the machine's memory. */
#include "app/base/physical.h"
#include "app/scene/check_parts.h"
#include "render/frame/overlay.h"
#include "render/frame/view.h"
#include "sim/matter/boundary.h"
#include "sim/matter/fill.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"
#include "sim/matter/solid_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static bool too_many(const Check *check, double particles)
{
    return FAIL(
        check, "particles.spacing",
        "about %.3g particles are more than this machine can hold (at most %.3g); use a larger spacing than "
        "%g m",
        particles, fmin(0x1p31 - 1, physical_bytes() / BYTES_A_PARTICLE), check->scene->world.spacing);
}

bool scene_fits_memory(double particles)
{
    return particles < 0x1p31 && particles * BYTES_A_PARTICLE < physical_bytes();
}

/* Checks the count of cells of side h, which cover the whole box, filled or not. */
static bool check_cells(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    const double h = world->support * world->spacing;
    double cells = 1;
    for (int k = 0; k < world->dimensions; k++)
        cells *= world->box_size[k] / h + 3;
    if (cells < 0x1p31 && cells * BYTES_A_CELL < physical_bytes())
        return true;
    return FAIL(
        check, "particles.spacing",
        "the box holds %.3g cells of %g m, more than this machine can; use a larger spacing or a smaller box",
        cells, h);
}

bool scene_check_bounds(const Tree *tree, const Scene *scene, double spacing, Error *error)
{
    const Check check = {tree, scene, error};
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
static bool check_boundary(const Check *check, size_t fluid)
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
    return scene_ask_scale(check, NULL);
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

static bool no_particles(const Check *check, int f)
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
    return scene_ask_scale(check, NULL);
}

/* Checks a view; `path` is the view's place in the scene, for its keys, which begin with "view". */
static bool check_view(const Check *check, const char *path, const ViewDef *view)
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

/* A formula without a value would leave fluid out in silence. */
static bool check_heights(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    for (int f = 0; f < world->fluid_count; f++)
        for (int i = 0; i < world->fluids[f].fill_count; i++) {
            const Fill *fill = &world->fluids[f].fills[i];
            char path[64];
            double at[2];
            snprintf(path, sizeof path, "fluids[%d].fill[%d].below", f, i);
            if (formula_given(fill->below) && seed_lacks_height(world, fill, at))
                return FAIL(check, path, "the height \"%s\" has no value at x %g, z %g m; write one that has",
                            fill->below, at[0], at[1]);
        }
    return true;
}

bool scene_check_count(const Tree *tree, const Scene *scene, Error *error)
{
    const Check check = {tree, scene, error};
    const double spacing = scene->world.spacing;
    if (!scene_check_widths(&check) || !scene_check_periodic(&check) || !check_boundary(&check, 0) ||
        !check_views(&check))
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
