#include "render/particles/work.h"

#include <epoxy/gl.h>

void work_buffer_remake(unsigned *buffer, size_t size, const char *label)
{
    glDeleteBuffers(1, buffer);
    glCreateBuffers(1, buffer);
    glObjectLabel(GL_BUFFER, *buffer, -1, label);
    glNamedBufferStorage(*buffer, (GLsizeiptr)size, NULL, 0);
}

size_t work_capacity(size_t capacity, size_t count)
{
    const size_t more = capacity + capacity / 2;
    return count > more ? count : more;
}

void work_dispatch(size_t groups)
{
    enum { ROW = 32768 };
    const size_t rows = (groups + ROW - 1) / ROW;
    glDispatchCompute((GLuint)(rows > 1 ? ROW : groups), (GLuint)rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void work_run(size_t invocations)
{
    work_dispatch((invocations + 63) / 64);
}
