#include "app/base/program.h"
#include "app/files/export.h"
#include "app/files/snapshot.h"
#include "sim/base/base.h"
#include "sim/mesh.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool point_colored(const PointColors *colors)
{
    return colors->mapped || colors->count > 0;
}

double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar)
{
    const double x = step->velocity[0][i], y = step->velocity[1][i], z = step->velocity[2][i];
    if (scalar == SCALAR_SPEED)
        return sqrt(x * x + y * y + z * z);
    return scalar == SCALAR_DENSITY ? step->density[i] : step->pressure[i];
}

static const char *map_of(const PointColors *colors)
{
    return colormap_of(colormap_choices[0], colors->scalar);
}

void point_colors_print(FILE *file, const char *before, const PointColors *colors)
{
    if (colors->mapped)
        fprintf(file, "%scolours: %s, %s from %g to %g %s\n", before, map_of(colors),
                scalar_name(colors->scalar), colors->low, colors->high, scalar_unit(colors->scalar));
}

static void fluid_color(const PointColors *colors, int32_t fluid, uint8_t rgb[3])
{
    static const double grey[3] = {0.5, 0.5, 0.5};
    const double *color = fluid >= 0 && (size_t)fluid < colors->count ? colors->color[fluid] : grey;
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)lround(255 * fmin(fmax(color[k], 0), 1));
}

PointPainter point_painter(const PointColors *colors)
{
    PointPainter painter = {.colors = colors};
    colormap_fill(map_of(colors), painter.map);
    return painter;
}

void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3])
{
    const PointColors *colors = painter->colors;
    if (!colors->mapped) {
        fluid_color(colors, step->fluid[i], rgb);
        return;
    }
    const double above = point_scalar(step, i, colors->scalar) - colors->low;
    const double at = fmin(fmax(above / fmax(colors->high - colors->low, 1e-30), 0), 1);
    memcpy(rgb, painter->map + 3 * lround((COLORMAP_SIZE - 1) * at), 3);
}

/* ---- the grid ---- */

/* Makes the grid around low .. high, with a margin of h and one cell, so that the outermost values are 0.
   Cells belong to one lattice for all steps of a scene, so that fluid at rest keeps its mesh. Returns
   false if memory does not suffice for `fields` numbers per cell. */
static bool grid_around(const double low[3], const double high[3], const SnapshotScene *scene, size_t fields,
                        double cell, VolumeGrid *grid)
{
    double cells = 1;
    grid->cell = cell;
    for (int k = 0; k < 3; k++) {
        const double first = floor((low[k] - scene->support_radius) / cell) - 1;
        const double size = ceil((high[k] + scene->support_radius) / cell) + 1 - first;
        if (!(size < INT32_MAX))
            return false;
        cells *= size;
        grid->corner[k] = first * cell;
        grid->size[k] = (int)size;
    }
    return cells * (double)(fields * sizeof(float)) < memory_bytes();
}

static double cell_side(const SurfaceDef *def, const SnapshotScene *scene)
{
    return (def->cell > 0 ? def->cell : 0.5) * scene->spacing;
}

/* Count of numbers per cell: field and mean; for surfaces per fluid also each share and one region. */
static size_t count_fields(const SurfaceDef *def, const SnapshotScene *scene)
{
    return 2 + (def->each ? 1 + scene->fluid_count : 0);
}

static bool box_grid(const SnapshotScene *scene, size_t fields, double cell, VolumeGrid *grid)
{
    const double *size = scene->box_size;
    const double low[3] = {-size[0] / 2, 0, -size[2] / 2}, high[3] = {size[0] / 2, size[1], size[2] / 2};
    return grid_around(low, high, scene, fields, cell, grid);
}

bool surface_check(const SurfaceDef *def, const SnapshotScene *scene, Error *error)
{
    VolumeGrid grid;
    const size_t fields = count_fields(def, scene);
    double fits = cell_side(def, scene);
    if (scene->dimensions != 3)
        return error_set(error, "a scene of two dimensions has no surface; export it without --surface");
    if (box_grid(scene, fields, fits, &grid))
        return true;
    while (!box_grid(scene, fields, fits, &grid))
        fits *= 1.1;
    return error_set(error,
                     "the grid of a surface needs more memory than this machine has (%.3g GB); use a --cell "
                     "of %.2g or more",
                     memory_bytes() / 1e9, fits / scene->spacing);
}

/* ---- state ---- */

