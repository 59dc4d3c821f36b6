#include "app/scene/check_parts.h"
#include "app/scene/tables.h"
#include "sim/matter/fill.h"
#include "sim/matter/solid_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool check_order(const Check *check, const char *path, const Fill *fill, int k)
{
    return fill->min[k] < fill->max[k] ||
           FAIL(check, path, "the block's min is not below its max in %c (%g and %g m); swap or move them",
                scene_axis_name(k), fill->min[k], fill->max[k]);
}

static bool check_block(const Check *check, const Fill *fill, const char *path)
{
    char corner[96];
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        const double size = check->scene->world.box_size[k];
        const bool low_out = fill->min[k] < (k == 1 ? 0 : -0.5 * size) - 1e-9 * size;
        snprintf(corner, sizeof corner, "%s.block.max[%d]", path, k);
        if (!check_order(check, corner, fill, k))
            return false;
        snprintf(corner, sizeof corner, "%s.block.%s[%d]", path, low_out ? "min" : "max", k);
        if (!scene_between_walls(check, corner, k, fill->min[k], fill->max[k]))
            return false;
    }
    return true;
}

/* Checks a ball, a cylinder or a mesh. */
static bool check_round(const Check *check, const Fill *fill, const char *path)
{
    const char *shape = fill->kind == FILL_BALL ? "ball" : fill->kind == FILL_MESH ? "mesh" : "cylinder";
    double low[3], high[3];
    char centre[96];
    fill_bounds(fill, low, high);
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        snprintf(centre, sizeof centre, "%s.%s.centre[%d]", path, shape, k);
        if (!scene_between_walls(check, centre, k, low[k], high[k]))
            return fill->kind == FILL_MESH && scene_ask_scale(check, &fill->mesh);
    }
    return true;
}

/* Checks that a point is outside all solids at rest. */
static bool check_out_of_solids(const Check *check, const char *path, const double x[3])
{
    const WorldDef *world = &check->scene->world;
    for (int k = 0; k < world->solid_count; k++) {
        SolidPose pose;
        const float at[3] = {(float)x[0], (float)x[1], (float)x[2]};
        solid_pose_at(&world->solids[k], 0, &pose);
        if (!solid_moves(&world->solids[k]) &&
            solid_clearance(&world->solids[k], &pose, world->dimensions, at, 0) < 0)
            return FAIL(check, path, "the emitter is inside solids[%d]; move one of them", k);
    }
    return true;
}

static bool check_emit(const Check *check, int f, int index)
{
    const Emit *emit = &check->scene->world.fluids[f].emits[index];
    const double *d = emit->direction;
    char path[64], key[96];
    snprintf(path, sizeof path, "fluids[%d].emit[%d].disk", f, index);
    const double norm = hypot(hypot(d[0], d[1]), d[2]);
    snprintf(key, sizeof key, "%s.direction", path);
    if (norm < 1e-9)
        return FAIL(check, key, "the direction has no length; write one such as [0, -1, 0]");
    if (!scene_check_plane(check, key, d) || !scene_check_plane(check, path, emit->centre))
        return false;
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        const double half = emit->radius * sqrt(fmax(0, 1 - d[k] * d[k] / (norm * norm)));
        const bool centre_out = emit->centre[k] != scene_clamp_to_box(check, k, emit->centre[k]);
        snprintf(key, sizeof key, centre_out ? "%s.centre[%d]" : "%s.radius", path, k);
        if (!scene_between_walls(check, key, k, emit->centre[k] - half, emit->centre[k] + half))
            return false;
    }
    snprintf(key, sizeof key, "%s.centre", path);
    return check_out_of_solids(check, key, emit->centre);
}

static bool check_formula(const Check *check, const char *path, const char *text, const char *names)
{
    Error error;
    Formula formula;
    return !formula_given(text) || formula_read(text, names, &formula, &error) ||
           FAIL(check, path, "%s", error.message);
}

