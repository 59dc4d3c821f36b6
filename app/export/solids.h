/* The solids of a recorded scene as meshes, at their positions at the time of a snapshot. */
#ifndef SLOSH_EXPORT_SOLIDS_H
#define SLOSH_EXPORT_SOLIDS_H

#include "app/export/point_color.h"
#include "app/export/surface.h"
#include "app/scene/scene.h"
#include "render/frame/solid_mesh.h"

/* Ordered as in the scene. */
typedef struct ExportSolids {
    int count;
    struct {
        char name[NAME_SIZE]; /* "solid0_bowl"; the number as in --set solids[0] */
        SolidDef def;
        SolidMesh mesh; /* in the solid's own frame */
        PointColors color;
    } solid[SOLIDS_MAX];
} ExportSolids;

/* Makes the meshes; in two dimensions as deep as the particles. Returns false if memory is short; call
   export_solids_free in either case. */
bool export_solids_make(ExportSolids *solids, const WorldDef *world, Error *error);

/* Makes the mesh of solid `k` at the step's time, in the box's frame: positions, normals and surface
   velocities; fluid fields are 0. The caller frees the mesh. Returns false, with nothing to free, if
   memory is short. */
bool export_solid_at(const ExportSolids *solids, int k, const SnapshotStep *step, Surface *mesh,
                     Error *error);

void export_solids_free(ExportSolids *solids); /* a zeroed one is allowed */

#endif
