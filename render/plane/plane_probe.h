/* Single samples of the sums of a slice. Of sums on the CPU they are there at once; on a GPU they are asked
   for, copied behind the picture, and there when that is done: nothing waits. */
#ifndef SLOSH_PLANE_PROBE_H
#define SLOSH_PLANE_PROBE_H

#include "render/plane/plane_sum.h"

enum { PLANE_PROBES_MAX = 16 };

/* Samples and where they are. */
typedef struct PlaneProbes {
    int count;
    int sample[PLANE_PROBES_MAX][2]; /* column and row; one that is not on the raster has no answer */
    /* The asker's own: */
    double at[PLANE_PROBES_MAX][3];
    uint64_t run;   /* which sums these are of */
    unsigned shown; /* what was made of them */
    double cut;
    const char *name, *unit; /* of that; static */
} PlaneProbes;

/* Zero-initialise it. */
typedef struct PlaneProbe {
    unsigned buffer;
    void *fence;        /* a GLsync behind the copy that is asked for; NULL: none is */
    PlaneProbes asked;  /* by that copy */
    PlaneProbes probes; /* what `sums` are of: the last that came */
    float sums[PLANE_PROBES_MAX][4];
} PlaneProbe;

/* Asks for samples of the last run, and takes what has come. */
void plane_probe_ask(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbes *probes);
void plane_probe_destroy(PlaneProbe *probe);

#endif
