/* Scalars and vectors of particles that no backend writes: computed on the GPU from what every state has, be
   it of a backend or of a file, when a picture asks for them. What is not asked for costs nothing.

   How a pass gets one: whoever draws says in ParticleWants which it reads (the renderer collects them); when
   it draws, `particles->scalar[SCALAR_VORTICITY]` is a buffer of floats,
   `particles->vector[VECTOR_VORTICITY]` one of vec4 whose x y z are the vector in the box's axes (w is
   anyone's), in the order of the other attributes. Buffer 0: it was not asked for, or the state lacks what it
   is made of. By name: scalar_list and vector_list (sim/base/scalar.h), as CHOICE_OF with KEY_INDEX reads
   them.

   Gradients: grad s = M^-1 sum_j w_j (s_j - s_i) d_j, M = sum_j w_j d_j d_j, d_j = x_j - x_i, w_j = V_j
   |W'(r)| / r with Wendland's C2 kernel of the support radius: the sum of Monaghan 2005 (Rep. Prog. Phys. 68)
   with the matrix of Randles and Libersky 1996 and of Bonet and Lok 1999, so that linear fields are
   exact, at walls and free surfaces too. The kernel is the same for all methods, that their pictures may be
   compared. Where M is near singular (spray, sheets) it is widened, and what neighbours do not tell goes to
   0. A neighbour that is no number is left out. Neighbours across periodic sides count. Velocities are those
   in the box's frame.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_DERIVED_H
#define SLOSH_DERIVED_H

#include "render/particles/neighbourhood.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>
#include <stdint.h>

/* PARTICLE_*: what a state must have for it. */
unsigned wants_attributes(const ParticleWants *wants);

/* Where the particles are. */
typedef struct DerivedSpace {
    bool flat; /* two dimensions: volumes are areas, and the vorticity has a sign */
    bool periodic[3];
} DerivedSpace;

/* What sums over neighbours read, as texels in the order of the neighbourhood's. */
typedef struct DerivedPack {
    unsigned program, buffer, texels;
    size_t capacity; /* particles */
} DerivedPack;

/* Zero-initialise it. */
typedef struct Derived {
    unsigned scalar_program[SCALAR_COUNT], vector_program[VECTOR_COUNT]; /* 0 until wanted */
    unsigned scalar_buffer[SCALAR_COUNT], vector_buffer[VECTOR_COUNT];
    size_t scalar_capacity[SCALAR_COUNT], vector_capacity[VECTOR_COUNT]; /* particles */
    bool sorts;                                                          /* `neighbourhood` is there */
    Neighbourhood neighbourhood;
    DerivedPack pack[2];  /* of velocities; of a scalar */
    unsigned births;      /* buffer: the table of ParticleBuffers.births */
    unsigned foam_buffer; /* of derived_trapped_air */
    size_t foam_capacity;
    const char *lacks; /* what the GPU had no memory for since derived_give_back; NULL: nothing */
} Derived;

/* Makes the programs for what is wanted and not there yet. False when a shader does not compile. */
bool derived_follow(Derived *derived, const ParticleWants *wants, Error *error);
void derived_destroy(Derived *derived);

/* Gives the memory back of all that is not wanted; its programs stay. */
void derived_give_back(Derived *derived, const ParticleWants *wants);

/* Of values and of what sums over neighbours read, but for the neighbourhood. */
size_t derived_bytes(const Derived *derived);

/* Computes all that is wanted, derived and not there yet from the rest of `particles`, and writes there where
   it stands: up to the next call. What there is no memory for is not there, and `derived->lacks` names it. */
void derived_fill(Derived *derived, const ParticleWants *wants, const DerivedSpace *space,
                  ParticleBuffers *particles);

/* SCALAR_TRAPPED_AIR of particles that air is near and that are at least so fast, m/s, and 0 of the others,
   which costs next to nothing where all are slower. It is no scalar of the state, which colours are of, and
   not put there. Up to the next call of this. Its program is made by derived_follow; where it can't be made,
   it is what the state has. */
ParticleAttribute derived_trapped_air(Derived *derived, const DerivedSpace *space,
                                      const ParticleBuffers *particles, double slowest);

#endif
