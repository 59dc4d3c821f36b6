/* The fluid's surface of the present state. */
#include "slosh/mesh.h"
#include "library/library.h"
#include "sim/mesh.h"

#include <math.h>
#include <stdlib.h>

struct slosh_mesh {
    float *vertex; /* 3 each */
    size_t vertex_count, triangle_count;
    uint32_t (*triangle)[3];
    double volume;
};

/* The grid around the fluid: the field is 0 in its outermost cells. Returns false without particles, or if
   the grid would not fit. */
static bool grid_of(const FieldParticles *particles, double cell, VolumeGrid *grid, Error *error)
{
    double low[3], high[3], cells = 1;
    if (!field_bounds(particles, low, high))
        return error_set(error, "there is no fluid to make a surface of");
    grid->cell = cell;
    for (int k = 0; k < 3; k++) {
        const double size = ceil((high[k] - low[k] + 2 * particles->support) / cell) + 3;
        cells *= size;
        if (!(cells < 1e9))
            return error_set(error,
                             "the grid of the surface would have more than 1e9 cells; larger cells need "
                             "fewer");
        grid->size[k] = (int)size;
        grid->corner[k] = low[k] - particles->support - 1.5 * cell;
    }
    return true;
}

static bool take(const IsoMesh *iso, const VolumeGrid *grid, slosh_mesh *mesh)
{
    mesh->vertex_count = iso->vertex_count;
    mesh->triangle_count = iso->triangle_count;
    mesh->volume = isosurface_volume(iso) * grid->cell * grid->cell * grid->cell;
    mesh->vertex = malloc((3 * iso->vertex_count + 1) * sizeof *mesh->vertex);
    mesh->triangle = malloc((iso->triangle_count + 1) * sizeof *mesh->triangle);
    for (size_t i = 0; mesh->vertex && i < iso->vertex_count; i++) {
        double place[3];
        isosurface_place(iso, i, place);
        for (int k = 0; k < 3; k++)
            mesh->vertex[3 * i + (size_t)k] = (float)(grid->corner[k] + (place[k] + 0.5) * grid->cell);
    }
    for (size_t i = 0; mesh->triangle && i < iso->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            mesh->triangle[i][k] = iso->triangle[i][k];
    return mesh->vertex && mesh->triangle;
}

static bool make(slosh_world *world, double level, double cell, slosh_mesh *mesh, Error *error)
{
    const WorldInfo *info = &world->run.info;
    const FieldParticles particles = {
        .count = info->count, .position = library_positions(world), .support = info->support_radius};
    VolumeGrid grid = {.cell = 0};
    FieldSlabs slabs = {0};
    IsoMesh iso = {.vertex_count = 0};
    if (!particles.position || !grid_of(&particles, cell * info->spacing, &grid, error))
        return false;
    float *field = malloc(volume_grid_cells(&grid) * sizeof *field);
    const bool ok = field && field_sum(&particles, &grid, info->threads, &slabs, field, NULL, error) &&
                    isosurface(grid.size, field, (float)level, &iso, error) && take(&iso, &grid, mesh);
    isosurface_free(&iso);
    field_slabs_free(&slabs);
    free(field);
    return ok;
}

slosh_mesh *slosh_mesh_create(slosh_world *world, double level, double cell, slosh_error *error)
{
    Error why = {"no memory for the surface"};
    const double at = level == 0 ? 0.5 : level, wide = cell == 0 ? 0.5 : cell;
    if (!world)
        return library_refuse(error, "the world is NULL"), NULL;
    if (world->run.scene.world.dimensions != 3)
        return library_refuse(error, "a world of two dimensions has no surface to make a mesh of"), NULL;
    if (!(at > 0 && at < 1) || !(wide >= 0.1 && wide <= 10))
        return library_refuse(error,
                              "a surface needs a level above 0 and below 1, and a cell of 0.1 to 10 "
                              "spacings, not %g and %g",
                              level, cell),
               NULL;
    slosh_mesh *mesh = calloc(1, sizeof *mesh);
    if (mesh && make(world, at, wide, mesh, &why))
        return mesh;
    slosh_mesh_free(mesh);
    return library_fail(error, &why), NULL;
}

void slosh_mesh_free(slosh_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->vertex);
    free(mesh->triangle);
    free(mesh);
}

size_t slosh_mesh_vertex_count(const slosh_mesh *mesh)
{
    return mesh ? mesh->vertex_count : 0;
}

const float *slosh_mesh_vertices(const slosh_mesh *mesh)
{
    return mesh ? mesh->vertex : NULL;
}

size_t slosh_mesh_triangle_count(const slosh_mesh *mesh)
{
    return mesh ? mesh->triangle_count : 0;
}

const uint32_t *slosh_mesh_triangles(const slosh_mesh *mesh)
{
    return mesh ? &mesh->triangle[0][0] : NULL;
}

double slosh_mesh_volume(const slosh_mesh *mesh)
{
    return mesh ? mesh->volume : 0;
}
