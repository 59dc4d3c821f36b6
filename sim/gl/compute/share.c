/* Particles for the views, in the buffers of the steps. Data not stored directly is written by a separate
   pass, only if wanted. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "sim/gl/particle_buffers.h"

#include <epoxy/gl.h>

/* A scalar, the fluid or the id: 4 bytes per particle. */
static ParticleAttribute show(Compute *c, int what)
{
    if (!c->shown[what])
        c->shown[what] = compute_buffer(c, "shown", 4 * c->capacity);
    if (!c->shown[what]) {
        c->full = false;
        return (ParticleAttribute){0};
    }
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [NAMES_BUFFER] = c->now.name, [PRESSURES_BUFFER] = c->pressure, [VALUES_BUFFER] = c->shown[what]);
    glProgramUniform1i(c->program[COMPUTE_SHOW], SHOWN_SCALAR_AT, what);
    compute_run(c, COMPUTE_SHOW, c->count);
    return (ParticleAttribute){c->shown[what], 0, 4};
}

/* A column of the method or a term; nothing if the scene has no column of the name. */
static ParticleAttribute show_own(Compute *c, Scalar scalar)
{
    const int place = columns_place(&c->own.rows, scalar);
    int k = 0;
    while (k < c->own.count && c->own.place[k] != place)
        k++;
    if (k == c->own.count)
        return (ParticleAttribute){0};
    if (!c->shown[scalar])
        c->shown[scalar] = compute_buffer(c, "shown", 4 * c->capacity);
    if (!c->shown[scalar]) {
        c->full = false;
        return (ParticleAttribute){0};
    }
    compute_own_copy_one(c, k, c->shown[scalar]);
    return (ParticleAttribute){c->shown[scalar], 0, 4};
}

void compute_share(void *state, unsigned attributes, ParticleBuffers *out)
{
    Compute *c = state;
    compute_watch_send(c);
    out->position = (ParticleAttribute){c->now.position, 0, 16};
    if (attributes & PARTICLE_VELOCITY)
        out->velocity = (ParticleAttribute){c->now.velocity, 0, 16};
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s))
            out->scalar[s] = s < SCALAR_OWN ? show(c, s) : show_own(c, (Scalar)s);
    if (attributes & PARTICLE_FLUID)
        out->fluid = show(c, COMPUTE_SHOW_FLUID);
    if (attributes & PARTICLE_ID)
        out->id = show(c, COMPUTE_SHOW_ID);
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}
