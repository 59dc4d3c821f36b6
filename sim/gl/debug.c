#include "sim/gl/debug.h"

#include <epoxy/gl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

/* The driver calls back from its threads. */
static atomic_int error_count;
static atomic_bool asks_for_memory;
static int forgotten; /* errors before the last gl_debug_install */

enum { MESSAGES = 8 }; /* printed messages; each picture mostly repeats the same kind */

static void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                       const GLchar *message, const void *user)
{
    (void)id, (void)severity, (void)length, (void)user;
    /* program_create reports messages of the shader compiler */
    if (type != GL_DEBUG_TYPE_ERROR || source == GL_DEBUG_SOURCE_SHADER_COMPILER)
        return;
    if (atomic_load(&asks_for_memory) && strstr(message, "OUT_OF_MEMORY"))
        return;
    if (atomic_fetch_add(&error_count, 1) < MESSAGES)
        fprintf(stderr, "GL error: %s\n", message);
}

/* Raises the count to at least `codes`, for drivers without messages. Returns the new count. */
static int count_at_least(int codes)
{
    const int messages = atomic_load(&error_count);
    if (codes > messages)
        atomic_store(&error_count, codes);
    return codes > messages ? codes : messages;
}

int gl_errors_take(unsigned code)
{
    enum { MOST = 32 }; /* without a context, or with a lost context, glGetError never ends */
    int found = 0, others = 0;
    for (int k = 0; k < MOST; k++) {
        const GLenum next = glGetError();
        if (next == GL_NO_ERROR)
            break;
        const bool wanted = code == 0 || next == code;
        found += wanted;
        others += !wanted;
    }
    count_at_least(others);
    return found;
}

void gl_debug_install(void)
{
    gl_errors_take(0);
    forgotten += atomic_exchange(&error_count, 0);
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_message, NULL);
}

void gl_debug_asks_for_memory(bool asks)
{
    atomic_store(&asks_for_memory, asks);
}

int gl_debug_errors(void)
{
    return count_at_least(gl_errors_take(0));
}

int gl_debug_total(void)
{
    return forgotten + atomic_load(&error_count);
}
