#include "sim/gpu/gl.h"
#include "sim/step/backend.h"

#include <epoxy/gl.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The driver calls back from its threads. */
static atomic_int error_count;
static int forgotten; /* errors before the last gl_context_begin */

enum { MESSAGES = 8 }; /* printed messages; each picture mostly repeats the same kind */

static void count_message(const char *message)
{
    if (atomic_fetch_add(&error_count, 1) < MESSAGES)
        fprintf(stderr, "GL error: %s\n", message);
}

/* Lack of memory is counted by the code of glGetError: the maker of a buffer takes the code. */
static void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                       const GLchar *message, const void *user)
{
    (void)id, (void)severity, (void)length, (void)user;
    /* program_create reports messages of the shader compiler */
    if (type == GL_DEBUG_TYPE_ERROR && source != GL_DEBUG_SOURCE_SHADER_COMPILER &&
        !strstr(message, "OUT_OF_MEMORY"))
        count_message(message);
}

/* Raises the count to at least `codes`, for drivers without messages. */
static void count_at_least(int codes)
{
    if (codes > atomic_load(&error_count))
        atomic_store(&error_count, codes);
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

void gl_context_begin(void)
{
    gl_calls_begin();
    if (epoxy_has_gl_extension("GL_KHR_parallel_shader_compile"))
        glMaxShaderCompilerThreadsKHR(UINT32_MAX);
    else if (epoxy_has_gl_extension("GL_ARB_parallel_shader_compile"))
        glMaxShaderCompilerThreadsARB(UINT32_MAX);
    gl_errors_take(0);
    forgotten += atomic_exchange(&error_count, 0);
    glEnable(GL_DEBUG_OUTPUT);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_FALSE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, NULL, GL_TRUE);
    glDebugMessageCallback(on_message, NULL);
}

int gl_debug_errors(void)
{
    if (gl_errors_take(GL_OUT_OF_MEMORY) > 0)
        count_message("the GPU has no memory for what was asked");
    return atomic_load(&error_count);
}

int gl_debug_total(void)
{
    return forgotten + atomic_load(&error_count);
}

GlLimits gl_limits(void)
{
    GLint64 bytes = 0;
    GlLimits limits = {0};
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &limits.compute_blocks);
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &limits.vertex_blocks);
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &limits.bindings);
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    limits.block_bytes = bytes;
    return limits;
}

double gl_memory(void)
{
    GLint kib = 0;
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, &kib);
    return kib > 0 ? 1024.0 * kib : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

bool gl_limits_allow(const GlLimits *have, const GlNeeds *needs, Error *error)
{
    const GlLimits *least = &needs->least;
    const struct {
        const char *what;
        int least, have;
    } counts[] = {{"storage blocks in a compute shader", least->compute_blocks, have->compute_blocks},
                  {"storage blocks in a vertex shader", least->vertex_blocks, have->vertex_blocks},
                  {"bindings of storage buffers", least->bindings, have->bindings}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        if (counts[k].have < counts[k].least)
            return error_set(error, "%s needs %d %s, and this driver has %d; %s", needs->who, counts[k].least,
                             counts[k].what, counts[k].have, needs->instead);
    if (have->block_bytes < least->block_bytes)
        return error_set(
            error,
            "%s needs a buffer of %lld bytes for this scene, and this driver allows shaders %lld; use a larger "
            "particles.spacing",
            needs->who, (long long)least->block_bytes, (long long)have->block_bytes);
    return true;
}

static const GLenum capabilities[GL_STATE_CAPABILITIES] = {
    GL_DEPTH_TEST,         GL_STENCIL_TEST, GL_BLEND,          GL_SCISSOR_TEST,    GL_CULL_FACE,
    GL_PROGRAM_POINT_SIZE, GL_DEPTH_CLAMP,  GL_COLOR_LOGIC_OP, GL_SAMPLE_COVERAGE, GL_RASTERIZER_DISCARD};

static const GLenum stencil_names[7] = {GL_STENCIL_FUNC,
                                        GL_STENCIL_REF,
                                        GL_STENCIL_VALUE_MASK,
                                        GL_STENCIL_FAIL,
                                        GL_STENCIL_PASS_DEPTH_FAIL,
                                        GL_STENCIL_PASS_DEPTH_PASS,
                                        GL_STENCIL_WRITEMASK};

static void keep(GlState *s)
{
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->framebuffer);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    glGetIntegerv(GL_VIEWPORT, s->viewport);
    glGetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
    glGetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
    glGetIntegerv(GL_DEPTH_FUNC, &s->depth_function);
    glGetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    for (int i = 0; i < 7; i++)
        glGetIntegerv(stencil_names[i], &s->stencil[i]);
    glGetFloatv(GL_DEPTH_RANGE, s->depth_range);
    glGetFloatv(GL_POINT_SIZE, &s->point_size);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    glGetBooleanv(GL_COLOR_WRITEMASK, s->color_mask);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        s->enabled[i] = glIsEnabled(capabilities[i]);
}

void gl_state_keep(GlState *kept)
{
    if (kept->depth++ == 0)
        keep(kept);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        glDisable(capabilities[i]);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0, 1);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilMask(0xff);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPointSize(1);
}

void gl_state_restore(GlState *kept)
{
    if (--kept->depth > 0)
        return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)kept->framebuffer);
    glBindVertexArray((GLuint)kept->vertex_array);
    glViewport(kept->viewport[0], kept->viewport[1], kept->viewport[2], kept->viewport[3]);
    glClipControl((GLenum)kept->clip_origin, (GLenum)kept->clip_depth);
    glDepthFunc((GLenum)kept->depth_function);
    glPolygonMode(GL_FRONT_AND_BACK, (GLenum)kept->polygon_mode[0]);
    glStencilFunc((GLenum)kept->stencil[0], kept->stencil[1], (GLuint)kept->stencil[2]);
    glStencilOp((GLenum)kept->stencil[3], (GLenum)kept->stencil[4], (GLenum)kept->stencil[5]);
    glStencilMask((GLuint)kept->stencil[6]);
    glDepthRange((GLdouble)kept->depth_range[0], (GLdouble)kept->depth_range[1]);
    glPointSize(kept->point_size);
    glDepthMask(kept->depth_mask);
    glColorMask(kept->color_mask[0], kept->color_mask[1], kept->color_mask[2], kept->color_mask[3]);
    for (int i = 0; i < GL_STATE_CAPABILITIES; i++)
        (kept->enabled[i] ? glEnable : glDisable)(capabilities[i]);
}

void backends_add(void)
{
    backend_add(&backend_compute);
    backend_add(&backend_fragment);
}
