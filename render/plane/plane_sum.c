#include "render/plane/plane_sum.h"

#include "render/plane/plane_kernel.h"
#include "shaders/shared/plane_block.h"
#include "sim/gl/program.h"
#include "sim/gl/timer.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

bool plane_sum_prepare(PlaneSum *sum, int kernel, Error *error)
{
    static const char *const stages[] = {"render/plane_sum.vert", "render/plane_sum.frag", NULL};
    char defines[64];
    if (sum->program && sum->kernel == kernel)
        return true;
    snprintf(defines, sizeof defines, "#define KERNEL %d\n", kernel);
    const unsigned program = program_create("slice sum", stages, defines, error);
    if (!program)
        return false;
    glDeleteProgram(sum->program);
    sum->program = program;
    sum->kernel = kernel;
    return true;
}

static bool follow_samples(PlaneSum *sum, const int samples[2], Error *error)
{
    GLint most = 0;
    if (sum->sums && sum->samples[0] == samples[0] && sum->samples[1] == samples[1])
        return true;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (samples[0] > most || samples[1] > most)
        return error_set(error, "a slice of %d x %d samples; this driver draws %d at most along a side",
                         samples[0], samples[1], most);
    sum->samples[0] = sum->samples[1] = 0;
    glDeleteTextures(1, &sum->sums);
    glCreateTextures(GL_TEXTURE_2D, 1, &sum->sums);
    glObjectLabel(GL_TEXTURE, sum->sums, -1, "slice sums");
    glTextureStorage2D(sum->sums, 1, GL_RGBA32F, samples[0], samples[1]);
    glTextureParameteri(sum->sums, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(sum->sums, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glNamedFramebufferTexture(sum->framebuffer, GL_COLOR_ATTACHMENT0, sum->sums, 0);
    if (glCheckNamedFramebufferStatus(sum->framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return error_set(error, "no memory for a slice of %d x %d samples", samples[0], samples[1]);
    sum->samples[0] = samples[0], sum->samples[1] = samples[1];
    return true;
}

static void create(PlaneSum *sum)
{
    if (sum->framebuffer)
        return;
    glCreateFramebuffers(1, &sum->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, sum->framebuffer, -1, "slice sums");
    glCreateBuffers(1, &sum->uniforms);
    glObjectLabel(GL_BUFFER, sum->uniforms, -1, "slice");
    glNamedBufferStorage(sum->uniforms, sizeof(PlaneBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    quad_indices_create(&sum->quads);
}

static void fill(PlaneSum *sum, const PlaneJob *job)
{
    const Plane *plane = &job->plane;
    const double side[2] = {plane->size[0] / job->samples[0], plane->size[1] / job->samples[1]};
    PlaneBlock block = {.plane_support = (float)job->support,
                        .plane_peak = (float)(plane_kernels[job->kernel].norm[job->dimensions - 2] /
                                              pow(job->support, job->dimensions))};
    for (int k = 0; k < 3; k++) {
        block.plane_corner[k] = plane->corner[k];
        block.plane_along[k] = plane->along[k] / side[0];
        block.plane_up[k] = plane->up[k] / side[1];
        block.plane_normal[k] = plane->normal[k] / job->support;
    }
    for (int k = 0; k < 2; k++) {
        block.plane_side[k] = (float)side[k];
        block.plane_samples[k] = (float)job->samples[k];
    }
    glNamedBufferSubData(sum->uniforms, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, PLANE_BLOCK, sum->uniforms);
}

static void draw(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles)
{
    glBindFramebuffer(GL_FRAMEBUFFER, sum->framebuffer);
    glViewport(0, 0, job->samples[0], job->samples[1]);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(sum->program);
    particle_bind(sum->program, particles, job->scalar);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, sum->query);
    quad_indices_draw(&sum->quads, particles->count);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_BLEND);
}

bool plane_sum_none(PlaneSum *sum, bool *behind)
{
    static const GLuint unknown = 2;
    GLuint any = unknown;
    if (!sum->asked)
        return sum->none;
    glGetQueryObjectuiv(sum->query, behind ? GL_QUERY_RESULT_NO_WAIT : GL_QUERY_RESULT, &any);
    if (any != unknown) {
        sum->none = !any;
        sum->asked = false;
    }
    if (behind)
        *behind |= sum->asked;
    return sum->none;
}

/* Sums on the CPU and uploads the texture. */
static bool add_rows(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles, Error *error)
{
    if (!plane_rows_run(&sum->rows, job, particles, error))
        return false;
    sum->none = sum->rows.count == 0;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(sum->sums, 0, 0, 0, job->samples[0], job->samples[1], GL_RGBA, GL_FLOAT,
                        sum->rows.out);
    return true;
}

static bool by_rows(const PlaneJob *job)
{
    return job->by == PLANE_ROWS || (job->by == PLANE_AUTO && gl_renderer_is_software());
}

bool plane_sum_run(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles, Error *error)
{
    static const GLfloat none[4] = {0};
    const bool some =
        job->plane.size[0] > 0 && job->plane.size[1] > 0 && job->support > 0 && particles->count > 0;
    create(sum);
    if (!plane_sum_prepare(sum, job->kernel, error) || !follow_samples(sum, job->samples, error))
        return false;
    fill(sum, job); /* showing the sums reads these uniforms too */
    bool lost = false;
    plane_sum_none(sum, &lost); /* takes the pending answer of the previous run */
    sum->asked = false;
    sum->by_rows = some && by_rows(job);
    if (sum->by_rows)
        return add_rows(sum, job, particles, error);
    glClearNamedFramebufferfv(sum->framebuffer, GL_COLOR, 0, none);
    if (!some) {
        sum->none = true;
        return true;
    }
    if (!sum->query)
        glGenQueries(1, &sum->query);
    sum->asked = true;
    draw(sum, job, particles);
    return true;
}

void plane_sum_destroy(PlaneSum *sum)
{
    glDeleteProgram(sum->program);
    glDeleteFramebuffers(1, &sum->framebuffer);
    glDeleteTextures(1, &sum->sums);
    glDeleteBuffers(1, &sum->uniforms);
    quad_indices_destroy(&sum->quads);
    plane_rows_free(&sum->rows);
    glDeleteQueries(1, &sum->query);
    *sum = (PlaneSum){0};
}

void plane_sum_read(const PlaneSum *sum, float *out)
{
    const GLsizei bytes = (GLsizei)(4 * sizeof(float)) * sum->samples[0] * sum->samples[1];
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(sum->sums, 0, GL_RGBA, GL_FLOAT, bytes, out);
}

bool plane_empty(const float sums[4])
{
    return !(sums[1] + sums[2] > 0);
}

double plane_value(const float sums[4], bool raw)
{
    if (sums[2] > sums[1])
        return NAN;
    return raw ? (double)sums[0] : (double)sums[0] / (double)sums[1];
}
