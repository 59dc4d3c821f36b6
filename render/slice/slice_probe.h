/* Values that the last picture of the view slice shows at positions. */
#ifndef SLOSH_SLICE_PROBE_H
#define SLOSH_SLICE_PROBE_H

#include "render/frame/view.h"
#include "render/plane/plane_probe.h"
#include "render/slice/slice_def.h"

/* The state of the sums. */
typedef struct PlaneFrom {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute position;
} PlaneFrom;

/* The last picture. Zero-initialise. */
typedef struct SliceProbe {
    PlaneProbe probe;
    bool drawn;   /* the plane is in the picture: */
    uint64_t run; /* number of the sums: changes whenever the sums may change */
    PlaneFrom from;
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
