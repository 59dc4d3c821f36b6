/* Who takes a walk's steps and colours its points in the place of this machine's threads: sim/gl/surface. The
   seeds, the counting spheres and when there are enough points stay with sampling.h. */
#ifndef SLOSH_SURFACE_DEVICE_H
#define SLOSH_SURFACE_DEVICE_H

#include "sim/surface/points.h"
#include "sim/surface/request.h"

typedef struct Walk Walk;         /* sim/surface/walk.h */
typedef struct Counting Counting; /* sim/surface/counting.h */

/* Each is false with an error where the field or the memory is not for this device; `end` follows in any
   case. */
struct SurfaceDevice {
    void *own;
    /* Takes field, walkers and spheres for about so many points. */
    bool (*begin)(void *own, const Walk *walk, const Counting *counting, size_t points, Error *error);
    /* The walk's next steps; their points behind those that there are, in the order of Walk.out, and in the
       counting spheres' `inside` with them. Without `keep` nothing is left of them. */
    bool (*steps)(void *own, const Walk *walk, bool keep, Counting *counting, Error *error);
    bool (*colour)(void *own, const LevelField *field, Error *error);
    /* The first `count` points: to `out`, or, NULL, they stay with the device. */
    bool (*points)(void *own, size_t count, SurfacePoint *out, Error *error);
    size_t (*taken)(void *own); /* steps that walkers took */
    void (*end)(void *own);
};

#endif
