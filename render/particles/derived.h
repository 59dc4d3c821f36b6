/* Data that pictures derive from a state: scalars and vectors that no backend writes, and ranges of
   scalars. */
#ifndef RENDER_PARTICLES_DERIVED_H
#define RENDER_PARTICLES_DERIVED_H

#include "render/particles/particles.h"

#include "sim/gpu/particle_buffers.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stdint.h>

/* Scalars and vectors of particles that no backend writes: computed on the GPU from data of every state,
   from a backend or a file, when a picture asks. Data that no picture asks for costs nothing.

   A pass adds its wishes to ParticleWants (collected by the renderer). When drawing,
   `particles->scalar[SCALAR_VORTICITY]` is a buffer of floats, and `particles->vector[VECTOR_VORTICITY]` a
   buffer of vec4: x y z in the box's axes, w undefined; both in the order of the other attributes. Buffer
   0: not asked for, or the state lacks the inputs. By name: scalar_list and vector_list
   (include/slosh/world.h), as CHOICE_OF with KEY_INDEX reads names.

   Gradients: grad s = M^-1 sum_j w_j (s_j - s_i) d_j, M = sum_j w_j d_j d_j, d_j = x_j - x_i, w_j = V_j
   |W'(r)| / r with Wendland's C2 kernel of the support radius: the sum of Monaghan 2005 (Rep. Prog. Phys.
   68) with the matrix of Randles and Libersky 1996 and of Bonet and Lok 1999. Linear fields are exact, at
   walls and free surfaces too. All methods use the same kernel, so that pictures can be compared. A nearly
   singular M (spray, sheets) is regularised, and components without information from neighbours go to 0.
   NaN neighbours are left out. Neighbours across periodic sides count. Velocities are relative to the
   box's frame.

   Needs a current OpenGL 4.5 core context. */

/* PARTICLE_*: the attributes that a state needs for `wants`. */
unsigned particle_wants_attributes(const ParticleWants *wants);

/* The space of the particles. */
typedef struct DerivedSpace {
    bool flat; /* two dimensions: volumes are areas, and the vorticity has a sign */
    bool periodic[3];
} DerivedSpace;

/* Neighbour data for sums, as texels in the order of the neighbourhood grid. */
typedef struct DerivedPack {
    unsigned program, buffer, texels;
    size_t capacity; /* particles */
} DerivedPack;

/* Zero-initialise. */
typedef struct Derived {
    unsigned scalar_program[SCALAR_COUNT], vector_program[VECTOR_COUNT]; /* 0 until first wanted */
    unsigned scalar_buffer[SCALAR_COUNT], vector_buffer[VECTOR_COUNT];
    size_t scalar_capacity[SCALAR_COUNT], vector_capacity[VECTOR_COUNT]; /* particles */
    bool sorts;                                                          /* `neighbourhood` has been
                                                                            created */
    Neighbourhood neighbourhood;
    DerivedPack pack[2];  /* of velocities; of a scalar */
    unsigned births;      /* buffer: the table of ParticleBuffers.births */
    unsigned foam_buffer; /* result of derived_trapped_air */
    size_t foam_capacity;
    const char *lacks; /* name of data that did not fit into GPU memory since derived_release; NULL: none */
} Derived;

/* Creates the missing programs for `wants`. Returns false if a shader does not compile. */
bool derived_update(Derived *derived, const ParticleWants *wants, Error *error);
void derived_destroy(Derived *derived);

/* Frees the buffers of all data not in `wants`; programs stay. */
void derived_release(Derived *derived, const ParticleWants *wants);

/* GPU bytes of values and packed neighbour data, without the neighbourhood grid. */
size_t derived_bytes(const Derived *derived);

/* Computes the wanted derived data that `particles` lacks, and stores the buffers in `particles`; valid
   until the next call. Data that does not fit into memory is left out, and `derived->lacks` gives its
   name. */
void derived_fill(Derived *derived, const ParticleWants *wants, const DerivedSpace *space,
                  ParticleBuffers *particles);

/* SCALAR_TRAPPED_AIR, for particles near air with at least the speed `slowest`, m/s; 0 for all others.
   Costs almost nothing if all are slower. The result is not stored in the state, whose scalars colour the
   particles. Valid until the next call of this function. derived_update creates the program; without a
   program, returns the state's own attribute. */
ParticleAttribute derived_trapped_air(Derived *derived, const DerivedSpace *space,
                                      const ParticleBuffers *particles, double slowest);

/* The range of a scalar over all particles, computed on the GPU: one definition for every backend and
   file. The host reads five numbers, waiting or one picture late.

   Needs a current OpenGL 4.5 core context. */

/* Identifies values: a state and its scalar. */
typedef struct RangeSource {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute values;
} RangeSource;

/* A scalar's range that is not waited for. */
typedef struct AsyncRange {
    Mailbox found;
    RangeSource asked, of; /* request in flight; source of `range` */
    ScalarRange range;     /* the last answer */
} AsyncRange;

/* Zero-initialise. */
typedef struct Ranges {
    unsigned count, find; /* programs */
    unsigned bins;        /* buffer, all 0 between two runs */
    Mailbox found;
    AsyncRange late[SCALAR_COUNT]; /* created on first use */
} Ranges;

/* Returns false if a shader does not compile or memory is short; call ranges_destroy in either case. */
bool ranges_create(Ranges *ranges, Error *error);
void ranges_destroy(Ranges *ranges);

/* The range of `count` floats; values that are not finite are left out. All 0, and `any` false, if no
   value is finite. For n values in order, counted from 0, the percentiles are value floor((n - 1) / 100)
   and its mirror: up to 100 values, the ends. */
ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count);

/* As ranges_find, for a state's scalar, without waiting except for the first time. The range may be of an
   earlier state; then *stale becomes true. */
ScalarRange ranges_find_async(Ranges *ranges, Scalar scalar, const ParticleBuffers *particles, bool *stale);

#endif
