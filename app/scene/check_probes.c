/* Checks probes: column names, and places reachable by fluid. */
#include "app/metric/metric_list.h"
#include "app/probe/probe.h"
#include "app/scene/check_parts.h"
#include "sim/matter/solid_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
static bool check_columns(const Check *check, const char *path, int index)
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

static bool check_name(const Check *check, int index)
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

static bool check_place(const Check *check, const char *path, const double x[3])
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
static bool check_plane(const Check *check, const char *path, const ProbeDef *probe)
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

bool scene_check_metrics(const Check *check)
{
    const Scene *scene = check->scene;
    for (int m = 0; m < scene->metric_count; m++)
        if (metric_kinds[scene->metrics[m]].numbers == 0 && scene->probes.count == 0)
            return FAIL(check, "metrics",
                        "metrics has 'probes', and the scene names none; add `probes`, or "
                        "leave it out");
    return true;
}

static bool check_on(const Check *check, const char *path, const ProbeDef *probe)
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

bool scene_check_probe(const Check *check, int index)
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
