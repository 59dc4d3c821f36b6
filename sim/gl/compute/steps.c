/* The stages of a step. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>

void compute_bind(const unsigned *buffers, int count)
{
    for (int k = 0; k < count; k++)
        if (buffers[k])
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)k, buffers[k]);
}

void compute_dispatch(size_t groups)
{
    enum { ALONG = 65535 };
    const size_t rows = (groups + ALONG - 1) / ALONG;
    glDispatchCompute((GLuint)(rows > 1 ? ALONG : groups), (GLuint)rows, 1);
}

void compute_run(const Compute *compute, ComputePass pass, size_t count)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, CONSTANT_BLOCK, compute->constant_block);
    glBindBufferBase(GL_UNIFORM_BUFFER, STEP_BLOCK, compute->step);
    glBindBufferBase(GL_UNIFORM_BUFFER, TERM_BLOCK, compute->terms);
    glBindBufferBase(GL_UNIFORM_BUFFER, WATCH_BLOCK, compute->watch.buffer);
    glUseProgram(compute->program[pass]);
    compute_dispatch((count + COMPUTE_GROUP - 1) / COMPUTE_GROUP);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT);
}

void compute_drift(void *state, const FrameStep *step)
{
    Compute *c = state;
    compute_set_drift(c, step);
    if (step->solids)
        compute_boundary_move(c, step->solids);
    compute_sweep(c, COMPUTE_DRIFT, c->count);
}

/* Binds what the passes of wcsph read and write, and runs one. */
static void run_wcsph(const Compute *c, ComputePass pass)
{
    compute_boundary_bind(c);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, c->now.velocity,
                                    c->slope, 0, c->boundary.rest},
                 8);
    compute_run(c, pass, c->count);
}

/* As in sim/cpu/wcsph.c: diffusion reads the densities from before the pass, and their gradients, which are
   made once a step for both of its halves. */
void compute_continuity(void *state, float dt)
{
    Compute *c = state;
    if (c->slope)
        run_wcsph(c, c->slopes_due ? COMPUTE_SLOPE : COMPUTE_STATE);
    c->slopes_due = false;
    glProgramUniform1f(c->program[COMPUTE_CONTINUITY], PASS_DT_AT, dt);
    run_wcsph(c, COMPUTE_CONTINUITY);
}

void compute_density(void *state)
{
    Compute *c = state;
    if (c->constants->continuity) {
        run_wcsph(c, COMPUTE_STATE);
        return;
    }
    compute_boundary_bind(c);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, 0, 0, 0, c->walls},
                 8);
    compute_run(c, COMPUTE_DENSITY, c->count);
}

void compute_force(void *state, const ApparentGravity *gravity)
{
    Compute *c = state;
    compute_set_force(c, gravity);
    if (c->constants->solid_count > 0)
        compute_boundary_fill(c);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, c->now.velocity,
                                    c->acceleration, c->uneven, c->walls},
                 8);
    compute_run(c, c->constants->continuity ? COMPUTE_WCSPH_FORCE : COMPUTE_MUELLER_FORCE, c->count);
}

void compute_shift(void *state, float dt)
{
    Compute *c = state;
    glProgramUniform1f(c->program[COMPUTE_SHIFT], PASS_DT_AT, dt);
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [UNEVENS_BUFFER] = c->uneven);
    compute_run(c, COMPUTE_SHIFT, c->count);
}

void compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    compute_set_kick(c, gravity, dt);
    compute_sweep(c, COMPUTE_KICK, c->count);
    compute_watch_send(c, dt);
}