typedef struct SurfaceWork {
    const SnapshotScene *scene;
    const SnapshotStep *step;
    size_t fields; /* numbers per cell */
    VolumeGrid grid;
    FieldSlabs slabs;
    FieldParticles particles;
    float *position;          /* of the particles, in the format of a field */
    float *field, *weighted;  /* values on the grid */
    float *scalar;            /* per particle: 1 for a fluid's particles, or the fluid's value */
    float *share[FLUIDS_MAX]; /* for surface_make_each: grid values of each fluid's own particles */
    IsoMesh mesh;
    Surface *surface;
} SurfaceWork;

static void work_free(SurfaceWork *work)
{
    field_slabs_free(&work->slabs);
    isosurface_free(&work->mesh);
    free(work->position);
    free(work->field);
    free(work->weighted);
    free(work->scalar);
    for (int k = 0; k < FLUIDS_MAX; k++)
        free(work->share[k]);
}

static bool take_particles(SurfaceWork *work)
{
    const SnapshotStep *step = work->step;
    work->position = malloc((4 * step->count + 1) * sizeof *work->position);
    work->scalar = malloc((step->count + 1) * sizeof *work->scalar);
    if (!work->position || !work->scalar)
        return false;
    for (size_t i = 0; i < step->count; i++) {
        for (int k = 0; k < 3; k++)
            work->position[4 * i + (size_t)k] = step->position[k][i];
        work->position[4 * i + 3] = (float)snapshot_volume(work->scene, step, i);
    }
    work->particles = (FieldParticles){step->count, work->position, NULL, work->scene->support_radius};
    return true;
}

/* ---- vertex fields ---- */

static bool sum_weighted(SurfaceWork *work, const float *scalar, Error *error)
{
    work->particles.scalar = scalar;
    return field_sum(&work->particles, &work->grid, world_processors(), &work->slabs, NULL, work->weighted,
                     error);
}

enum { ALL_FLUIDS = -1 };

/* Mean of the scalar over a fluid's particles at each vertex, weighted by V W. */
static bool mean_over(SurfaceWork *work, const float *scalar, int fluid, float *out, Error *error)
{
    const float *weights = fluid == ALL_FLUIDS ? work->field : work->share[fluid];
    if (!sum_weighted(work, scalar, error))
        return false;
    for (size_t i = 0; i < work->mesh.vertex_count; i++) {
        const float weight = isosurface_value(&work->mesh, i, weights);
        out[i] = weight > 0 ? isosurface_value(&work->mesh, i, work->weighted) / weight : 0;
    }
    return true;
}

static bool mean(SurfaceWork *work, const float *scalar, float *out, Error *error)
{
    return mean_over(work, scalar, ALL_FLUIDS, out, error);
}

/* Finds the fluid with most of V W at each vertex. `most` is scratch: one number per vertex. */
static bool find_fluids(SurfaceWork *work, float *most, Error *error)
{
    SnapshotStep *vertices = &work->surface->vertices;
    for (size_t fluid = 0; fluid < work->scene->fluid_count && work->scene->fluid_count > 1; fluid++) {
        for (size_t i = 0; i < work->step->count; i++)
            work->scalar[i] = work->step->fluid[i] == (int32_t)fluid;
        if (!sum_weighted(work, work->scalar, error))
            return false;
        for (size_t i = 0; i < vertices->count; i++) {
            const float weight = isosurface_value(&work->mesh, i, work->weighted);
            if (fluid == 0 || weight > most[i]) {
                most[i] = weight;
                vertices->fluid[i] = (int32_t)fluid;
            }
        }
    }
    return true;
}

static bool find_means(SurfaceWork *work, Error *error)
{
    const SnapshotStep *step = work->step;
    SnapshotStep *vertices = &work->surface->vertices;
    for (int k = 0; k < 3; k++)
        if (!mean(work, step->velocity[k], vertices->velocity[k], error))
            return false;
    return find_fluids(work, vertices->density, error) && /* still unused: scratch */
           mean(work, step->density, vertices->density, error) &&
           mean(work, step->pressure, vertices->pressure, error);
}

