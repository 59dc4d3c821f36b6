#include "sim/gpu/gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

typedef enum CallKind {
    CALL_OTHER,
    CALL_DISPATCH,
    CALL_DRAW,
    CALL_BARRIER,
    CALL_QUESTION,
    CALL_WAIT,
    CALL_READBACK,
    CALL_KINDS
} CallKind;

static struct {
    uint64_t calls[CALL_KINDS], bytes;
    GLuint pack; /* buffer that takes the pixels that are read; 0: the program waits for the pixels */
} counted;

static bool counting;

static CallKind sent(GLsizeiptr size)
{
    counted.bytes += (uint64_t)size;
    return CALL_OTHER;
}

static CallKind bound(GLenum target, GLuint buffer)
{
    if (target == GL_PIXEL_PACK_BUFFER)
        counted.pack = buffer;
    return CALL_OTHER;
}

static CallKind pixels_read(void)
{
    return counted.pack ? CALL_OTHER : CALL_READBACK;
}

/* A look at a fence without patience is no wait. */
static CallKind waited(GLuint64 nanoseconds)
{
    return nanoseconds > 0 ? CALL_WAIT : CALL_QUESTION;
}

#define GL_CALL(kind, type, name, parameters, arguments)                                                     \
    static type(GLAPIENTRY *real_##name) parameters;                                                         \
    static type(GLAPIENTRY *other_##name) parameters;                                                        \
    static type GLAPIENTRY counted_##name parameters                                                         \
    {                                                                                                        \
        counted.calls[kind]++;                                                                               \
        return real_##name arguments;                                                                        \
    }
#include "sim/gpu/gl_call_rows.h"
#undef GL_CALL

/* Libepoxy calls through pointers; a pointer may not know the function yet. */
static void take_pointers(void)
{
#define GL_CALL(kind, type, name, parameters, arguments)                                                     \
    real_##name = (__typeof__(real_##name))eglGetProcAddress(#name);                                         \
    other_##name = epoxy_##name;                                                                             \
    if (real_##name)                                                                                         \
        epoxy_##name = counted_##name;
#include "sim/gpu/gl_call_rows.h"
#undef GL_CALL
}

static void give_pointers_back(void)
{
#define GL_CALL(kind, type, name, parameters, arguments) epoxy_##name = other_##name;
#include "sim/gpu/gl_call_rows.h"
#undef GL_CALL
}

GlCalls gl_calls(void)
{
    const uint64_t *of = counted.calls;
    GlCalls all = {.dispatches = of[CALL_DISPATCH],
                   .draws = of[CALL_DRAW],
                   .barriers = of[CALL_BARRIER],
                   .questions = of[CALL_QUESTION],
                   .waits = of[CALL_WAIT] + of[CALL_READBACK],
                   .readbacks = of[CALL_READBACK],
                   .bytes = counted.bytes};
    for (int k = 0; k < CALL_KINDS; k++)
        all.calls += of[k];
    if (!counting && (counting = epoxy_has_egl() && eglGetCurrentContext() != EGL_NO_CONTEXT))
        take_pointers();
    return all;
}

GlCalls gl_calls_since(const GlCalls *before)
{
    const GlCalls now = gl_calls();
    return (GlCalls){.calls = now.calls - before->calls,
                     .dispatches = now.dispatches - before->dispatches,
                     .draws = now.draws - before->draws,
                     .barriers = now.barriers - before->barriers,
                     .questions = now.questions - before->questions,
                     .waits = now.waits - before->waits,
                     .readbacks = now.readbacks - before->readbacks,
                     .bytes = now.bytes - before->bytes};
}

void gl_calls_end(void)
{
    if (counting)
        give_pointers_back();
    counting = false;
}
