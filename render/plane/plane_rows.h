/* The sums of a slice on the CPU, for software drivers: the driver's memory is the CPU's, and a blended
   fragment costs ten times a sample here. Particles near the plane are listed, then sorted into bands of
   rows in order. Threads take bands: the same bits for any number of threads. */
#ifndef SLOSH_PLANE_ROWS_H
#define SLOSH_PLANE_ROWS_H

#include "render/plane/plane_job.h"
#include "sim/base/bins.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct PlaneDisc PlaneDisc;

/* Zero-initialise. */
typedef struct PlaneRows {
    float *read;                  /* work array for a part of the particles: positions, then scalars */
    size_t read_capacity;         /* floats */
    PlaneDisc *discs;             /* discs of particles that reach the rectangle */
    size_t count, discs_capacity; /* of discs */
    Bins bands;                   /* discs by band of rows */
    float *sums[3];               /* as the channels of PlaneSum.sums, rows of `stride` floats */
    size_t sums_capacity[3], stride;
    float *out; /* 4 floats per sample, rows from the bottom up */
    size_t out_capacity;
} PlaneRows;

/* Computes `out`. Returns false if memory is short. Waits for the GPU's writes to the particles. */
bool plane_rows_run(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles, Error *error);
void plane_rows_free(PlaneRows *rows);

#endif
