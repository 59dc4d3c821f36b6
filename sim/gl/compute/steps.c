/* Stages of a step. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/solve_block.h"

#include <epoxy/gl.h>

void compute_bind(const unsigned *buffers, int count)
{
    for (int k = 0; k < count; k++)
        if (buffers[k])
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)k, buffers[k]);
}

void compute_dispatch(size_t groups)
{
    const size_t rows = (groups + COMPUTE_ALONG - 1) / COMPUTE_ALONG;
    glDispatchCompute((GLuint)(rows > 1 ? COMPUTE_ALONG : groups), (GLuint)rows, 1);
}

void compute_run(const Compute *compute, ComputePass pass, size_t count)
{
    enum { FIRST = CONSTANT_BLOCK }; /* first of five consecutive blocks */
    const GLuint blocks[] = {[CONSTANT_BLOCK - FIRST] = compute->constant_block,
                             [STEP_BLOCK - FIRST] = compute->step,
                             [TERM_BLOCK - FIRST] = compute->terms,
                             [WATCH_BLOCK - FIRST] = compute->watch.buffer,
                             [METHOD_BLOCK - FIRST] = compute->of_method};
    glBindBuffersBase(GL_UNIFORM_BUFFER, FIRST, sizeof blocks / sizeof *blocks, blocks);
    glUseProgram(compute->program[pass]);
    if (compute->decided && pass >= COMPUTE_METHOD) {
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, compute->solve.buffer);
        glDispatchComputeIndirect(offsetof(SolveBlock, groups_along));
    } else
        compute_dispatch((count + COMPUTE_GROUP - 1) / COMPUTE_GROUP);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT);
}

void compute_drift(void *state, const BoxStep *step)
{
    Compute *c = state;
    compute_set_drift(c, step);
    if (step->solids)
        compute_boundary_move(c, step->solids);
    compute_sweep(c, COMPUTE_DRIFT, c->count);
}

void compute_pass(void *state, const Pass *pass, const PassInput *input)
{
    Compute *c = state;
    const ComputePass at = compute_method_pass(c, pass);
    compute_boundary_grid(c); /* a drift may have moved the solids */
    if (c->takes_dt[at])
        glProgramUniform1f(c->program[at], PASS_DT_AT, input->dt);
    if ((pass->stage == STAGE_FORCE || pass->stage == STAGE_INTEGRATE) && input->apparent)
        compute_set_force(c, input);
    if (pass->mirrors && c->constants->solid_count > 0)
        compute_boundary_fill(c);
    compute_sweep(c, at, c->count);
    if (pass->felt)
        compute_feel_solids(c, pass, input->dt);
}

void compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    compute_set_kick(c, gravity, dt);
    compute_sweep(c, COMPUTE_KICK, c->count);
    compute_watch_note(c, dt);
    c->felt.seconds += (double)dt;
}

void compute_touch(void *state, const FingerStep *finger)
{
    const Compute *c = state;
    const GLuint program = c->program[COMPUTE_TOUCH];
    const float *at = finger->at, *v = finger->velocity;
    glProgramUniform4f(program, FINGER_AT, at[0], at[1], at[2], finger->inverse_radius2);
    glProgramUniform4f(program, FINGER_VELOCITY_AT, v[0], v[1], v[2], finger->grip);
    glProgramUniform1f(program, FINGER_KICK_AT, finger->kick);
    compute_sweep(c, COMPUTE_TOUCH, c->count);
}
