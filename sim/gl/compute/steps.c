/* The stages of a step. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>
#include <string.h>

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

static void continuity(const Compute *c, float dt)
{
    glProgramUniform1f(c->program[COMPUTE_CONTINUITY], PASS_DT_AT, dt);
    run_wcsph(c, COMPUTE_CONTINUITY);
}

static void density(const Compute *c)
{
    compute_boundary_bind(c);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, 0, 0, 0, c->walls},
                 8);
    compute_run(c, COMPUTE_DENSITY, c->count);
}

static void force(Compute *c, const ApparentGravity *gravity)
{
    compute_set_force(c, gravity);
    if (c->constants->solid_count > 0)
        compute_boundary_fill(c);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, c->now.velocity,
                                    c->acceleration, c->uneven, c->walls},
                 8);
    compute_run(c, c->constants->continuity ? COMPUTE_WCSPH_FORCE : COMPUTE_MUELLER_FORCE, c->count);
}

static void shift(const Compute *c, float dt)
{
    glProgramUniform1f(c->program[COMPUTE_SHIFT], PASS_DT_AT, dt);
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [UNEVENS_BUFFER] = c->uneven);
    compute_run(c, COMPUTE_SHIFT, c->count);
}

void compute_pass(void *state, const Pass *pass, const PassInput *input)
{
    Compute *c = state;
    if (strcmp(pass->name, "density") == 0)
        density(c);
    else if (strcmp(pass->name, "state") == 0)
        run_wcsph(c, COMPUTE_STATE);
    else if (strcmp(pass->name, "slope") == 0)
        run_wcsph(c, COMPUTE_SLOPE);
    else if (strcmp(pass->name, "continuity") == 0)
        continuity(c, input->dt);
    else if (strcmp(pass->name, "force") == 0)
        force(c, input->apparent);
    else if (strcmp(pass->name, "shift") == 0)
        shift(c, input->dt);
}

void compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    compute_set_kick(c, gravity, dt);
    compute_sweep(c, COMPUTE_KICK, c->count);
    compute_watch_send(c, dt);
}
