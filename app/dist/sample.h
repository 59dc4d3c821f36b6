/* A run from a file of slosh-dist bench --json. */
#ifndef SLOSH_DIST_SAMPLE_H
#define SLOSH_DIST_SAMPLE_H

#include "app/scaling/series.h"

typedef struct Sample {
    const char *path;
    SeriesRun run;
    int dimensions;
    double imbalance;    /* greatest over mean compute */
    char scene[256];     /* as on the command line */
    char processor[128]; /* "": not in the file */
} Sample;

/* Reads a sample; `path` must outlive it. Returns false with the reason: no such file, or another
   program's. */
bool sample_read(const char *path, Sample *sample, Error *error);

#endif
