/* What a step asks of the driver: dispatches, draws, barriers, questions about the context's state, and all
   calls together. docs/performance.md has the figures that this prints. */
#include "tests/gl/compare.h"

#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/wcsph/wcsph.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

typedef enum Call {
    CALL_OTHER,
    CALL_DISPATCH,
    CALL_DRAW,
    CALL_BARRIER,
    CALL_QUESTION,
    CALL_WAIT,
    CALL_KINDS
} Call;

/* Those that a step makes. X(kind, type, name, parameters, arguments); what the program calls goes through
   these pointers. */
#define CALLS(X)                                                                                             \
    X(DISPATCH, void, glDispatchCompute, (GLuint a, GLuint b, GLuint c), (a, b, c))                          \
    X(DISPATCH, void, glDispatchComputeIndirect, (GLintptr a), (a))                                          \
    X(DRAW, void, glDrawArrays, (GLenum a, GLint b, GLsizei c), (a, b, c))                                   \
    X(DRAW, void, glDrawTransformFeedback, (GLenum a, GLuint b), (a, b))                                     \
    X(BARRIER, void, glMemoryBarrier, (GLbitfield a), (a))                                                   \
    X(BARRIER, void, glTextureBarrier, (void), ())                                                           \
    X(QUESTION, void, glGetIntegerv, (GLenum a, GLint * b), (a, b))                                          \
    X(QUESTION, void, glGetFloatv, (GLenum a, GLfloat * b), (a, b))                                          \
    X(QUESTION, void, glGetBooleanv, (GLenum a, GLboolean * b), (a, b))                                      \
    X(QUESTION, GLboolean, glIsEnabled, (GLenum a), (a))                                                     \
    X(QUESTION, GLint, glGetUniformLocation, (GLuint a, const GLchar *b), (a, b))                            \
    X(OTHER, void, glBindBufferBase, (GLenum a, GLuint b, GLuint c), (a, b, c))                              \
    X(OTHER, void, glBindBuffersBase, (GLenum a, GLuint b, GLsizei c, const GLuint *d), (a, b, c, d))        \
    X(OTHER, void, glUseProgram, (GLuint a), (a))                                                            \
    X(OTHER, void, glUniform1ui, (GLint a, GLuint b), (a, b))                                                \
    X(OTHER, void, glProgramUniform1i, (GLuint a, GLint b, GLint c), (a, b, c))                              \
    X(OTHER, void, glProgramUniform2ui, (GLuint a, GLint b, GLuint c, GLuint d), (a, b, c, d))               \
    X(OTHER, void, glProgramUniform1f, (GLuint a, GLint b, GLfloat c), (a, b, c))                            \
    X(OTHER, void, glProgramUniform3fv, (GLuint a, GLint b, GLsizei c, const GLfloat *d), (a, b, c, d))      \
    X(OTHER, void, glNamedBufferSubData, (GLuint a, GLintptr b, GLsizeiptr c, const void *d), (a, b, c, d))  \
    X(OTHER, void, glClearNamedBufferData, (GLuint a, GLenum b, GLenum c, GLenum d, const void *e),          \
      (a, b, c, d, e))                                                                                       \
    X(OTHER, void, glCopyNamedBufferSubData, (GLuint a, GLuint b, GLintptr c, GLintptr d, GLsizeiptr e),     \
      (a, b, c, d, e))                                                                                       \
    X(WAIT, void, glGetNamedBufferSubData, (GLuint a, GLintptr b, GLsizeiptr c, void *d), (a, b, c, d))      \
    X(WAIT, GLenum, glClientWaitSync, (GLsync a, GLbitfield b, GLuint64 c), (a, b, c))                       \
    X(OTHER, GLsync, glFenceSync, (GLenum a, GLbitfield b), (a, b))                                          \
    X(OTHER, void, glDeleteSync, (GLsync a), (a))                                                            \
    X(OTHER, void, glEnable, (GLenum a), (a))                                                                \
    X(OTHER, void, glDisable, (GLenum a), (a))                                                               \
    X(OTHER, void, glClipControl, (GLenum a, GLenum b), (a, b))                                              \
    X(OTHER, void, glDepthRange, (GLdouble a, GLdouble b), (a, b))                                           \
    X(OTHER, void, glDepthMask, (GLboolean a), (a))                                                          \
    X(OTHER, void, glDepthFunc, (GLenum a), (a))                                                             \
    X(OTHER, void, glColorMask, (GLboolean a, GLboolean b, GLboolean c, GLboolean d), (a, b, c, d))          \
    X(OTHER, void, glStencilMask, (GLuint a), (a))                                                           \
    X(OTHER, void, glStencilFunc, (GLenum a, GLint b, GLuint c), (a, b, c))                                  \
    X(OTHER, void, glStencilOp, (GLenum a, GLenum b, GLenum c), (a, b, c))                                   \
    X(OTHER, void, glPolygonMode, (GLenum a, GLenum b), (a, b))                                              \
    X(OTHER, void, glPointSize, (GLfloat a), (a))                                                            \
    X(OTHER, void, glViewport, (GLint a, GLint b, GLsizei c, GLsizei d), (a, b, c, d))                       \
    X(OTHER, void, glBindBuffer, (GLenum a, GLuint b), (a, b))                                               \
    X(OTHER, void, glBindFramebuffer, (GLenum a, GLuint b), (a, b))                                          \
    X(OTHER, void, glBindVertexArray, (GLuint a), (a))                                                       \
    X(OTHER, void, glBindTextureUnit, (GLuint a, GLuint b), (a, b))                                          \
    X(OTHER, void, glNamedFramebufferTexture, (GLuint a, GLenum b, GLuint c, GLint d), (a, b, c, d))         \
    X(OTHER, void, glNamedFramebufferDrawBuffers, (GLuint a, GLsizei b, const GLenum *c), (a, b, c))         \
    X(OTHER, void, glClearBufferuiv, (GLenum a, GLint b, const GLuint *c), (a, b, c))                        \
    X(OTHER, void, glClearBufferfi, (GLenum a, GLint b, GLfloat c, GLint d), (a, b, c, d))                   \
    X(OTHER, void, glBeginQuery, (GLenum a, GLuint b), (a, b))                                               \
    X(OTHER, void, glEndQuery, (GLenum a), (a))                                                              \
    X(OTHER, void, glBeginConditionalRender, (GLuint a, GLenum b), (a, b))                                   \
    X(OTHER, void, glEndConditionalRender, (void), ())                                                       \
    X(OTHER, void, glBindTransformFeedback, (GLenum a, GLuint b), (a, b))                                    \
    X(OTHER, void, glBeginTransformFeedback, (GLenum a), (a))                                                \
    X(OTHER, void, glEndTransformFeedback, (void), ())                                                       \
    X(OTHER, void, glGetTextureImage, (GLuint a, GLint b, GLenum c, GLenum d, GLsizei e, void *f),           \
      (a, b, c, d, e, f))

