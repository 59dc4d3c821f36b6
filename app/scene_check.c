#include "app/scene_check.h"

#include "render/volume.h"
#include "sim/boundary.h"
#include "sim/flow.h"
#include "sim/seed.h"
#include "sim/solid_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { BYTES_A_PARTICLE = 300, BYTES_A_CELL = 8 };

/* A scene under examination. */
typedef struct Check {
    const Tree *tree;
    const Scene *scene;
    Error *error;
} Check;

/* Points at the node of `path`, or at the nearest that is there. */
#define FAIL(check, path, ...)                                                                               \
    tree_error((check)->tree, tree_near((check)->tree, path), (check)->error, __VA_ARGS__)

static const char axis_name[] = "xyz";

/* Whether low..high on axis k lies between the walls, up to rounding. */
static bool between_walls(const Check *check, const char *path, int k, double low, double high)
{
    const double size = check->scene->world.box_size[k];
    const double wall_low = k == 1 ? 0 : -0.5 * size, wall_high = wall_low + size, slack = 1e-9 * size;
    if (low >= wall_low - slack && high <= wall_high + slack)
        return true;
    return FAIL(check, path,
                "the fluid is outside the box: it reaches from %g to %g m in %c; the box from %g to %g m",
                low, high, axis_name[k], wall_low, wall_high);
}

static bool check_order(const Check *check, const char *path, const Fill *fill, int k)
{
    return fill->min[k] < fill->max[k] ||
           FAIL(check, path, "the block's min is not below its max in %c (%g and %g m); swap or move them",
                axis_name[k], fill->min[k], fill->max[k]);
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
        if (!between_walls(check, corner, k, fill->min[k], fill->max[k]))
            return false;
    }
    return true;
}

/* A ball or a cylinder. */
static bool check_round(const Check *check, const Fill *fill, const char *path)
{
    const char *shape = fill->kind == FILL_BALL ? "ball" : "cylinder";
    double low[3], high[3];
    char centre[96];
    fill_bounds(fill, low, high);
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        snprintf(centre, sizeof centre, "%s.%s.centre[%d]", path, shape, k);
        if (!between_walls(check, centre, k, low[k], high[k]))
            return false;
    }
    return true;
}

static bool check_axis(const Check *check, const char *path, const double axis[3])
{
    return hypot(hypot(axis[0], axis[1]), axis[2]) >= 1e-9 ||
           FAIL(check, path, "the axis has no direction; write one such as [1, 0, 0]");
}

/* In two dimensions nothing may point out of the plane. */
static bool check_plane(const Check *check, const char *path, const double v[3])
{
    return check->scene->world.dimensions == 3 || v[2] == 0 ||
           FAIL(check, path, "the third number must be 0, or left out, in a 2D scene, not %g", v[2]);
}

static double clamp_to_box(const Check *check, int k, double x)
{
    const double size = check->scene->world.box_size[k], low = k == 1 ? 0 : -0.5 * size;
    return fmin(fmax(x, low), low + size);
}

/* How far the point is from the box, m. */
static double outside_box(const Check *check, const double x[3])
{
    double d2 = 0;
    for (int k = 0; k < check->scene->world.dimensions; k++)
        d2 += pow(x[k] - clamp_to_box(check, k, x[k]), 2);
    return sqrt(d2);
}

