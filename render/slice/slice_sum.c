#include "render/slice/slice_sum.h"

#include "render/slice/slice_kernel.h"
#include "shaders/slice/slice_block.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

static bool follow_kernel(SliceSum *sum, const SliceJob *job, Error *error)
{
    static const char *const stages[] = {"slice/slice_sum.vert", "slice/slice_sum.frag", NULL};
    char defines[64];
    if (sum->program && sum->kernel == job->kernel)
        return true;
    glDeleteProgram(sum->program);
    snprintf(defines, sizeof defines, "#define KERNEL %d\n", job->kernel);
    sum->program = program_create("slice sum", stages, defines, error);
    sum->kernel = job->kernel;
    return sum->program != 0;
}

static bool follow_samples(SliceSum *sum, const int samples[2], Error *error)
{
    GLint most = 0;
    if (sum->sums && sum->samples[0] == samples[0] && sum->samples[1] == samples[1])
        return true;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (samples[0] > most || samples[1] > most)
        return error_set(error, "a slice of %d x %d samples; this driver draws %d at most along a side",
                         samples[0], samples[1], most);
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

static void create(SliceSum *sum)
{
    if (sum->framebuffer)
        return;
    glCreateFramebuffers(1, &sum->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, sum->framebuffer, -1, "slice sums");
    glCreateBuffers(1, &sum->uniforms);
    glObjectLabel(GL_BUFFER, sum->uniforms, -1, "slice");
    glNamedBufferStorage(sum->uniforms, sizeof(SliceBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    quad_indices_create(&sum->quads);
}

static void fill(SliceSum *sum, const SliceJob *job)
{
    const SlicePlane *plane = &job->plane;
    const double side[2] = {plane->size[0] / job->samples[0], plane->size[1] / job->samples[1]};
    SliceBlock block = {.slice_support = (float)job->support,
                        .slice_peak = (float)(slice_kernels[job->kernel].norm[job->dimensions - 2] /
                                              pow(job->support, job->dimensions))};
    for (int k = 0; k < 3; k++) {
        block.slice_corner[k] = plane->corner[k];
        block.slice_along[k] = plane->along[k] / side[0];
        block.slice_up[k] = plane->up[k] / side[1];
        block.slice_normal[k] = plane->normal[k] / job->support;
    }
    for (int k = 0; k < 2; k++) {
        block.slice_side[k] = (float)side[k];
        block.slice_samples[k] = (float)job->samples[k];
    }
    glNamedBufferSubData(sum->uniforms, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, SLICE_BLOCK, sum->uniforms);
}

static void draw(SliceSum *sum, const SliceJob *job, const ParticleBuffers *particles)
{
    static const GLfloat none[4] = {0};
    glClearNamedFramebufferfv(sum->framebuffer, GL_COLOR, 0, none);
    fill(sum, job);
    if (!(job->plane.size[0] > 0 && job->plane.size[1] > 0 && job->support > 0))
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, sum->framebuffer);
    glViewport(0, 0, job->samples[0], job->samples[1]);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(sum->program);
    particle_bind(sum->program, particles, job->scalar);
    quad_indices_draw(&sum->quads, particles->count);
    glDisable(GL_BLEND);
}

bool slice_sum_run(SliceSum *sum, const SliceJob *job, const ParticleBuffers *particles, Error *error)
{
    create(sum);
    if (!follow_kernel(sum, job, error) || !follow_samples(sum, job->samples, error))
        return false;
    draw(sum, job, particles);
    return true;
}

void slice_sum_destroy(SliceSum *sum)
{
    glDeleteProgram(sum->program);
    glDeleteFramebuffers(1, &sum->framebuffer);
    glDeleteTextures(1, &sum->sums);
    glDeleteBuffers(1, &sum->uniforms);
    quad_indices_destroy(&sum->quads);
    *sum = (SliceSum){0};
}

void slice_sum_read(const SliceSum *sum, float *out)
{
    const GLsizei bytes = (GLsizei)(4 * sizeof(float)) * sum->samples[0] * sum->samples[1];
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(sum->sums, 0, GL_RGBA, GL_FLOAT, bytes, out);
}

bool slice_empty(const float sums[4])
{
    return !(sums[1] + sums[2] > 0);
}

double slice_value(const float sums[4], bool raw)
{
    if (sums[2] > sums[1])
        return NAN;
    return raw ? (double)sums[0] : (double)sums[0] / (double)sums[1];
}
