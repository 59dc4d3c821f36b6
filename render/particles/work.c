#include "render/particles/work.h"

#include "shaders/shared/bindings.h"
#include "sim/gl/debug.h"

#include <epoxy/gl.h>

void work_buffer_remake(unsigned *buffer, size_t size, const char *label)
{
    glDeleteBuffers(1, buffer);
    glCreateBuffers(1, buffer);
    glObjectLabel(GL_BUFFER, *buffer, -1, label);
    glNamedBufferStorage(*buffer, (GLsizeiptr)size, NULL, 0);
}

bool work_buffer_ask(unsigned *buffer, size_t size, const char *label)
{
    gl_debug_errors(); /* drops earlier errors: the query below is for this buffer */
    gl_debug_asks_for_memory(true);
    work_buffer_remake(buffer, size, label);
    const bool none = gl_errors_take(GL_OUT_OF_MEMORY) > 0;
    gl_debug_asks_for_memory(false);
    if (none) {
        glDeleteBuffers(1, buffer);
        *buffer = 0;
    }
    return !none;
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

static size_t common_divisor(size_t a, size_t b)
{
    return b ? common_divisor(b, a % b) : a;
}

/* A step near the golden section of the number of groups: at any time the finished groups are spread
   evenly over all. The products stay below 2^32. */
static size_t scatter_step(size_t groups)
{
    size_t step = groups < 65536 ? groups * 618 / 1000 + 1 : 1;
    while (common_divisor(step, groups) > 1)
        step++;
    return step;
}

void work_run_scattered(size_t invocations)
{
    const size_t groups = (invocations + 63) / 64;
    glUniform1ui(SCATTER_STEP_AT, (GLuint)scatter_step(groups));
    work_dispatch(groups);
}
