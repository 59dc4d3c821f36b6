/* Particles of a GPU backend as plain arrays on this side: for initial states, snapshots and reports, never
   within a frame. The backend fills and empties its buffers or textures from them. */
#ifndef SLOSH_GL_TRANSFER_H
#define SLOSH_GL_TRANSFER_H

#include "sim/world/constants.h"
#include "sim/world/world_state.h"

/* Owns its arrays. */
typedef struct Transfer {
    size_t count;
    float *position; /* 4 a particle: x y z (m), volume (m3) */
    float *velocity; /* 4: x y z (m/s), rho / rho0 - 1 where particles carry it, else 0 */
    float *pressure; /* 2: p (Pa), p V^2 */
    uint32_t *name;  /* 2: id, fluid */
} Transfer;

/* Whether it has room for all that the method saves of a particle: none of its own columns. */
bool transfer_holds(const Method *method);

/* Room for `count` particles; false when memory is short. */
bool transfer_make(Transfer *transfer, size_t count);
void transfer_free(Transfer *transfer);

/* In: positions without volumes, velocities and names. */
void transfer_set_initial(Transfer *transfer, const Constants *constants, const InitialState *initial);
void transfer_set_columns(Transfer *transfer, const Constants *constants, const ParticleColumns *from);

/* Out: as world_save, world_read and world_sums want it, `neighbours_mean` excepted. */
void transfer_get_columns(const Transfer *transfer, const Constants *constants, const ParticleColumns *to);
void transfer_get_arrays(const Transfer *transfer, const Constants *constants, const ParticleArrays *out);
void transfer_get_sums(const Transfer *transfer, const Constants *constants, WorldSums *sums);

#endif
