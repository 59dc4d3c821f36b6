#include "app/scene/scene.h"

#include "app/run/measure/measure.h"
#include "app/scene/scene_private.h"
#include "sim/mesh/mesh_shape.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

char scene_axis_name(int k)
{
    return "xyz"[k];
}

/* True if low..high on axis k lies between the walls, up to rounding. */
static bool scene_between_walls(const SceneCheck *check, const char *path, int k, double low, double high)
{
    const double size = check->scene->world.box_size[k];
    const double wall_low = k == 1 ? 0 : -0.5 * size, wall_high = wall_low + size, slack = 1e-9 * size;
    if (low >= wall_low - slack && high <= wall_high + slack)
        return true;
    return FAIL(check, path,
                "the fluid is outside the box: it reaches from %g to %g m in %c; the box from %g to %g m",
                low, high, scene_axis_name(k), wall_low, wall_high);
}

static bool scene_check_axis(const SceneCheck *check, const char *path, const double axis[3])
{
    return hypot(hypot(axis[0], axis[1]), axis[2]) >= 1e-9 ||
           FAIL(check, path, "the axis has no direction; write one such as [1, 0, 0]");
}

bool scene_check_plane(const SceneCheck *check, const char *path, const double v[3])
{
    return check->scene->world.dimensions == 3 || v[2] == 0 ||
           FAIL(check, path, "the third number must be 0, or left out, in a 2D scene, not %g", v[2]);
}

static double scene_clamp_to_box(const SceneCheck *check, int k, double x)
{
    const double size = check->scene->world.box_size[k], low = k == 1 ? 0 : -0.5 * size;
    return fmin(fmax(x, low), low + size);
}

/* Distance of the point from the box, m. */
static double scene_outside_box(const SceneCheck *check, const double x[3])
{
    const int axes = check->scene->world.dimensions == 2 ? 2 : 3;
    double d2 = 0;
    for (int k = 0; k < axes; k++)
        d2 += pow(x[k] - scene_clamp_to_box(check, k, x[k]), 2);
    return sqrt(d2);
}

bool scene_check_motion(const SceneCheck *check, const char *list, int m, const Motion *motion)
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

/* In two dimensions solids must lie in the plane. */
static bool check_solid_plane(const SceneCheck *check, const SolidDef *solid, const char *path)
{
    char key[96];
    if (check->scene->world.dimensions == 3)
        return true;
    if (solid->kind == SOLID_CYLINDER)
        return FAIL(check, path, "a 2D scene has no cylinders; write a sphere, which is a disc there");
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (solid->kind == SOLID_BOX && solid->angle_deg != 0 && (solid->axis[0] != 0 || solid->axis[1] != 0))
        return FAIL(check, key, "a box in a 2D scene turns about [0, 0, 1]");
    if (solid->kind == SOLID_BOWL && !scene_check_plane(check, key, solid->axis))
        return false;
    snprintf(key, sizeof key, "%s.%s.centre", path, solid_name(solid->kind));
    return scene_check_plane(check, key, solid->centre);
}

/* A floating solid must not have its own motion, and only a floating solid may have a hinge. */
static bool check_floating(const SceneCheck *check, const SolidDef *solid, const char *path)
{
    const WorldDef *world = &check->scene->world;
    const bool hinged = solid->hinge_axis[0] != 0 || solid->hinge_axis[1] != 0 || solid->hinge_axis[2] != 0;
    char density[96], hinge[96], axis[96], at[96];
    snprintf(density, sizeof density, "%s.density", path);
    snprintf(hinge, sizeof hinge, "%s.hinge", path);
    snprintf(axis, sizeof axis, "%s.hinge.axis", path);
    snprintf(at, sizeof at, "%s.hinge.at", path);
    const bool offset = solid->hinge_at[0] != 0 || solid->hinge_at[1] != 0 || solid->hinge_at[2] != 0;
    const YamlNode *node = tree_at(check->tree, hinge);
    if (!hinged && (offset || (node && !node->first)))
        return FAIL(check, hinge, "the hinge has no direction; write its `axis`, such as [0, 0, 1]");
    if (!solid_floats(solid))
        return !hinged ||
               FAIL(check, hinge, "nothing turns a solid without a density; write `density`, in kg/m3");
    if (solid->motion_count > 0)
        return FAIL(check, density,
                    "fluid moves a solid with a density; leave out its motion, or the density");
    if (world->periodic[0] || world->periodic[1] || world->periodic[2])
        return FAIL(check, density, "a solid that floats needs a box with walls; leave out box.periodic");
    if (world->dimensions == 2 && hinged && (solid->hinge_axis[0] != 0 || solid->hinge_axis[1] != 0))
        return FAIL(check, axis, "a hinge in a 2D scene has the axis [0, 0, 1]");
    return !hinged || scene_check_plane(check, at, solid->hinge_at);
}

