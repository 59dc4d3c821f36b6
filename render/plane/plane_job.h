/* What is summed for a slice, and where. */
#ifndef SLOSH_PLANE_JOB_H
#define SLOSH_PLANE_JOB_H

#include "render/plane/plane.h"
#include "sim/base/scalar.h"

/* Who sums. Both are right to the same bounds, not the same to the bit. */
typedef enum PlaneBy {
    PLANE_AUTO,  /* rows on a software driver, whose memory is the CPU's; else quads */
    PLANE_QUADS, /* the GPU: a blended quad a particle */
    PLANE_ROWS   /* the CPU: render/plane/plane_rows.h, which reads the particles */
} PlaneBy;

typedef struct PlaneJob {
    Plane plane;
    int samples[2]; /* along and up; each at the centre of its part of the rectangle */
    int kernel;     /* of plane_kernels, at least 1 */
    int dimensions; /* 2: particles have areas, and kernels are the plane's */
    double support; /* radius h of the kernel, m */
    Scalar scalar;
    PlaneBy by;
} PlaneJob;

#endif
