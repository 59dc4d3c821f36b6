/* A device that runs a walk's steps and colours its points instead of the CPU's threads: sim/gl/surface.
   Seeds, counting spheres and the end of sampling stay with sampling.h. */
#ifndef SLOSH_SURFACE_DEVICE_H
#define SLOSH_SURFACE_DEVICE_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

typedef struct Walk Walk;         /* sim/surface/walk.h */
typedef struct Counting Counting; /* sim/surface/counting.h */

/* Functions return false with an error if the device cannot take the field or the memory; call `end` in any
   case. */
struct SurfaceDevice {
    void *own;
    /* Takes field, walkers and spheres for about `points` points. */
    bool (*begin)(void *own, const Walk *walk, const Counting *counting, size_t points, Error *error);
    /* Runs the walk's next steps. Appends the points in the order of Walk.out and adds to the counting
       spheres' `inside`. Without `keep` the points are dropped. */
    bool (*steps)(void *own, const Walk *walk, bool keep, Counting *counting, Error *error);
    bool (*colour)(void *own, const LevelField *field, Error *error);
    /* Copies the first `count` points to `out`; if `out` is NULL the points stay on the device. */
    bool (*points)(void *own, size_t count, SurfacePoint *out, Error *error);
    size_t (*taken)(void *own); /* accepted steps of all walkers */
    void (*end)(void *own);
};

#endif
