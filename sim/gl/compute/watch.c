/* What the kicks of a frame found, read when the next one begins: a copy in mapped memory, behind a fence, so
   that nothing waits for what was asked of the GPU since. And the state that the sentinel goes back to. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

enum { WATCH_BYTES = 4 * sizeof(uint32_t), GREATEST_BYTES = 3 * sizeof(uint32_t) };

void compute_watch_create(Compute *c)
{
    const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    c->watch = compute_buffer(c, "watch", WATCH_BYTES);
    glCreateBuffers(1, &c->watch_copy);
    glObjectLabel(GL_BUFFER, c->watch_copy, -1, "watch, read");
    glNamedBufferStorage(c->watch_copy, WATCH_BYTES, NULL, access | GL_CLIENT_STORAGE_BIT);
    c->watched = glMapNamedBufferRange(c->watch_copy, 0, WATCH_BYTES, access);
}

void compute_watch_keep(Compute *c, float dt)
{
    c->longest = fmaxf(c->longest, dt);
    glCopyNamedBufferSubData(c->watch, c->watch_copy, 0, 0, WATCH_BYTES);
    glDeleteSync(c->watch_fence);
    c->watch_fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void compute_watch_reset(Compute *c, size_t guarded)
{
    glClearNamedBufferData(c->watch, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glDeleteSync(c->watch_fence);
    c->watch_fence = NULL;
    c->longest = 0;
    c->guarded_before = guarded;
    c->guarded = 0;
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

StepWatch compute_watch(void *state)
{
    Compute *c = state;
    if (!c->watch_fence)
        return (StepWatch){.bounded = true};
    while (glClientWaitSync(c->watch_fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000) == GL_TIMEOUT_EXPIRED)
        continue;
    glDeleteSync(c->watch_fence);
    c->watch_fence = NULL;
    const float fastest = c->solver->support_radius / c->longest, speed2 = float_of(c->watched[0]);
    const StepWatch seen = {.bounded = speed2 <= fastest * fastest,
                            .max_speed = sqrtf(speed2),
                            .max_acceleration = sqrtf(float_of(c->watched[1])),
                            .max_compression = float_of(c->watched[2])};
    c->guarded = c->watched[3];
    c->longest = 0;
    glClearNamedBufferSubData(c->watch, GL_R32UI, 0, GREATEST_BYTES, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    return seen;
}

static void copy_particles(const Compute *c, const ComputeParticles *from, const ComputeParticles *to)
{
    glCopyNamedBufferSubData(from->position, to->position, 0, 0, (GLsizeiptr)(16 * c->count));
    glCopyNamedBufferSubData(from->velocity, to->velocity, 0, 0, (GLsizeiptr)(16 * c->count));
    glCopyNamedBufferSubData(from->name, to->name, 0, 0, (GLsizeiptr)(8 * c->count));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

bool compute_mark(void *state, Error *error)
{
    Compute *c = state;
    if (!c->marked.position && !compute_particles_create(c, &c->marked, error))
        return false;
    copy_particles(c, &c->now, &c->marked);
    return true;
}

void compute_back(void *state, size_t count, size_t guarded)
{
    Compute *c = state;
    c->count = count;
    copy_particles(c, &c->marked, &c->now);
    compute_watch_reset(c, guarded);
}
