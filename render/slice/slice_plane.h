/* Where the plane of the view slice is, what of it the mouse may take, and what its keys do. Pure. */
#ifndef SLOSH_SLICE_PLANE_H
#define SLOSH_SLICE_PLANE_H

#include "render/plane/plane.h"
#include "render/slice/slice_def.h"

/* A point of the plane at that time: the def's, or where view.slice.play has brought it. */
void slice_point(const SliceDef *def, const double box_size[3], double time, double point[3]);

/* The plane of that state; one of a scene of two dimensions is the scene's own. False where it misses the
 * box. */
bool slice_plane(const SliceDef *def, const ParticleBuffers *particles, Plane *plane);

/* As ViewKind has them. */
int slice_handles(const ViewDef *view, const ParticleBuffers *particles, Handle handles[HANDLES_MAX]);
int slice_drag(const ViewDef *view, const ParticleBuffers *particles, int index, const Handle *taken,
               const double at[3], ViewSetting settings[VIEW_SETTINGS_MAX]);
int slice_step(const ViewDef *view, const ParticleBuffers *particles, ViewStep step,
               ViewSetting settings[VIEW_SETTINGS_MAX]);

#endif