/* Of the solids that stand still. */
static bool check_out_of_solids(const Check *check, const char *path, const double x[3])
{
    const WorldDef *world = &check->scene->world;
    for (int k = 0; k < world->solid_count; k++) {
        SolidPose pose;
        const float at[3] = {(float)x[0], (float)x[1], (float)x[2]};
        solid_pose_at(&world->solids[k], 0, &pose);
        if (world->solids[k].motion_count == 0 &&
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
    if (!check_plane(check, key, d) || !check_plane(check, path, emit->centre))
        return false;
    for (int k = 0; k < check->scene->world.dimensions; k++) {
        const double half = emit->radius * sqrt(fmax(0, 1 - d[k] * d[k] / (norm * norm)));
        const bool centre_out = emit->centre[k] != clamp_to_box(check, k, emit->centre[k]);
        snprintf(key, sizeof key, centre_out ? "%s.centre[%d]" : "%s.radius", path, k);
        if (!between_walls(check, key, k, emit->centre[k] - half, emit->centre[k] + half))
            return false;
    }
    snprintf(key, sizeof key, "%s.centre", path);
    return check_out_of_solids(check, key, emit->centre);
}

static bool check_fill(const Check *check, const Fill *fill, const char *path)
{
    char axis[96];
    if (!check_plane(check, path, fill->min) || !check_plane(check, path, fill->max) ||
        !check_plane(check, path, fill->centre))
        return false;
    if (fill->kind == FILL_BLOCK)
        return check_block(check, fill, path);
    snprintf(axis, sizeof axis, "%s.cylinder.axis", path);
    if (fill->kind == FILL_CYLINDER && check->scene->world.dimensions == 2)
        return FAIL(check, path, "a 2D scene has no cylinders; write a ball, which is a disc there");
    return (fill->kind == FILL_BALL || check_axis(check, axis, fill->axis)) && check_round(check, fill, path);
}

static bool check_fluid(const Check *check, int f)
{
    const FluidDef *fluid = &check->scene->world.fluids[f];
    char path[64];
    for (int other = 0; other < f; other++) {
        snprintf(path, sizeof path, "fluids[%d].name", f);
        if (strcmp(fluid->name, check->scene->world.fluids[other].name) == 0)
            return FAIL(check, path, "two fluids have the name '%s'; give each its own", fluid->name);
    }
    snprintf(path, sizeof path, "fluids[%d].velocity", f);
    if (!check_plane(check, path, fluid->velocity))
        return false;
    for (int i = 0; i < fluid->fill_count; i++) {
        snprintf(path, sizeof path, "fluids[%d].fill[%d]", f, i);
        if (!check_fill(check, &fluid->fills[i], path))
            return false;
    }
    for (int i = 0; i < fluid->emit_count; i++)
        if (!check_emit(check, f, i))
            return false;
    snprintf(path, sizeof path, "fluids[%d]", f);
    return fluid->fill_count + fluid->emit_count > 0 ||
           FAIL(check, path, "the fluid '%s' is nowhere; give it `fill` or `emit`", fluid->name);
}

static bool check_drain(const Check *check, int index)
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
        nearest[k] = drain->kind == FILL_BALL
                         ? drain->centre[k]
                         : fmin(fmax(clamp_to_box(check, k, drain->min[k]), drain->min[k]), drain->max[k]);
    return outside_box(check, nearest) <= reach ||
           FAIL(check, path, "the drain is outside the box; no fluid comes there");
}

static bool check_motion(const Check *check, const char *list, int m, const Motion *motion)
{
    char path[96];
    snprintf(path, sizeof path, "%s[%d].%s.axis", list, m, motion_name(motion->kind));
    if (!check_axis(check, path, motion->axis))
        return false;
    if (check->scene->world.dimensions == 2 && !motion_in_plane(motion))
        return FAIL(check, path,
                    "the motion leaves the plane of a 2D scene; shake along x and y, turn about [0, 0, 1]");
    return true;
}

/* Periodic sides: wide enough, without turns, with solids clear of them. */
static bool check_periodic(const Check *check)
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
                axis_name[k], size, 2 * world->support * world->spacing);
        for (int i = 0; i < world->solid_count; i++) {
            snprintf(path, sizeof path, "solids[%d]", i);
            if (!solid_between(&world->solids[i], world->dimensions, k, low, low + size))
                return FAIL(check, path,
                            "the solid reaches over a periodic side in %c, or may come there; keep it inside",
                            axis_name[k]);
        }
    }
    for (int m = 0; any && m < world->motion_count; m++) {
        snprintf(path, sizeof path, "motion[%d]", m);
        if (!motion_translates(&world->motions[m]))
            return FAIL(check, path, "a box with periodic sides does not turn; shake or accelerate it");
    }
    return true;
}

