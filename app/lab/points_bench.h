/* Points a second: how fast surfaces are sampled, and how fast the view pbsr shows points. Beside the figures
   of: S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces and its application to
   fused visualization", 2012, section 5. */
#ifndef SLOSH_POINTS_BENCH_H
#define SLOSH_POINTS_BENCH_H

#include "app/case/reference.h"
#include "app/lab/bench.h"

enum { POINTS_RATES_MAX = 16 };

typedef struct PointsRate {
    const char *field, *sampler;
    double points, ms;
} PointsRate;

typedef struct PointsFigures {
    int threads, count;
    PointsRate rates[POINTS_RATES_MAX];
    BenchResult rendering; /* its counts have the points of a picture */
} PointsFigures;

/* Times each sampler on each kind of field, on all processors: about so many points of formulas and volumes,
   a tenth of them of particles. False, with the reason, when memory is short or a signal came. */
bool points_sampling(double points, PointsFigures *figures, Error *error);

/* Points of the picture that was measured. */
double points_shown(const BenchResult *result);

void points_print(const PointsFigures *figures, const Reference *published, FILE *file);

/* "sampling" and "rendering"; false with the reason when it cannot be written. */
bool points_write_json(const PointsFigures *figures, const char *path, Error *error);

#endif