bool scene_check_solid(const SceneCheck *check, int index)
{
    const SolidDef *solid = &check->scene->world.solids[index];
    char path[64], key[96];
    snprintf(path, sizeof path, "solids[%d]", index);
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (!check_solid_plane(check, solid, path) ||
        (solid->kind != SOLID_SPHERE && !scene_check_axis(check, key, solid->axis)))
        return false;
    if (solid->motion_count == 0 && scene_outside_box(check, solid->centre) > solid_reach(solid))
        return FAIL(check, path, "the solid is outside the box, and does not move; no fluid comes there");
    if (!check_floating(check, solid, path))
        return false;
    snprintf(key, sizeof key, "%s.motion", path);
    for (int m = 0; m < solid->motion_count; m++)
        if (!scene_check_motion(check, key, m, &solid->motions[m]))
            return false;
    return true;
}

double scene_solid_width(const SolidDef *solid, int dimensions)
{
    switch (solid->kind) {
    case SOLID_BOX:
        return fmin(fmin(solid->size[0], solid->size[1]), dimensions == 3 ? solid->size[2] : INFINITY);
    case SOLID_CYLINDER:
        return fmin(2 * solid->radius, solid->height);
    case SOLID_BOWL:
        return solid->thickness;
    case SOLID_MESH:
        return solid->mesh.shape ? 2 * solid->mesh.scale * solid->mesh.shape->depth : INFINITY;
    default:
        return 2 * solid->radius;
    }
}

bool scene_check_widths(const SceneCheck *check)
{
    const WorldDef *world = &check->scene->world;
    for (int k = 0; k < world->solid_count; k++) {
        const SolidDef *solid = &world->solids[k];
        const double width = scene_solid_width(solid, world->dimensions);
        char path[64];
        snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(solid->kind));
        if (!(width >= (1 - 1e-9) * world->spacing)) {
            FAIL(
                check, path,
                "the solid is %g m thin, less than the spacing of %g m; make it thicker (twice the spacing to "
                "keep fluids apart) or use a smaller spacing",
                width, world->spacing);
            return solid->kind == SOLID_MESH && scene_check_scale(check, &solid->mesh);
        }
    }
    return true;
}

static bool check_order(const SceneCheck *check, const char *path, const Fill *fill, int k)
{
    return fill->min[k] < fill->max[k] ||
           FAIL(check, path, "the block's min is not below its max in %c (%g and %g m); swap or move them",
                scene_axis_name(k), fill->min[k], fill->max[k]);
}

static bool check_block(const SceneCheck *check, const Fill *fill, const char *path)
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
static bool check_round(const SceneCheck *check, const Fill *fill, const char *path)
{
    const char *shape = fill->kind == FILL_BALL ? "ball" : fill->kind == FILL_MESH ? "mesh" : "cylinder";
    double low[3], high[3];
    char centre[96];
    fill_bounds(fill, low, high);
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        snprintf(centre, sizeof centre, "%s.%s.centre[%d]", path, shape, k);
        if (!scene_between_walls(check, centre, k, low[k], high[k]))
            return fill->kind == FILL_MESH && scene_check_scale(check, &fill->mesh);
    }
    return true;
}

/* Checks that a point is outside all solids at rest. */
static bool check_out_of_solids(const SceneCheck *check, const char *path, const double x[3])
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

static bool check_emit(const SceneCheck *check, int f, int index)
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

static bool check_formula(const SceneCheck *check, const char *path, const char *text, const char *names)
{
    Error error;
    Formula formula;
    return !formula_given(text) || formula_read(text, names, &formula, &error) ||
           FAIL(check, path, "%s", error.message);
}

/* Checks formulas of heights and velocities. */
static bool check_formulas(const SceneCheck *check, int f)
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

static bool check_fill(const SceneCheck *check, const Fill *fill, const char *path)
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

bool scene_check_fluid(const SceneCheck *check, int f)
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

bool scene_check_drain(const SceneCheck *check, int index)
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

/* Checks probes: column names, and places reachable by fluid. */

static const char *kind_of(const ProbeDef *probe)
{
    static const char *const names[] = {
#define X(NAME, name, help) name,
        PROBE_KIND_LIST(X)
#undef X
    };
    return names[probe->kind];
}

static bool has_column(const ProbeDef *probe, const char *name)
{
    for (int i = 0; i < probe_columns(probe); i++) {
        ProbeColumn column;
        probe_column(probe, i, &column);
        if (strcmp(column.name, name) == 0)
            return true;
    }
    return false;
}

/* Column names must differ: place 1 of a line `wall` is named wall_1, a possible name of a different
   probe. */
static bool check_columns(const SceneCheck *check, const char *path, int index)
{
    const ProbeDef *own = &check->scene->probes.probe[index];
    for (int k = 0; k < index; k++) {
        const ProbeDef *other = &check->scene->probes.probe[k];
        const bool own_line = own->kind == PROBE_LINE, other_line = other->kind == PROBE_LINE;
        const ProbeDef *line = own_line ? own : other, *place = own_line ? other : own;
        for (int i = 0; own_line != other_line && i < probe_columns(place); i++) {
            ProbeColumn column;
            probe_column(place, i, &column);
            if (strncmp(place->name, line->name, strlen(line->name)) == 0 && has_column(line, column.name))
                return FAIL(
                    check, path,
                    "'%s' has a column %s, and so has probes[%d], '%s'; give one of them another name",
                    own->name, column.name, k, other->name);
        }
    }
    return true;
}

