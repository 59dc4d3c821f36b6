/* The fluid's surface as a mesh, from the particles of a step: the level set of F(r) = sum V_j W_poly6(r -
   r_j) of sim/mesh/field.h, also used by pictures. The mesh is closed; normals come from the field's
   gradient, and vertex fields are means weighted by V W. */
#ifndef SLOSH_SURFACE_H
#define SLOSH_SURFACE_H

#include "app/output/snapshot.h"

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

#endif
