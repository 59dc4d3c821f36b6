/* Inputs of the sums of a slice. */
#ifndef SLOSH_PLANE_JOB_H
#define SLOSH_PLANE_JOB_H

#include "render/plane/plane.h"
#include "sim/base/scalar.h"

/* The processor for the sums. Both choices have the same error bounds, but not the same bits. */
typedef enum PlaneBy {
    PLANE_AUTO,  /* rows on a software driver, whose memory is the CPU's; else quads */
    PLANE_QUADS, /* the GPU: a blended quad per particle */
    PLANE_ROWS   /* the CPU: render/plane/plane_rows.h, which reads particles back */
} PlaneBy;

typedef struct PlaneJob {
    Plane plane;
    int samples[2]; /* along and up; each at the centre of its part of the rectangle */
    int kernel;     /* index in plane_kernels, at least 1 */
    int dimensions; /* 2: particles have areas, and kernels are two-dimensional */
    double support; /* radius h of the kernel, m */
    Scalar scalar;
    PlaneBy by;
} PlaneJob;

#endif
