/* Functions between slosh and the driver: count calls, leave out calls without effect (sim/gpu/gl_known.h),
   and measure programs (gl_programs.c). */
#include "sim/gpu/gl.h"
#include "sim/gpu/gl_known.h"

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

static GLbitfield barrier; /* put off */

static CallKind sent(GLsizeiptr size)
{
    counted.bytes += (uint64_t)size;
    return CALL_OTHER;
}

static bool bound(GLenum target, GLuint buffer)
{
    if (target == GL_PIXEL_PACK_BUFFER)
        counted.pack = buffer;
    return known_target(target, buffer);
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

static bool put_off(GLbitfield bits)
{
    barrier |= bits;
    return true;
}

static void before(CallKind kind);

#define GL_CALL(kind, type, name, parameters, arguments)                                                     \
    static type(GLAPIENTRY *driver_##name) parameters;                                                       \
    static type GLAPIENTRY our_##name parameters                                                             \
    {                                                                                                        \
        before(kind);                                                                                        \
        return driver_##name arguments;                                                                      \
    }
#define GL_SETTING(known, type, name, parameters, arguments)                                                 \
    static type(GLAPIENTRY *driver_##name) parameters;                                                       \
    static type GLAPIENTRY our_##name parameters                                                             \
    {                                                                                                        \
        if (known)                                                                                           \
            return;                                                                                          \
        counted.calls[CALL_OTHER]++;                                                                         \
        driver_##name arguments;                                                                             \
    }
#define GL_RUN(kind, type, name, parameters, arguments)                                                      \
    static type(GLAPIENTRY *driver_##name) parameters;                                                       \
    static type GLAPIENTRY our_##name parameters                                                             \
    {                                                                                                        \
        before(kind);                                                                                        \
        const bool measured = gl_programs_run();                                                             \
        driver_##name arguments;                                                                             \
        gl_programs_ran(measured);                                                                           \
    }
#include "sim/gpu/gl_call_rows.h"
#undef GL_CALL

static void before(CallKind kind)
{
    if (barrier) {
        driver_glMemoryBarrier(barrier);
        counted.calls[CALL_BARRIER]++;
        barrier = 0;
    }
    counted.calls[kind]++;
}

/* Libepoxy calls through pointers; a pointer may not know the function yet. */
static void take_pointers(void)
{
#define GL_CALL(kind, type, name, parameters, arguments)                                                     \
    driver_##name = (__typeof__(driver_##name))eglGetProcAddress(#name);                                     \
    if (driver_##name)                                                                                       \
        epoxy_##name = our_##name;
#include "sim/gpu/gl_call_rows.h"
#undef GL_CALL
}

void gl_calls_begin(void)
{
    known_forget(true);
    barrier = 0;
    if (!driver_glMemoryBarrier && epoxy_has_egl() && eglGetCurrentContext() != EGL_NO_CONTEXT)
        take_pointers();
}

void gl_calls_foreign(void)
{
    if (barrier)
        before(CALL_OTHER);
    known_forget(false);
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
    return all;
}

GlCalls gl_calls_since(const GlCalls *before_them)
{
    const GlCalls now = gl_calls();
    return (GlCalls){.calls = now.calls - before_them->calls,
                     .dispatches = now.dispatches - before_them->dispatches,
                     .draws = now.draws - before_them->draws,
                     .barriers = now.barriers - before_them->barriers,
                     .questions = now.questions - before_them->questions,
                     .waits = now.waits - before_them->waits,
                     .readbacks = now.readbacks - before_them->readbacks,
                     .bytes = now.bytes - before_them->bytes};
}
