/* The fluid's surface as a mesh, from the particles of a step: where the field F(r) = sum V_j W_poly6(r -
   r_j) of sim/mesh/field.h, which pictures show too, crosses a level. Closed, with the normals of the
   field's slope, and the particles' fields as means weighted by V W. */
#ifndef SLOSH_SURFACE_H
#define SLOSH_SURFACE_H

#include "app/output/snapshot.h"

/* How it is made. */
typedef struct SurfaceDef {
    double level; /* less than 1; 0: for each step the one at which the mesh encloses the fluid's volume at
                     rest, spacing^3 a particle, to 0.3 %: about 0.5, and within 0.25 .. 0.75 */
    double cell;  /* of the grid, in spacings; 0: 0.5, finer shows little more */
    bool each;    /* of several fluids: one a fluid, by surface_make_each */
} SurfaceDef;

typedef struct Surface {
    SnapshotStep vertices; /* of the mesh as if they were particles; `fluid`: the one with most weight there;
                              no ids */
    float *normal[3];      /* of each vertex, unit, outwards */
    size_t triangle_count;
    uint32_t (*triangle)[3]; /* counter-clockwise seen from outside */
    double level, volume;    /* of the field; enclosed, m3 */
} Surface;

/* Whether there is memory for the grid over all of the scene's box, which a step needs at most; false with
   what would fit. Scenes of two dimensions have no surface. */
bool surface_check(const SurfaceDef *def, const SnapshotScene *scene, Error *error);

/* Makes the surface of a step in the box's frame; without fluid at that level it has no vertices. False when
   memory is short, or a particle is so far outside the box that the grid would not fit: then there is nothing
   to free. */
bool surface_make(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                  Surface *surface, Error *error);

/* A surface of each of the scene's fluids, all at the level that surface_make finds for them together. A
   fluid's is where there is fluid, F at the level or more, and that fluid's share of F is the largest: where
   two touch both meshes have the same smooth border, the zero of the difference of their shares. `volume` is
   what each encloses; fields are means over its own particles. A drop of another fluid that has nowhere the
   larger share has no mesh. As surface_make; fluid_count of `surfaces` are to be freed. */
bool surface_make_each(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                       Surface surfaces[FLUIDS_MAX], Error *error);

/* As snapshot_step_to_world. */
void surface_to_world(Surface *surface);

void surface_free(Surface *surface); /* a zeroed one is allowed */

#endif
