/* A float from the bits written by passes. */
#ifndef SIM_GPU_PARTICLE_BUFFERS_H
#define SIM_GPU_PARTICLE_BUFFERS_H

#include "sim/def.h"
#include "sim/state.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* A few numbers on their way from the GPU: a buffer written by passes, and a copy in mapped memory with a
   fence. A wait for the copy does not wait for later GPU commands. */

/* Zero-initialise. */
typedef struct Mailbox {
    unsigned buffer, copy; /* GL names; passes write `buffer` */
    size_t bytes;
    const void *mapped; /* the copy */
    void *fence;        /* fence of the last copy not yet waited for; NULL: none */
} Mailbox;

/* Creates a zeroed buffer of `bytes` with a label; false if memory is short. */
bool mailbox_create(Mailbox *mailbox, const char *label, size_t bytes);
void mailbox_destroy(Mailbox *mailbox); /* a zeroed struct is allowed */

/* The copy alone, with `buffer` 0: the caller copies from other buffers, then calls mailbox_close. */
bool mailbox_create_copy(Mailbox *mailbox, const char *label, size_t bytes);
void mailbox_close(Mailbox *mailbox);

/* Copies the passes' output so far; an earlier copy is lost. */
void mailbox_send(Mailbox *mailbox);

/* Waits for the last copy and returns its memory, valid until the next copy. NULL if no copy was sent since
   the last wait (`fence` is NULL), or the context is lost. */
const void *mailbox_wait(Mailbox *mailbox);

/* The same without waiting: also NULL if the copy has not arrived yet. */
const void *mailbox_look(Mailbox *mailbox);

/* Forgets a sent copy. */
void mailbox_forget(Mailbox *mailbox);

/* The state of a simulation for `render`, in GL buffers. The creator owns the buffers
   (render/particles/upload for the CPU backend, GPU backends for their buffers); contents are valid until the
   owner's next state. */

/* Bits for wanted attributes; positions are always included. */
enum {
    PARTICLE_VELOCITY = 1U << SCALAR_STATE_COUNT,
    PARTICLE_FLUID = 1U << (SCALAR_STATE_COUNT + 1),
    PARTICLE_ID = 1U << (SCALAR_STATE_COUNT + 2)
};
#define PARTICLE_SCALAR(scalar) (1U << (scalar)) /* for a scalar of a state */

/* Data read of a state's particles besides positions. */
typedef struct ParticleWants {
    uint64_t scalars;    /* SCALAR_BIT, including scalars of the state */
    uint32_t vectors;    /* VECTOR_BIT */
    unsigned attributes; /* PARTICLE_VELOCITY, PARTICLE_FLUID, PARTICLE_ID */
    bool foam;           /* a pass derives the inputs of foam while drawing */
    bool neighbours;     /* a pass reads the picture's neighbourhood while drawing */
} ParticleWants;

#define SCALAR_BIT(scalar) (UINT64_C(1) << (scalar))
#define VECTOR_BIT(vector) (UINT32_C(1) << (vector))

/* Location of an attribute; buffer 0: not present. */
typedef struct ParticleAttribute {
    unsigned buffer; /* GL name */
    size_t offset;   /* of the first particle, bytes; a multiple of 256 */
    size_t stride;   /* bytes */
} ParticleAttribute;

/* Range of a scalar over all particles of a state, in the scalar's unit. */
typedef struct ScalarRange {
    double low, high;       /* 1st and 99th percentile; least and greatest if both are equal */
    double least, greatest; /* over all finite values */
    bool known;             /* the range was computed */
    bool any;               /* some value is finite; otherwise all four are 0 without meaning */
} ScalarRange;

typedef struct ParticleBuffers {
    size_t count;
    ParticleAttribute position; /* vec4: x y z in the box's frame (m), volume (m3) */
    ParticleAttribute velocity; /* vec4: x y z in the box's frame (m/s); w is private to the owner */
    ParticleAttribute fluid;    /* uint */
    ParticleAttribute id;       /* uint */
    const Births *births;       /* owned by the world, by id; NULL: see scalar[SCALAR_BORN], or unknown */
    ParticleAttribute scalar[SCALAR_COUNT]; /* float; derived scalars only in pictures that use them */
    ParticleAttribute vector[VECTOR_COUNT]; /* vec4: x y z in the box's axes; in pictures that use them */
    ScalarRange range[SCALAR_COUNT];        /* of scalars requested by a picture: renderer_derive */
    double spacing;                         /* m */
    double support_radius;                  /* h, m */
    double box_size[3];                     /* m */
    BoxState box;                           /* pose of the same state */
    BoxState floating[SOLIDS_MAX];          /* floating solids: WorldInfo.floating */
    double gravity[3];                      /* in the box's frame, m/s2 */
    double time;                            /* s */
    uint64_t step;
} ParticleBuffers;

/* Fills in a world's state except attributes, which are 0. */
void particle_buffers_describe(const WorldInfo *info, ParticleBuffers *out);

/* world_shares: true if the backend has the particles on the GPU. world_share: the particles in the
   backend's buffers, valid until the next step. */
bool world_shares(const World *world);
void world_share(World *world, unsigned attributes, ParticleBuffers *out);

/* Copies the births of the world's particles; false like births_copy. */
bool world_births(const World *world, Births *to);

#endif