static bool check_lid(const Check *check)
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
    return check_plane(check, "box.lid", v);
}

/* In two dimensions solids stay in the plane. */
static bool check_solid_plane(const Check *check, const SolidDef *solid, const char *path)
{
    char key[96];
    if (check->scene->world.dimensions == 3)
        return true;
    if (solid->kind == SOLID_CYLINDER)
        return FAIL(check, path, "a 2D scene has no cylinders; write a sphere, which is a disc there");
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (solid->kind == SOLID_BOX && solid->angle_deg != 0 && (solid->axis[0] != 0 || solid->axis[1] != 0))
        return FAIL(check, key, "a box in a 2D scene turns about [0, 0, 1]");
    if (solid->kind == SOLID_BOWL && !check_plane(check, key, solid->axis))
        return false;
    snprintf(key, sizeof key, "%s.%s.centre", path, solid_name(solid->kind));
    return check_plane(check, key, solid->centre);
}

static bool check_solid(const Check *check, int index)
{
    const SolidDef *solid = &check->scene->world.solids[index];
    char path[64], key[96];
    snprintf(path, sizeof path, "solids[%d]", index);
    snprintf(key, sizeof key, "%s.%s.axis", path, solid_name(solid->kind));
    if (!check_solid_plane(check, solid, path) ||
        (solid->kind != SOLID_SPHERE && !check_axis(check, key, solid->axis)))
        return false;
    if (solid->motion_count == 0 && outside_box(check, solid->centre) > solid_reach(solid))
        return FAIL(check, path, "the solid is outside the box, and does not move; no fluid comes there");
    snprintf(key, sizeof key, "%s.motion", path);
    for (int m = 0; m < solid->motion_count; m++)
        if (!check_motion(check, key, m, &solid->motions[m]))
            return false;
    return true;
}

static bool check_view(const Check *check)
{
    const ViewDef *view = &check->scene->view;
    if (!view->range_auto && !(view->range[0] < view->range[1]))
        return FAIL(check, "view.range", "the range's low (%g) is not below its high (%g); swap or move them",
                    view->range[0], view->range[1]);
    const double *from = view->camera.from, *to = view->camera.to;
    if (!view->camera_auto && from[0] == to[0] && from[1] == to[1] && from[2] == to[2])
        return FAIL(check, "view.camera", "the camera stands where it looks; move `from` or `to`");
    return true;
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
        if (!check_fluid(&check, f))
            return false;
    for (int k = 0; k < scene->world.drain_count; k++)
        if (!check_drain(&check, k))
            return false;
    for (int m = 0; m < scene->world.motion_count; m++)
        if (!check_motion(&check, "motion", m, &scene->world.motions[m]))
            return false;
    for (int k = 0; k < scene->world.solid_count; k++)
        if (!check_solid(&check, k))
            return false;
    return check_plane(&check, "gravity", scene->world.gravity) && check_spacing(&check) &&
           check_lid(&check) && check_view(&check);
}

double scene_fluid_volume(const Scene *scene)
{
    double volume = 0;
    for (int f = 0; f < scene->world.fluid_count; f++)
        for (int i = 0; i < scene->world.fluids[f].fill_count; i++)
            volume += fill_volume(&scene->world.fluids[f].fills[i], scene->world.dimensions);
    return volume;
}

/* Points of the lattice that counting walks over: those of the block around each fill. */
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

