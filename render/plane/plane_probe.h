/* Reads single samples of a slice's sums. Sums on the CPU are available at once; on a GPU the samples are
   copied after the picture and available once the copy is done: nothing waits. */
#ifndef SLOSH_PLANE_PROBE_H
#define SLOSH_PLANE_PROBE_H

#include "render/plane/plane_sum.h"

enum { PLANE_PROBES_MAX = 16 };

/* Positions of samples. */
typedef struct PlaneProbes {
    int count;
    int sample[PLANE_PROBES_MAX][2]; /* column and row; a sample outside the raster has no answer */
    /* The caller's data: */
    double at[PLANE_PROBES_MAX][3];
    uint64_t run;   /* number of the sums */
    unsigned shown; /* quantity shown */
    double cut;
    const char *name, *unit; /* name and unit of the quantity; static */
} PlaneProbes;

/* Zero-initialise. */
typedef struct PlaneProbe {
    unsigned buffer;
    void *fence;        /* a GLsync after the requested copy; NULL: no request */
    PlaneProbes asked;  /* samples of that copy */
    PlaneProbes probes; /* samples of `sums`: the last answer */
    float sums[PLANE_PROBES_MAX][4];
} PlaneProbe;

/* Requests samples of the last run, and takes an answer that has arrived. */
void plane_probe_ask(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbes *probes);
void plane_probe_destroy(PlaneProbe *probe);

#endif
