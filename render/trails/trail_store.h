/* The points of trails on the GPU: a column of the ring is a place, a scalar and an owner for each trail.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_TRAIL_STORE_H
#define SLOSH_TRAIL_STORE_H

#include "render/trails/trail_ring.h"
#include "render/trails/trails_def.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise it. */
typedef struct TrailStore {
    unsigned claim, take; /* programs */
    TrailRing ring;
    unsigned places; /* buffer, ring.room x slots vec4: x y z (m, box's frame), scalar */
    unsigned owners; /* buffer, ring.room x slots uint: 0, or 2 (id + 1) and 1 more where it is to be seen */
    unsigned seen;   /* buffer, slots uint: the last owner */
    unsigned claims; /* buffer, slots uint: the least id that wants it */
    unsigned none;   /* buffer: stands in for a scalar that is not there */
    size_t least;    /* slots that there are in any case */
    int slots;       /* trails that there is room for; 0: no memory, or nothing was taken yet */
    int stride;      /* in ids, at least the def's */
    size_t capacity; /* particles that the slots are for */
    uint64_t made;   /* how often all began anew, or a trail was taken away */
    const float *mapped_places; /* on a software driver: the CPU reads them too, NULL elsewhere, */
    const uint32_t *mapped_owners;
    void *taken;                        /* fence behind the last column; NULL: it has been waited for */
    double box_size[3], spacing;        /* of the state taken last, m */
    int listed_count;                   /* of `listed`; 0: by stride; -1: no list, and no trails */
    uint32_t listed[TRAILS_LISTED_MAX]; /* the id of each slot; UINT32_MAX: it is free */
    TrailsDef def;                      /* by which it was taken */
} TrailStore;

/* False when a shader does not compile; trail_store_destroy is needed in either case. */
bool trail_store_create(TrailStore *store, const Subject *subject, Error *error);
void trail_store_destroy(TrailStore *store);

/* The present state. */
void trail_store_take(TrailStore *store, const ParticleBuffers *particles, const ViewDef *def);

/* Where a column begins in `places` and `owners`, in elements. */
unsigned trail_store_column(const TrailStore *store, uint64_t number);

/* Until the CPU may read what is mapped, and nothing of GL before the last column is under way. */
void trail_store_wait(TrailStore *store);

/* For a program that reads places and owners. */
void trail_store_bind(const TrailStore *store);

#endif
