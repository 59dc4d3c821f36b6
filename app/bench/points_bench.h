/* Points per second: sampling of surfaces, and rendering by the view pbsr. Compared with: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, section 5. */
#ifndef APP_BENCH_POINTS_BENCH_H
#define APP_BENCH_POINTS_BENCH_H

#include "app/bench/bench.h"

#include "app/bench/cases/case.h"

enum { POINTS_RATES_MAX = 16 };

typedef struct PointsRate {
    const char *field, *sampler;
    double points, ms;
} PointsRate;

typedef struct PointsFigures {
    int threads, count;
    PointsRate rates[POINTS_RATES_MAX];
    BenchResult rendering; /* counts has the points of a picture */
} PointsFigures;

/* Times each sampler on each kind of field, on all processors: about `points` points of formulas and
   volumes, a tenth as many of particles. Returns false with the reason if memory is short or a signal
   came. */
bool points_sampling(double points, PointsFigures *figures, Error *error);

/* Returns the count of points in the measured picture. */
double points_shown(const BenchResult *result);

void points_print(const PointsFigures *figures, const Reference *published, FILE *file);

/* Writes "sampling" and "rendering". Returns false with the reason if the file cannot be written. */
bool points_write_json(const PointsFigures *figures, const char *path, Error *error);

#endif
