/* Passes find the state's buffers by the names of storage blocks: a block declared in a shader is bound at
   its declared binding. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>

static const struct {
    const char *block;
    size_t at; /* offset of the buffer's name in Compute */
} named[COMPUTE_NAMED] = {
    {"Positions", offsetof(Compute, now.position)},
    {"Velocities", offsetof(Compute, now.velocity)},
    {"Names", offsetof(Compute, now.name)},
    {"Pressures", offsetof(Compute, pressure)},
    {"Near", offsetof(Compute, near)},
    {"Accelerations", offsetof(Compute, acceleration)},
    {"Own", offsetof(Compute, now.own)},
    {"Scratch", offsetof(Compute, scratch)},
    {"Starts", offsetof(Compute, start)},
    {"Lists", offsetof(Compute, lists)},
    {"DragTables", offsetof(Compute, drag)},
    {"WatchBlock", offsetof(Compute, watch.buffer)},
    {"Felt", offsetof(Compute, felt.buffer)},
    {"SolveBlock", offsetof(Compute, solve.buffer)},
    {"Rests", offsetof(Compute, boundary.rest)},
    {"BoundaryPositions", offsetof(Compute, boundary.position)},
    {"BoundaryVelocities", offsetof(Compute, boundary.velocity)},
    {"BoundaryStates", offsetof(Compute, boundary.state)},
    {"BoundaryStarts", offsetof(Compute, boundary.start)},
};

static int binding_of(GLuint program, const char *block)
{
    const GLuint at = glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, block);
    const GLenum what = GL_BUFFER_BINDING;
    GLint binding = -1;
    if (at != GL_INVALID_INDEX)
        glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, at, 1, &what, 1, NULL, &binding);
    return binding;
}

void compute_find_buffers(Compute *c, ComputePass pass)
{
    const GLuint program = c->program[pass];
    c->takes_dt[pass] = program && glGetUniformLocation(program, "dt") >= 0;
    for (int k = 0; k < COMPUTE_NAMED; k++)
        c->bindings[pass][k] = (int8_t)(program ? binding_of(program, named[k].block) : -1);
    for (int k = 0; k < COMPUTE_BUFFERS; k++) {
        const ShaderBuffer *own = compute_buffer_at(c->constants, k);
        c->bindings[pass][COMPUTE_NAMED + k] =
            (int8_t)(program && own ? binding_of(program, own->block) : -1);
    }
}

static void bind(int binding, unsigned buffer)
{
    if (binding >= 0 && buffer)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)binding, buffer);
}

void compute_sweep(const Compute *c, ComputePass pass, size_t count)
{
    compute_boundary_bind(c);
    for (int k = 0; k < COMPUTE_NAMED; k++)
        bind(c->bindings[pass][k], *(const unsigned *)(const void *)((const char *)c + named[k].at));
    for (int k = 0; k < COMPUTE_BUFFERS; k++)
        bind(c->bindings[pass][COMPUTE_NAMED + k], c->of_shaders[k]);
    compute_run(c, pass, count);
}
