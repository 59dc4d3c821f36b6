/* The sums of a slice on the CPU, for software drivers: their memory is the CPU's, and a blended fragment
   costs ten times what a sample costs here. Particles near the plane are listed, those that reach into each
   band of rows are added to it in their order, and threads take bands: the same bits for any number of
   threads. */
#ifndef SLOSH_PLANE_ROWS_H
#define SLOSH_PLANE_ROWS_H

#include "render/plane/plane_job.h"
#include "sim/base/bins.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct PlaneDisc PlaneDisc;

/* Zero-initialise it. */
typedef struct PlaneRows {
    float *read;                  /* a part of the particles: positions, then scalars */
    size_t read_capacity;         /* floats */
    PlaneDisc *discs;             /* of the particles that reach the rectangle */
    size_t count, discs_capacity; /* of discs */
    Bins bands;                   /* discs by band of rows */
    float *sums[3];               /* as the channels of PlaneSum.sums, rows of `stride` floats */
    size_t sums_capacity[3], stride;
    float *out; /* 4 floats a sample, rows from the bottom up */
    size_t out_capacity;
} PlaneRows;

/* Fills in `out`; false where memory does not suffice. Waits for what the GPU writes to the particles. */
bool plane_rows_run(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles, Error *error);
void plane_rows_free(PlaneRows *rows);

#endif
