/* What exports draw from a snapshot: meshes of the fluid's surface and of solids, and colours of points. */
#ifndef APP_FILES_SURFACE_H
#define APP_FILES_SURFACE_H

#include "app/files/snapshot.h"
#include "app/scene/scene.h"
#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "slosh/world.h"

#include <stdio.h>

/* Colours of mesh vertices and points in files: by fluid, or by a scalar with a colormap. */

/* Source of the colours: fluid or scalar. */
typedef struct PointColors {
    size_t count;                /* fluids with a colour; 0: no colours are written */
    double color[FLUIDS_MAX][3]; /* sRGB 0 to 1 */
    bool mapped;                 /* by scalar: speed, density or pressure */
    Scalar scalar;
    double low, high; /* values of the first and the last colour of the default colormap */
} PointColors;

/* True if points have a colour. */
bool point_colored(const PointColors *colors);

/* Returns the speed (m/s), density (kg/m3) or pressure (Pa) of point i. */
double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar);

/* Prints the meaning of a colormap as a head line, "colours: ..."; nothing for colours by fluid. */
void point_colors_print(FILE *file, const char *before, const PointColors *colors);

/* Computes colours of points. */
typedef struct PointPainter {
    const PointColors *colors; /* not owned */
    uint8_t map[3 * COLORMAP_SIZE];
} PointPainter;

PointPainter point_painter(const PointColors *colors);

/* Fills in the sRGB colour of point i. A fluid without colour is grey. */
void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3]);

/* The fluid's surface as a mesh, from the particles of a step: the level set of F(r) = sum V_j W_poly6(r -
   r_j) of include/slosh/mesh.h, also used by pictures. The mesh is closed; normals come from the field's
   gradient, and vertex fields are means weighted by V W. */

/* Settings of a surface. */
typedef struct SurfaceDef {
    double level; /* level of F, less than 1; 0: per step the level at which the mesh encloses the volume
                     at rest, spacing^3 per particle, to 0.3 %: about 0.5, and within 0.25 .. 0.75 */
    double cell;  /* of the grid, in spacings; 0: 0.5; finer cells show little more */
    bool each;    /* make one surface per fluid, by surface_make_each */
} SurfaceDef;

typedef struct Surface {
    SnapshotStep vertices; /* mesh vertices with the fields of particles; `fluid`: the fluid with most
                              weight; no ids */
    float *normal[3];      /* per vertex, unit length, outwards */
    size_t triangle_count;
    uint32_t (*triangle)[3]; /* counter-clockwise seen from outside */
    double level, volume;    /* level of the field; enclosed volume, m3 */
} Surface;

/* Returns true if memory suffices for a grid over the scene's whole box, the most a step needs; false with
   advice. Two-dimensional scenes have no surface. */
bool surface_check(const SurfaceDef *def, const SnapshotScene *scene, Error *error);

/* Makes the surface of a step in the box's frame; no vertices if the fluid does not reach the level.
   Returns false, with nothing to free, if memory is short, or a particle is so far outside the box that
   the grid would not fit. */
bool surface_make(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                  Surface *surface, Error *error);

/* Makes a surface per fluid, all at the level found by surface_make for all fluids together. A fluid's
   region has F at the level or more, and the fluid's share of F is the largest. Where two fluids touch,
   both meshes have the same smooth border: the zero of the difference of their shares. `volume` is the
   enclosed volume; vertex fields are means over the fluid's own particles. A drop inside another fluid
   without the larger share anywhere has no mesh. Errors as surface_make; the caller frees fluid_count
   `surfaces`. */
bool surface_make_each(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                       Surface surfaces[FLUIDS_MAX], Error *error);

/* Works like snapshot_step_to_world. */
void surface_to_world(Surface *surface);

void surface_free(Surface *surface); /* a zeroed one is allowed */

/* The solids of a recorded scene as meshes, at their positions at the time of a snapshot. */

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
