/* The points of trails on the GPU: a column of the ring has a position, a scalar and an owner for each
   trail.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_TRAIL_STORE_H
#define SLOSH_TRAIL_STORE_H

#include "render/trails/trail_ring.h"
#include "render/trails/trails_def.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise. */
typedef struct TrailStore {
    unsigned claim, take; /* programs */
    TrailRing ring;
    unsigned places;            /* buffer, ring.room x slots vec4: x y z (m, box's frame), scalar */
    unsigned owners;            /* buffer, ring.room x slots uint: 0, or 2 (id + 1), plus 1 if visible */
    unsigned seen;              /* buffer, slots uint: the last owner */
    unsigned claims;            /* buffer, slots uint: the least id that claims the slot */
    unsigned none;              /* buffer: replaces a missing scalar */
    size_t least;               /* least number of slots */
    int slots;                  /* capacity in trails; 0: no memory, or no state taken yet */
    int stride;                 /* in ids; at least the def's stride */
    size_t capacity;            /* number of particles that the slots are for */
    uint64_t made;              /* number of restarts and removed trails */
    const float *mapped_places; /* software driver: mapped for the CPU; else NULL */
    const uint32_t *mapped_owners;
    void *taken;                        /* fence after the last column; NULL: already waited for */
    double box_size[3], spacing;        /* of the state taken last, m */
    int listed_count;                   /* length of `listed`; 0: by stride; -1: invalid list, no trails */
    uint32_t listed[TRAILS_LISTED_MAX]; /* the id of each slot; UINT32_MAX: free */
    TrailsDef def;                      /* settings of the last state taken */
} TrailStore;

/* Returns false if a shader does not compile; call trail_store_destroy in either case. */
bool trail_store_create(TrailStore *store, const Subject *subject, Error *error);
void trail_store_destroy(TrailStore *store);

/* Takes the present state. */
void trail_store_take(TrailStore *store, const ParticleBuffers *particles, const ViewDef *def);

/* The first element of a column in `places` and `owners`. */
unsigned trail_store_column(const TrailStore *store, uint64_t number);

/* Waits until the CPU may read the mapped buffers and GL has finished all work before the last column. */
void trail_store_wait(TrailStore *store);

/* Binds positions and owners for a program. */
void trail_store_bind(const TrailStore *store);

#endif
