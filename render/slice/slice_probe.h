/* What the last picture of the view slice shows at a place. */
#ifndef SLOSH_SLICE_PROBE_H
#define SLOSH_SLICE_PROBE_H

#include "render/frame/view.h"
#include "render/plane/plane_probe.h"
#include "render/slice/slice_def.h"

/* The state that sums are of. */
typedef struct PlaneFrom {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute position;
} PlaneFrom;

/* The last picture; zero-initialise it. */
typedef struct SliceProbe {
    PlaneProbe probe;
    bool drawn;   /* the plane is in it: */
    uint64_t run; /* number of its sums: another where they may be others than in the picture before */
    PlaneFrom from;
    PlaneJob job;
    Sight sight;
    bool flat;
    int part[4];    /* of the picture that is the slice, where flat: x, y from below, width, height */
    unsigned shown; /* SLICE_MEAN, ... */
    double cut;
    const char *name, *unit; /* of what is shown */
} SliceProbe;

/* As ViewKind has them. */
bool slice_probe_pick(const SliceProbe *probe, const double pixel[2], double at[3]);
int slice_probe_read(SliceProbe *probe, const PlaneSum *sum, const double (*at)[3], int count,
                     ViewProbe *out);

#endif
