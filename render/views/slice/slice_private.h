/* Parts of the view slice: position, handles and keys of the plane; values at positions. */
#ifndef RENDER_VIEWS_SLICE_SLICE_PRIVATE_H
#define RENDER_VIEWS_SLICE_SLICE_PRIVATE_H

#include "render/views/slice/slice.h"

#include "render/frame/view.h"
#include "render/particles/particles.h"

/* The plane of the view slice: position, handles for the mouse, and keys. Pure. */

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

/* The colours of a slice through several fluids: sums of V W times red, green and blue, each over sum V W. */

/* Zero-initialise. */
typedef struct SliceTints {
    FluidNumbers numbers;
    PlaneSum green, blue;
} SliceTints;

/* True if a picture is coloured by several fluids. */
bool slice_tints_shown(const ParticleBuffers *particles, const Frame *frame);

/* As plane_sum_run, three times. */
bool slice_tints_run(SliceTints *tints, PlaneSum *red, const PlaneJob *job, const ParticleBuffers *particles,
                     const WorldDef *world, Error *error);
void slice_tints_destroy(SliceTints *tints);

/* Values that the last picture of the view slice shows at positions. */

/* The state of the sums. */
typedef struct PlaneSource {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute position;
} PlaneSource;

/* The last picture. Zero-initialise. */
typedef struct SliceProbe {
    PlaneProbe probe;
    bool drawn;   /* the plane is in the picture: */
    uint64_t run; /* number of the sums: changes whenever the sums may change */
    PlaneSource from;
    PlaneJob job;
    Sight sight;
    bool flat;
    int part[4];    /* for a flat slice, the slice's rectangle in the picture: x, y from below, width,
                       height */
    unsigned shown; /* SLICE_MEAN, ... */
    double cut;
    const char *name, *unit; /* name and unit of the quantity shown */
} SliceProbe;

/* As in ViewKind. */
bool slice_probe_pick(const SliceProbe *probe, const double pixel[2], double at[3]);
int slice_probe_read(SliceProbe *probe, const PlaneSum *sum, const double (*at)[3], int count,
                     ViewProbe *out);

#endif