static bool check_name(const SceneCheck *check, int index)
{
    const ProbeDef *probe = check->scene->probes.probe;
    const char *name = probe[index].name;
    char path[64];
    snprintf(path, sizeof path, "probes[%d].name", index);
    if (name[strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")])
        return FAIL(check, path, "'%s' cannot be the name of columns; use letters, digits and _", name);
    for (int k = 0; k < index; k++)
        if (strcmp(probe[k].name, name) == 0)
            return FAIL(check, path, "probes[%d] is called '%s' too; give each a name of its own", k, name);
    return check_columns(check, path, index);
}

/* Depth of the point in a solid at rest, m; less than 0: outside all solids. */
static double depth_in_solids(const WorldDef *world, const double x[3])
{
    const float at[3] = {(float)x[0], (float)x[1], (float)x[2]};
    double depth = -1;
    for (int k = 0; k < world->solid_count; k++) {
        SolidPose pose;
        if (solid_moves(&world->solids[k]))
            continue;
        solid_pose_at(&world->solids[k], 0, &pose);
        depth = fmax(depth, -(double)solid_clearance(&world->solids[k], &pose, world->dimensions, at, 1));
    }
    return depth;
}

static bool check_place(const SceneCheck *check, const char *path, const double x[3])
{
    const WorldDef *world = &check->scene->world;
    const double slack = 1e-6 * world->box_size[1];
    if (!scene_check_plane(check, path, x))
        return false;
    if (scene_outside_box(check, x) > slack)
        return FAIL(check, path,
                    "[%g, %g, %g] is outside the box, which reaches from [%g, 0, %g] to [%g, %g, %g]; no "
                    "fluid comes there",
                    x[0], x[1], x[2], -0.5 * world->box_size[0], -0.5 * world->box_size[2],
                    0.5 * world->box_size[0], world->box_size[1], 0.5 * world->box_size[2]);
    if (depth_in_solids(world, x) > fmax(slack, 0.5 * world->spacing))
        return FAIL(check, path, "[%g, %g, %g] is inside a solid; move it to the solid's surface", x[0], x[1],
                    x[2]);
    return true;
}

/* Checks the corners of a plane; errors point at the key of its middle. */
static bool check_plane(const SceneCheck *check, const char *path, const ProbeDef *probe)
{
    char side[80];
    for (int corner = 0; corner < 4; corner++) {
        double x[3];
        for (int k = 0; k < 3; k++)
            x[k] = probe->at[k] + (corner & 1 ? 0.5 : -0.5) * probe->along[k] +
                   (corner & 2 ? 0.5 : -0.5) * probe->across[k];
        if (!check_place(check, path, x))
            return false;
    }
    snprintf(side, sizeof side, "%s.along", path);
    return hypot(hypot(probe->along[0], probe->along[1]), probe->along[2]) > 0 ||
           FAIL(check, side, "the side has no length; write one such as [0.1, 0, 0]");
}

bool scene_check_metrics(const SceneCheck *check)
{
    const Scene *scene = check->scene;
    for (int m = 0; m < scene->metric_count; m++) {
        const bool of_probes = metric_kinds[scene->metrics[m]].numbers == 0;
        if (of_probes && scene->probes.count == 0)
            return FAIL(check, "metrics",
                        "metrics has 'probes', and the scene names none; add `probes`, or "
                        "leave it out");
        if (of_probes && scene->probes.count > METRIC_PROBES)
            return FAIL(check, "metrics", "metrics has 'probes', which compares at most %d probes, not %d",
                        METRIC_PROBES, scene->probes.count);
    }
    return true;
}

static bool check_on(const SceneCheck *check, const char *path, const ProbeDef *probe)
{
    const int solids = check->scene->world.solid_count;
    char on[80];
    snprintf(on, sizeof on, "%s.on", path);
    if (probe_on(probe, solids) >= -1)
        return true;
    if (solids == 0)
        return FAIL(check, on, "'%s' feels no force; the scene has no solid: write box", probe->on);
    return FAIL(check, on, "'%s' feels no force; write box, or solid_0 to solid_%d", probe->on, solids - 1);
}

bool scene_check_probe(const SceneCheck *check, int index)
{
    const ProbeDef *probe = &check->scene->probes.probe[index];
    char path[64], from[80], to[80];
    snprintf(path, sizeof path, "probes[%d].%s", index, kind_of(probe));
    snprintf(from, sizeof from, "%s.%s", path, probe->kind == PROBE_LINE ? "from" : "at");
    snprintf(to, sizeof to, "%s.to", path);
    if (!check_name(check, index))
        return false;
    switch ((ProbeKind)probe->kind) {
    case PROBE_LINE:
        return check_place(check, from, probe->from) && check_place(check, to, probe->to);
    case PROBE_PLANE:
        return check_plane(check, path, probe);
    case PROBE_FORCE:
        return check_on(check, path, probe);
    default:
        return check_place(check, from, probe->at);
    }
}
