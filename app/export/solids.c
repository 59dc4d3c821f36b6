#include "app/export/solids.h"

#include "sim/base/color.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static bool allocate(Surface *mesh, const SolidMesh *from)
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
    if (!allocate(mesh, from))
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