static double physical_bytes(void)
{
    return (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
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

/* The grid of cells of side h covers the whole box, however little of it is filled. */
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
    if (!scene_fits_memory(0.5 * most)) /* half: rounding to the lattice can only lose so much of this many */
        return too_many(&check, scene_fluid_volume(scene) / (spacing * spacing * spacing));
    if (points_walked(&scene->world, spacing) > 0x1p30) /* a wide fill thinner than a spacing, say */
        return too_many(&check, points_walked(&scene->world, spacing));
    return true;
}

/* The least width of a solid's matter, m. */
static double solid_width(const SolidDef *solid, int dimensions)
{
    switch (solid->kind) {
    case SOLID_BOX:
        return fmin(fmin(solid->size[0], solid->size[1]), dimensions == 3 ? solid->size[2] : INFINITY);
    case SOLID_CYLINDER:
        return fmin(2 * solid->radius, solid->height);
    case SOLID_BOWL:
        return solid->thickness;
    default:
        return 2 * solid->radius;
    }
}

/* Fluid on both sides of what is thinner than a spacing would be one fluid. */
static bool check_widths(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    for (int k = 0; k < world->solid_count; k++) {
        const SolidDef *solid = &world->solids[k];
        const double width = solid_width(solid, world->dimensions);
        char path[64];
        snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(solid->kind));
        if (!(width >= (1 - 1e-9) * world->spacing))
            return FAIL(check, path,
                        "the solid is %g m thin, less than the spacing of %g m; make it thicker (twice the "
                        "spacing to keep fluids apart) or use a smaller spacing",
                        width, world->spacing);
    }
    return true;
}

/* Boundary particles stand in memory as the `fluid` ones do. */
static bool check_boundary(const Check *check, size_t fluid)
{
    const WorldDef *world = &check->scene->world;
    double sum = 0;
    for (int k = 0; k < world->solid_count; k++)
        sum += boundary_estimate(&world->solids[k], world->dimensions, world->spacing,
                                 world->support * world->spacing);
    return sum <= 0 || scene_fits_memory(sum + (double)flow_capacity(world, fluid)) ||
           FAIL(
               check, "solids",
               "the solids' surfaces need about %.3g particles of their own, more than this machine can hold; "
               "use a larger spacing or smaller solids",
               sum);
}

/* What no driver would take; what this one does not is found with it. */
static bool check_volume(const Check *check)
{
    const WorldDef *world = &check->scene->world;
    const VolumeDef *volume = &check->scene->view.volume;
    ParticleBuffers space = {.spacing = world->spacing, .support_radius = world->support * world->spacing};
    VolumeGrid grid;
    Error error;
    memcpy(space.box_size, world->box_size, sizeof space.box_size);
    return strcmp(check->scene->view.kind, "volume") != 0 || volume_grid_for(volume, &space, &grid, &error) ||
           FAIL(check, volume->cell > 0 ? "view.volume.cell" : "view.volume.cells", "%s", error.message);
}

bool scene_check_count(const Tree *tree, const Scene *scene, Error *error)
{
    const Check check = {tree, scene, error};
    const double spacing = scene->world.spacing;
    if (!check_widths(&check) || !check_periodic(&check) || !check_boundary(&check, 0) ||
        !check_volume(&check))
        return false;
    if (!scene_check_bounds(tree, scene, spacing, error) || !check_cells(&check))
        return false;
    WorldDef part = scene->world;
    size_t before = 0;
    for (int f = 0; f < scene->world.fluid_count; f++) {
        part.fluid_count = f + 1;
        const size_t count = world_def_count(&part, spacing);
        char path[64];
        snprintf(path, sizeof path, "fluids[%d].fill", f);
        if (!scene_fits_memory((double)count))
            return too_many(&check, (double)count);
        if (count == before && scene->world.fluids[f].fill_count > 0)
            return FAIL(
                &check, path,
                "the fluid '%s' has no particles: its fills hold no point of the lattice of spacing %g m that "
                "is free; use a smaller spacing or larger fills",
                scene->world.fluids[f].name, spacing);
        before = count;
    }
    if (!check_boundary(&check, before))
        return false;
    if (!flow_emits(&scene->world))
        return true;
    if (!scene_fits_memory(scene->world.most))
        return FAIL(&check, "particles.most", "%d particles are more than this machine can hold; use fewer",
                    scene->world.most);
    return before <= (size_t)scene->world.most ||
           FAIL(&check, "particles.most",
                "the fills alone hold %zu particles, more than the %d that emitters may fill up to; raise it",
                before, scene->world.most);
}
