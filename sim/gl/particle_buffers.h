/* All that `render` sees of a simulation: one state, in GL buffers. Whoever made the buffers owns them
   (render/particles/upload for the CPU backend, the GPU backends for their own); they stay as they are until
   that owner's next state. */
#ifndef SLOSH_PARTICLE_BUFFERS_H
#define SLOSH_PARTICLE_BUFFERS_H

#include "sim/base/births.h"
#include "sim/base/scalar.h"
#include "sim/box/box_motion.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Which attributes are wanted; positions always are. */
enum {
    PARTICLE_VELOCITY = 1U << SCALAR_STATE_COUNT,
    PARTICLE_FLUID = 1U << (SCALAR_STATE_COUNT + 1),
    PARTICLE_ID = 1U << (SCALAR_STATE_COUNT + 2)
};
#define PARTICLE_SCALAR(scalar) (1U << (scalar)) /* of a state's own */

/* What is read of a state's particles, but for positions. */
typedef struct ParticleWants {
    uint64_t scalars;    /* SCALAR_BIT, the state's own among them */
    uint32_t vectors;    /* VECTOR_BIT */
    unsigned attributes; /* PARTICLE_VELOCITY, PARTICLE_FLUID, PARTICLE_ID */
} ParticleWants;

#define SCALAR_BIT(scalar) (UINT64_C(1) << (scalar))
#define VECTOR_BIT(vector) (UINT32_C(1) << (vector))

/* Where an attribute lies: buffer 0 means that it is not there. */
typedef struct ParticleAttribute {
    unsigned buffer; /* GL name */
    size_t offset;   /* of the first particle, bytes; a multiple of 256 */
    size_t stride;   /* bytes */
} ParticleAttribute;

/* Of a scalar over all particles of a state, in its unit. */
typedef struct ScalarRange {
    double low, high;       /* the 1st and the 99th percentile; where they are one, as the ends: */
    double least, greatest; /* of all that is a number */
    bool known;             /* it was looked for */
    bool any;               /* something is a number; else all four are 0 and say nothing */
} ScalarRange;

typedef struct ParticleBuffers {
    size_t count;
    ParticleAttribute position; /* vec4: x y z in the box's frame (m), volume (m3) */
    ParticleAttribute velocity; /* vec4: x y z in the box's frame (m/s); w is the owner's */
    ParticleAttribute fluid;    /* uint */
    ParticleAttribute id;       /* uint */
    const Births *births;       /* the owner's, by id; NULL: scalar[SCALAR_BORN] says it, or nothing does */
    ParticleAttribute
        scalar[SCALAR_COUNT]; /* float; the derived ones are there in pictures that ask for them */
    ParticleAttribute vector[VECTOR_COUNT]; /* vec4: x y z in the box's axes; in pictures that ask for them */
    ScalarRange range[SCALAR_COUNT];        /* of those that a picture asked for: renderer_derive */
    double spacing;                         /* m */
    double support_radius;                  /* h, m */
    double box_size[3];                     /* m */
    BoxState box;                           /* pose of the same state */
    BoxState floating[SOLIDS_MAX];          /* of solids that float: WorldInfo.floating */
    double gravity[3];                      /* in the box's frame, m/s2 */
    double time;                            /* s */
    uint64_t step;
} ParticleBuffers;

/* What it has of a world's state but for the attributes; these are zero. */
void particle_buffers_describe(const WorldInfo *info, ParticleBuffers *out);

/* The world's particles in the buffers of its backend, where it has them on the GPU: what is there stays
   until its next step. world_shares tells whether it has. */
bool world_shares(const World *world);
void world_share(World *world, unsigned attributes, ParticleBuffers *out);

/* When the world's particles were born; births_copy says when it fails. */
bool world_births(const World *world, Births *to);

#endif
