/* The chart of slosh-dist scaling: speed-up and efficiency over processors, and the parts of a step. */
#ifndef SLOSH_SCALING_CHART_H
#define SLOSH_SCALING_CHART_H

#include "app/dist/sample.h"
#include "app/lab/chart.h"

typedef struct ScalingPicture {
    const Sample *sample; /* one per run */
    const SeriesRun *runs;
    const Series *series;
    int count; /* of the series */
} ScalingPicture;

/* Draws FILE.svg or FILE.png. */
bool scaling_draw(const ScalingPicture *picture, const char *path, Error *error);

#endif
