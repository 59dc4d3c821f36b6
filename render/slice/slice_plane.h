/* The plane of the view slice: position, handles for the mouse, and keys. Pure. */
#ifndef SLOSH_SLICE_PLANE_H
#define SLOSH_SLICE_PLANE_H

#include "render/plane/plane.h"
#include "render/slice/slice_def.h"

/* A point of the plane at a time: the def's point, moved by view.slice.play. */
void slice_point(const SliceDef *def, const double box_size[3], double time, double point[3]);

/* The plane for a state; in two dimensions the scene's own plane. Returns false if the plane misses the
   box. */
bool slice_plane(const SliceDef *def, const ParticleBuffers *particles, Plane *plane);

/* As in ViewKind. */
int slice_handles(const ViewDef *view, const ParticleBuffers *particles, Handle handles[HANDLES_MAX]);
int slice_drag(const ViewDef *view, const ParticleBuffers *particles, int index, const Handle *taken,
               const double at[3], ViewSetting settings[VIEW_SETTINGS_MAX]);
int slice_step(const ViewDef *view, const ParticleBuffers *particles, ViewStep step,
               ViewSetting settings[VIEW_SETTINGS_MAX]);

#endif
