/* The chart of slosh-dist scaling: speed-up and efficiency over processors, and what a step is made of. */
#ifndef SLOSH_SCALING_CHART_H
#define SLOSH_SCALING_CHART_H

#include "app/dist/sample.h"
#include "app/lab/chart.h"

typedef struct ScalingPicture {
    const Sample *sample; /* of each run */
    const SeriesRun *runs;
    const Series *series;
    int count; /* of the series */
} ScalingPicture;

/* FILE.svg or FILE.png. */
bool scaling_draw(const ScalingPicture *picture, const char *path, Error *error);

#endif
