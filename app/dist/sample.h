/* A run as slosh-dist bench --json wrote it. */
#ifndef SLOSH_DIST_SAMPLE_H
#define SLOSH_DIST_SAMPLE_H

#include "app/scaling/series.h"

typedef struct Sample {
    const char *path;
    SeriesRun run;
    int dimensions;
    double imbalance;    /* greatest over mean compute */
    char scene[256];     /* as the command line named it */
    char processor[128]; /* "": the file does not say */
} Sample;

/* `path` outlives it. False with the reason: no such file, or another program's. */
bool sample_read(const char *path, Sample *sample, Error *error);

#endif