/* Checks formulas of heights and velocities. */
static bool check_formulas(const Check *check, int f)
{
    const FluidDef *fluid = &check->scene->world.fluids[f];
    char path[64];
    for (int k = 0; k < 3; k++) {
        snprintf(path, sizeof path, "fluids[%d].velocity_formula.%c", f, scene_axis_name(k));
        if (k >= check->scene->world.dimensions && formula_given(fluid->flow[k]))
            return FAIL(check, path, "a 2D scene has no z; leave it out");
        if (!check_formula(check, path, fluid->flow[k], "xyz"))
            return false;
    }
    for (int i = 0; i < fluid->fill_count; i++) {
        snprintf(path, sizeof path, "fluids[%d].fill[%d].below", f, i);
        if (!scene_names_table(fluid->fills[i].below) &&
            !check_formula(check, path, fluid->fills[i].below, "xz"))
            return false;
    }
    return true;
}

static bool check_fill(const Check *check, const Fill *fill, const char *path)
{
    char axis[96];
    if (!scene_check_plane(check, path, fill->min) || !scene_check_plane(check, path, fill->max) ||
        !scene_check_plane(check, path, fill->centre))
        return false;
    if (fill->kind == FILL_BLOCK)
        return check_block(check, fill, path);
    snprintf(axis, sizeof axis, "%s.%s.axis", path, fill->kind == FILL_MESH ? "mesh" : "cylinder");
    if (fill->kind == FILL_CYLINDER && check->scene->world.dimensions == 2)
        return FAIL(check, path, "a 2D scene has no cylinders; write a ball, which is a disc there");
    return (fill->kind == FILL_BALL || scene_check_axis(check, axis, fill->axis)) &&
           check_round(check, fill, path);
}

bool scene_check_fluid(const Check *check, int f)
{
    const FluidDef *fluid = &check->scene->world.fluids[f];
    char path[64];
    for (int other = 0; other < f; other++) {
        snprintf(path, sizeof path, "fluids[%d].name", f);
        if (strcmp(fluid->name, check->scene->world.fluids[other].name) == 0)
            return FAIL(check, path, "two fluids have the name '%s'; give each its own", fluid->name);
    }
    snprintf(path, sizeof path, "fluids[%d].velocity", f);
    if (!scene_check_plane(check, path, fluid->velocity))
        return false;
    for (int i = 0; i < fluid->fill_count; i++) {
        snprintf(path, sizeof path, "fluids[%d].fill[%d]", f, i);
        if (!check_fill(check, &fluid->fills[i], path))
            return false;
    }
    if (!check_formulas(check, f))
        return false;
    for (int i = 0; i < fluid->emit_count; i++)
        if (!check_emit(check, f, i))
            return false;
    snprintf(path, sizeof path, "fluids[%d]", f);
    return fluid->fill_count + fluid->emit_count > 0 ||
           FAIL(check, path, "the fluid '%s' is nowhere; give it `fill` or `emit`", fluid->name);
}

bool scene_check_drain(const Check *check, int index)
{
    const Fill *drain = &check->scene->world.drains[index];
    char path[96];
    for (int k = 0; k < check->scene->world.dimensions && drain->kind == FILL_BLOCK; k++) {
        snprintf(path, sizeof path, "drains[%d].block.max[%d]", index, k);
        if (!check_order(check, path, drain, k))
            return false;
    }
    snprintf(path, sizeof path, "drains[%d]", index);
    double nearest[3], reach = drain->kind == FILL_BALL ? drain->radius : 0;
    for (int k = 0; k < 3; k++)
        nearest[k] =
            drain->kind == FILL_BALL
                ? drain->centre[k]
                : fmin(fmax(scene_clamp_to_box(check, k, drain->min[k]), drain->min[k]), drain->max[k]);
    return scene_outside_box(check, nearest) <= reach ||
           FAIL(check, path, "the drain is outside the box; no fluid comes there");
}