/* Places vertices and normals; values fall outwards. */
static void place_vertices(SurfaceWork *work, const float *values)
{
    Surface *surface = work->surface;
    for (size_t i = 0; i < work->mesh.vertex_count; i++) {
        double place[3];
        float slope[3];
        isosurface_place(&work->mesh, i, place);
        isosurface_slope(&work->mesh, i, values, slope);
        const float steep = sqrtf(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
        for (int k = 0; k < 3; k++) {
            surface->vertices.position[k][i] =
                (float)(work->grid.corner[k] + work->grid.cell * (place[k] + 0.5));
            surface->normal[k][i] = steep > 0 ? -slope[k] / steep : k == 1;
        }
    }
}

/* ---- whole surface ---- */

static bool allocate(Surface *surface, const SurfaceWork *work)
{
    const size_t count = work->mesh.vertex_count;
    bool all = snapshot_step_allocate(&surface->vertices, count);
    for (int k = 0; k < 3; k++)
        all = (surface->normal[k] = malloc((count + 1) * sizeof(float))) && all;
    surface->vertices.time = work->step->time;
    surface->vertices.step = work->step->step;
    surface->vertices.box = work->step->box;
    return all;
}

static bool march(SurfaceWork *work, double level, Error *error)
{
    const double side = work->grid.cell;
    isosurface_free(&work->mesh);
    if (!isosurface(work->grid.size, work->field, (float)level, &work->mesh, error))
        return false;
    work->surface->level = level;
    work->surface->volume = isosurface_volume(&work->mesh) * side * side * side;
    return true;
}

/* Finds the level at which the mesh encloses the fluid's volume at rest, by the secant method. */
static bool march_to_volume(SurfaceWork *work, Error *error)
{
    const double s = work->scene->spacing, volume = s * s * s * (double)work->particles.count;
    double level = 0.5, change = -1, before = 0; /* change of the excess with the level; the last excess */
    for (int tries = 0; tries < 6; tries++) {
        const double last = work->surface->level;
        if (!march(work, level, error))
            return false;
        const double excess = work->surface->volume / volume - 1;
        if (tries > 0 && level != last)
            change = fmin((excess - before) / (level - last), -0.2);
        if (fabs(excess) < 0.003)
            break;
        before = excess;
        level = fmin(fmax(level - excess / change, 0.25), 0.75);
        if (level == work->surface->level)
            break; /* at a bound */
    }
    return true;
}

/* Makes the mesh; no mesh without particles. */
static bool cross_level(SurfaceWork *work, double level, Error *error)
{
    double low[3], high[3];
    if (!field_bounds(&work->particles, low, high))
        return true;
    if (!grid_around(low, high, work->scene, work->fields, work->grid.cell, &work->grid))
        return error_set(error, "at %g s particles are too far apart for a surface of such small cells",
                         work->step->time);
    const size_t cells = volume_grid_cells(&work->grid);
    work->field = malloc(cells * sizeof *work->field);
    work->weighted = malloc(cells * sizeof *work->weighted);
    if (!work->field || !work->weighted) {
        error_set(error, "no memory for a grid of %zu cells; use a larger --cell", cells);
        return false;
    }
    if (!field_sum(&work->particles, &work->grid, world_processors(), &work->slabs, work->field, NULL, error))
        return false;
    return level > 0 ? march(work, level, error) : march_to_volume(work, error);
}

/* Moves the mesh into the surface, with vertices where `values` cross the level; fields are not set. */
static bool take_mesh(SurfaceWork *work, const float *values, Error *error)
{
    Surface *surface = work->surface;
    if (work->mesh.triangle_count > INT32_MAX / 3) /* limit of the integers in files */
        return error_set(error, "a surface of %zu triangles fits into no file; use a larger --cell",
                         work->mesh.triangle_count);
    if (!allocate(surface, work))
        return error_set(error, "no memory for a surface of %zu vertices", work->mesh.vertex_count);
    place_vertices(work, values);
    surface->triangle_count = work->mesh.triangle_count;
    surface->triangle = work->mesh.triangle;
    work->mesh.triangle = NULL;
    return true;
}

static bool begin(SurfaceWork *work, double level, Error *error)
{
    if (!take_particles(work))
        return error_set(error, "no memory for a surface of %zu particles", work->step->count);
    return cross_level(work, level, error);
}

static bool make(SurfaceWork *work, double level, Error *error)
{
    return begin(work, level, error) && take_mesh(work, work->field, error) &&
           (work->surface->triangle_count == 0 || find_means(work, error));
}

bool surface_make(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                  Surface *surface, Error *error)
{
    *surface = (Surface){0};
    SurfaceWork work = {.scene = scene,
                        .step = step,
                        .fields = count_fields(def, scene),
                        .grid.cell = cell_side(def, scene),
                        .surface = surface};
    const bool made = make(&work, def->level, error);
    work_free(&work);
    if (!made)
        surface_free(surface);
    return made;
}

/* ---- one surface per fluid ---- */

static bool sum_shares(SurfaceWork *work, Error *error)
{
    const size_t cells = volume_grid_cells(&work->grid);
    for (size_t fluid = 0; fluid < work->scene->fluid_count; fluid++) {
        work->share[fluid] = malloc(cells * sizeof(float));
        if (!work->share[fluid])
            return error_set(error, "no memory for a grid of %zu cells; use a larger --cell", cells);
        for (size_t i = 0; i < work->step->count; i++)
            work->scalar[i] = work->step->fluid[i] == (int32_t)fluid;
        work->particles.scalar = work->scalar;
        if (!field_sum(&work->particles, &work->grid, world_processors(), &work->slabs, NULL,
                       work->share[fluid], error))
            return false;
    }
    return true;
}

/* Fills in the region of a fluid, positive inside: the lesser of F minus the level, and the fluid's share
   minus the largest of other shares. Both are smooth, and so is the border; on its other side the
   neighbour's region has the opposite values. */
static void find_region(const SurfaceWork *work, size_t fluid, double level, float *region)
{
    const size_t cells = volume_grid_cells(&work->grid);
    for (size_t i = 0; i < cells; i++) {
        float other = 0;
        for (size_t k = 0; k < work->scene->fluid_count; k++)
            if (k != fluid)
                other = fmaxf(other, work->share[k][i]);
        const float above = work->field[i] - (float)level;
        region[i] = work->scene->fluid_count > 1 ? fminf(above, work->share[fluid][i] - other) : above;
    }
}

/* Mean over the fluid's own particles. */
static bool own_mean(SurfaceWork *work, size_t fluid, const float *scalar, float *out, Error *error)
{
    for (size_t i = 0; i < work->step->count; i++)
        work->scalar[i] = work->step->fluid[i] == (int32_t)fluid ? scalar[i] : 0;
    return mean_over(work, work->scalar, (int)fluid, out, error);
}

static bool own_means(SurfaceWork *work, size_t fluid, Error *error)
{
    const SnapshotStep *step = work->step;
    SnapshotStep *vertices = &work->surface->vertices;
    for (size_t i = 0; i < vertices->count; i++)
        vertices->fluid[i] = (int32_t)fluid;
    for (int k = 0; k < 3; k++)
        if (!own_mean(work, fluid, step->velocity[k], vertices->velocity[k], error))
            return false;
    return own_mean(work, fluid, step->density, vertices->density, error) &&
           own_mean(work, fluid, step->pressure, vertices->pressure, error);
}

/* Makes one fluid's surface; `region` is scratch. */
static bool make_one(SurfaceWork *work, size_t fluid, double level, float *region, Error *error)
{
    const double side = work->grid.cell;
    find_region(work, fluid, level, region);
    isosurface_free(&work->mesh);
    if (!isosurface(work->grid.size, region, 0, &work->mesh, error))
        return false;
    work->surface->level = level;
    work->surface->volume = isosurface_volume(&work->mesh) * side * side * side;
    return take_mesh(work, region, error) && own_means(work, fluid, error);
}

/* Makes a surface per fluid, with the level of the whole surface. */
static bool make_each(SurfaceWork *work, const Surface *whole, Surface surfaces[FLUIDS_MAX], Error *error)
{
    const size_t cells = work->field ? volume_grid_cells(&work->grid) : 0;
    float *region = malloc((cells + 1) * sizeof *region);
    if (!region)
        return error_set(error, "no memory for a grid of %zu cells; use a larger --cell", cells);
    bool made = cells == 0 || sum_shares(work, error);
    for (size_t fluid = 0; made && fluid < work->scene->fluid_count; fluid++) {
        work->surface = &surfaces[fluid];
        made = cells > 0 ? make_one(work, fluid, whole->level, region, error)
                         : take_mesh(work, NULL, error); /* no particles: no vertices */
    }
    free(region);
    return made;
}

bool surface_make_each(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                       Surface surfaces[FLUIDS_MAX], Error *error)
{
    Surface whole = {.level = 0};
    SurfaceWork work = {.scene = scene,
                        .step = step,
                        .fields = count_fields(def, scene),
                        .grid.cell = cell_side(def, scene),
                        .surface = &whole};
    for (size_t fluid = 0; fluid < scene->fluid_count; fluid++)
        surfaces[fluid] = (Surface){0};
    const bool made = begin(&work, def->level, error) && make_each(&work, &whole, surfaces, error);
    work_free(&work);
    for (size_t fluid = 0; !made && fluid < scene->fluid_count; fluid++)
        surface_free(&surfaces[fluid]);
    return made;
}

void surface_to_world(Surface *surface)
{
    snapshot_step_to_world(&surface->vertices);
    for (size_t i = 0; i < surface->vertices.count; i++) {
        double normal[3] = {surface->normal[0][i], surface->normal[1][i], surface->normal[2][i]};
        quat_rotate(surface->vertices.box.orientation, normal, normal);
        for (int k = 0; k < 3; k++)
            surface->normal[k][i] = (float)normal[k];
    }
}

void surface_free(Surface *surface)
{
    snapshot_step_free(&surface->vertices);
    for (int k = 0; k < 3; k++)
        free(surface->normal[k]);
    free(surface->triangle);
    *surface = (Surface){0};
}

bool export_solids_make(ExportSolids *solids, const WorldDef *world, Error *error)
{
    const double slab = world->dimensions == 2 ? world->spacing : 0;
    *solids = (ExportSolids){.count = world->solid_count};
    for (int i = 0; i < solids->count; i++) {
        const SolidDef *def = &world->solids[i];
        snprintf(solids->solid[i].name, NAME_SIZE, "solid%d_%s", i, solid_name(def->kind));
        solids->solid[i].def = *def;
        solids->solid[i].color.count = 1;
        for (int k = 0; k < 3; k++)
            solids->solid[i].color.color[0][k] = linear_to_srgb(def->color[k]);
        if (!solid_mesh_add(&solids->solid[i].mesh, def, slab, (uint32_t)i))
            return error_set(error, "no memory for the mesh of solids[%d]", i);
    }
    return true;
}

static bool allocate_solid(Surface *mesh, const SolidMesh *from)
{
    const size_t count = from->vertex_count;
    *mesh = (Surface){.triangle_count = from->index_count / 3};
    bool all = snapshot_step_allocate(&mesh->vertices, count);
    for (int k = 0; k < 3; k++)
        all = (mesh->normal[k] = malloc((count + 1) * sizeof(float))) && all;
    mesh->triangle = malloc((mesh->triangle_count + 1) * sizeof *mesh->triangle);
    if (all && mesh->triangle)
        return true;
    surface_free(mesh);
    return false;
}

static void place_vertex(Surface *mesh, size_t i, const SolidVertex *vertex, const BoxState *pose)
{
    SnapshotStep *to = &mesh->vertices;
    const double still[3] = {0}, own[3] = {vertex->position[0], vertex->position[1], vertex->position[2]};
    double x[3], v[3], normal[3] = {vertex->normal[0], vertex->normal[1], vertex->normal[2]};
    box_to_world(pose, own, still, x, v); /* from the solid's frame to the box's frame */
    quat_rotate(pose->orientation, normal, normal);
    for (int k = 0; k < 3; k++) {
        to->position[k][i] = (float)x[k];
        to->velocity[k][i] = (float)v[k];
        mesh->normal[k][i] = (float)normal[k];
    }
    to->density[i] = to->pressure[i] = 0;
    to->fluid[i] = 0;
}

bool export_solid_at(const ExportSolids *solids, int k, const SnapshotStep *step, Surface *mesh, Error *error)
{
    const SolidMesh *from = &solids->solid[k].mesh;
    BoxState pose;
    if (!allocate_solid(mesh, from))
        return error_set(error, "no memory for the mesh of solids[%d]", k);
    solid_pose_in(&solids->solid[k].def, step->time, &step->restart.bodies.of[k].pose, &pose);
    for (size_t i = 0; i < from->vertex_count; i++)
        place_vertex(mesh, i, &from->vertices[i], &pose);
    memcpy(mesh->triangle, from->indices, mesh->triangle_count * sizeof *mesh->triangle);
    mesh->vertices.time = step->time;
    mesh->vertices.step = step->step;
    mesh->vertices.box = step->box;
    return true;
}

void export_solids_free(ExportSolids *solids)
{
    for (int i = 0; i < solids->count; i++)
        solid_mesh_destroy(&solids->solid[i].mesh);
    *solids = (ExportSolids){0};
}
