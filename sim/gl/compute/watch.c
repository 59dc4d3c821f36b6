/* Findings of a frame's kicks, read at the begin of the next frame, and the state marked for the sentinel. */
#include "sim/gl/compute/compute.h"
#include "sim/gl/float_bits.h"

#include "shaders/sim/watch_block.h"

#include <epoxy/gl.h>
#include <math.h>

/* The longest step since the last read bounds the distance per step. */
void compute_watch_note(Compute *c, float dt)
{
    c->longest = fmaxf(c->longest, dt);
    c->watch_due = true;
}

void compute_watch_send(Compute *c)
{
    if (c->watch_due)
        mailbox_send(&c->watch);
    c->watch_due = false;
}

void compute_watch_reset(Compute *c, size_t guarded)
{
    glClearNamedBufferData(c->watch.buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    mailbox_forget(&c->watch);
    c->watch_due = false;
    c->longest = 0;
    c->guarded_before = guarded;
    c->guarded = 0;
}

StepWatch compute_watch(void *state)
{
    Compute *c = state;
    compute_watch_send(c);
    if (!c->watch.fence)
        return (StepWatch){.bounded = true};
    const WatchBlock *watched = mailbox_wait(&c->watch);
    if (!watched)
        return (StepWatch){.bounded = false};
    const bool leaps = c->constants->method->leaps;
    const float fastest = leaps ? 1e18F : c->constants->support_radius / c->longest,
                speed2 = float_of_bits(watched->greatest_speed2);
    const StepWatch seen = {.bounded = watched->went_too_far == 0 && speed2 <= fastest * fastest,
                            .max_speed = sqrtf(speed2),
                            .max_acceleration = sqrtf(float_of_bits(watched->greatest_acceleration2)),
                            .max_density_ratio = float_of_bits(watched->greatest_density_ratio)};
    c->guarded = watched->guarded;
    c->longest = 0;
    glClearNamedBufferSubData(c->watch.buffer, GL_R32UI, 0, offsetof(WatchBlock, guarded), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, NULL);
    return seen;
}

bool compute_mark(void *state, Error *error)
{
    Compute *c = state;
    if (!c->marked.position && !compute_particles_create(c, &c->marked, error)) {
        compute_particles_destroy(&c->marked);
        c->marked = (ComputeParticles){0};
        return c->full = false;
    }
    compute_particles_copy(c, c->now, c->marked);
    compute_felt_mark(c);
    return true;
}

void compute_back(void *state, size_t count, size_t guarded)
{
    Compute *c = state;
    compute_set_count(c, count);
    compute_particles_copy(c, c->marked, c->now);
    compute_felt_back(c);
    compute_watch_reset(c, guarded);
}
