/* The stages of a step. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>
#include <math.h>
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
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, compute->constants);
    glBindBufferBase(GL_UNIFORM_BUFFER, 2, compute->step);
    glUseProgram(compute->program[pass]);
    compute_dispatch((count + COMPUTE_GROUP - 1) / COMPUTE_GROUP);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void compute_drift(void *state, const FrameStep *step)
{
    Compute *c = state;
    compute_set_drift(c, step);
    compute_bind((const unsigned[]){c->now.position, c->now.velocity, c->watch}, 3);
    compute_run(c, COMPUTE_DRIFT, c->count);
}

void compute_density(void *state)
{
    Compute *c = state;
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, 0, 0, 0, c->walls},
                 8);
    compute_run(c, COMPUTE_DENSITY, c->count);
}

void compute_force(void *state, const ApparentGravity *gravity)
{
    Compute *c = state;
    compute_set_force(c, gravity);
    compute_bind((const unsigned[]){c->now.position, c->now.name, c->start, c->pressure, c->now.velocity,
                                    c->acceleration, 0, c->walls},
                 8);
    compute_run(c, COMPUTE_FORCE, c->count);
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

StepWatch compute_kick(void *state, const float gravity[3], float dt)
{
    Compute *c = state;
    static const uint32_t zero[3];
    uint32_t watch[4];
    compute_set_kick(c, gravity, dt);
    glNamedBufferSubData(c->watch, 0, sizeof zero, zero);
    compute_bind((const unsigned[]){c->now.position, c->now.velocity, c->watch, c->acceleration}, 4);
    compute_run(c, COMPUTE_KICK, c->count);
    glGetNamedBufferSubData(c->watch, 0, sizeof watch, watch);
    const float fastest = c->solver->support_radius / dt, speed2 = float_of(watch[0]);
    return (StepWatch){.bounded = speed2 <= fastest * fastest,
                       .max_speed = sqrtf(speed2),
                       .max_acceleration = sqrtf(float_of(watch[1])),
                       .max_compression = float_of(watch[2])};
}