static int calls[CALL_KINDS];

#define X(kind, type, name, parameters, arguments)                                                           \
    static type(APIENTRY *real_##name) parameters;                                                           \
    static type APIENTRY counted_##name parameters                                                           \
    {                                                                                                        \
        calls[CALL_##kind]++;                                                                                \
        return real_##name arguments;                                                                        \
    }
CALLS(X)
#undef X

/* What goes to buffers, and from one to another: what is read back is among the latter. */
static long bytes;

static void APIENTRY sized_glNamedBufferSubData(GLuint a, GLintptr b, GLsizeiptr c, const void *d)
{
    bytes += c;
    counted_glNamedBufferSubData(a, b, c, d);
}

static void APIENTRY sized_glCopyNamedBufferSubData(GLuint a, GLuint b, GLintptr c, GLintptr d, GLsizeiptr e)
{
    bytes += e;
    counted_glCopyNamedBufferSubData(a, b, c, d, e);
}

static void counting(bool on)
{
#define X(kind, type, name, parameters, arguments)                                                           \
    real_##name = (__typeof__(real_##name))eglGetProcAddress(#name);                                         \
    epoxy_##name = on ? counted_##name : real_##name;
    CALLS(X)
#undef X
    if (on) {
        epoxy_glNamedBufferSubData = sized_glNamedBufferSubData;
        epoxy_glCopyNamedBufferSubData = sized_glCopyNamedBufferSubData;
    }
}

/* Of one step at most so many. */
typedef struct Bounds {
    int passes, questions, calls;
    int waits; /* of a frame of four steps */
} Bounds;

/* In the second frame of a world, of four steps. */
static void count_step(const char *label, const WorldDef *def, Bounds most)
{
    enum { SUBSTEPS = 4 };
    Error error = {0};
    int all = 0;
    WorldDef four = *def;
    four.substeps = SUBSTEPS;
    four.dt *= SUBSTEPS;
    World *world = fixture_world(&four);
    fixture_step(world, 1);
    memset(calls, 0, sizeof calls);
    bytes = 0;
    counting(true);
    const bool good = world_step(world, NULL, &error);
    counting(false);
    assert_true(good);
    for (int k = 0; k < CALL_KINDS; k++)
        all += calls[k];
    printf(
        "%s: %.1f calls a step: %.1f dispatches, %.1f draws, %.1f barriers, %.1f questions; %ld bytes; %d waits "
        "a frame\n",
        label, all / (double)SUBSTEPS, calls[CALL_DISPATCH] / (double)SUBSTEPS,
        calls[CALL_DRAW] / (double)SUBSTEPS, calls[CALL_BARRIER] / (double)SUBSTEPS,
        calls[CALL_QUESTION] / (double)SUBSTEPS, bytes / SUBSTEPS, calls[CALL_WAIT]);
    /* and for a look at the energy, at most once a frame, a wait and one or two passes */
    assert_in_range(calls[CALL_DISPATCH] + calls[CALL_DRAW], 1, SUBSTEPS * most.passes + 2);
    assert_in_range(calls[CALL_QUESTION], 0, SUBSTEPS * most.questions + (most.questions > 0 ? 30 : 0));
    assert_in_range(all, 1, SUBSTEPS * most.calls + 40);
    assert_in_range(calls[CALL_WAIT], 0, most.waits + 1);
    assert_in_range(bytes, 1, SUBSTEPS * 9216); /* parts of sums, with the energy sums; no particles */
    world_destroy(world);
}

static WorldDef pool_def(const char *backend, const char *method)
{
    WorldDef def = fixture_def(0.8, 0.6, 0.5);
    def.sound_speed = 20;
    def.dt = 0.0005;
    def.retries = 3;
    def.reproducible = false;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    snprintf(def.method, sizeof def.method, "%s", method);
    fixture_block(&def, 0, -0.4, 0, -0.25, 0.2, 0.3, 0.25);
    return def;
}

static void a_step_makes_so_many_calls(void **state)
{
    (void)state;
    WorldDef def = pool_def("compute", "mueller");
    count_step("compute, mueller", &def, (Bounds){9, 0, 100, 1});
    def.reproducible = true;
    count_step("compute, mueller, reproducible", &def, (Bounds){10, 0, 110, 1});
    def = pool_def("compute", "wcsph");
    count_step("compute, wcsph", &def, (Bounds){11, 0, 110, 1});
    wcsph_def(&def)->delta_sph = wcsph_def(&def)->shifting = 0.1;
    count_step("compute, wcsph, delta_sph, shifting", &def, (Bounds){13, 0, 145, 1});
    /* A wait each solver and step: it asks at once for as many iterations as the step before had, and more.
     */
    def = pool_def("compute", "dfsph");
    def.dt = 0.002;
    dfsph_def(&def)->iterations = 1;
    count_step("compute, dfsph, one iteration each", &def, (Bounds){31, 0, 300, 9});
    dfsph_def(&def)->iterations = 100;
    dfsph_def(&def)->tolerance = dfsph_def(&def)->divergence_tolerance = 1e-6;
    count_step("compute, dfsph", &def, (Bounds){150, 0, 1400, 10});
    def = pool_def("compute", "pbf");
    def.dt = 1.0 / 60;
    count_step("compute, pbf", &def, (Bounds){60, 0, 600, 6});
    def = pool_def("fragment", "mueller");
    count_step("fragment, mueller", &def, (Bounds){44, 43, 620, 1}); /* the energy sums among them */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_step_makes_so_many_calls, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.calls", tests, compare_setup, context_teardown);
}
