#include "render/particles/particles.h"

#include "shaders/shared/plane_block.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static double dot_product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to_one(double v[3])
{
    const double length = sqrt(dot_product(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

static void make_axes(const double normal[3], Plane *plane)
{
    double *n = plane->normal, *up = plane->up, *along = plane->along;
    memcpy(n, normal, sizeof plane->normal);
    scale_to_one(n);
    const bool level = fabs(n[1]) > 0.999;
    const double toward[3] = {0, level ? 0 : 1, level ? -1 : 0}, away = dot_product(toward, n);
    for (int k = 0; k < 3; k++)
        up[k] = toward[k] - away * n[k];
    scale_to_one(up);
    along[0] = up[1] * n[2] - up[2] * n[1];
    along[1] = up[2] * n[0] - up[0] * n[2];
    along[2] = up[0] * n[1] - up[1] * n[0];
}

typedef struct PlaneExtent {
    double low[2], high[2]; /* relative to the point, m */
} PlaneExtent;

static void add_point(const Plane *plane, const double from_point[3], PlaneExtent *extent)
{
    const double at[2] = {dot_product(from_point, plane->along), dot_product(from_point, plane->up)};
    for (int k = 0; k < 2; k++) {
        extent->low[k] = fmin(extent->low[k], at[k]);
        extent->high[k] = fmax(extent->high[k], at[k]);
    }
}

/* Corner `number` of the box, relative to the point. */
static void box_corner(const double size[3], const double point[3], int number, double out[3])
{
    out[0] = size[0] * ((number & 1) ? 0.5 : -0.5) - point[0];
    out[1] = ((number & 2) ? size[1] : 0) - point[1];
    out[2] = size[2] * ((number & 4) ? 0.5 : -0.5) - point[2];
}

/* Adds the point where the plane cuts the edge between two corners. */
static void add_edge(const Plane *plane, const double a[3], const double b[3], PlaneExtent *extent)
{
    const double above = dot_product(a, plane->normal), below = dot_product(b, plane->normal);
    if (above * below > 0)
        return;
    if (above == below) { /* the edge lies on the plane */
        add_point(plane, a, extent);
        add_point(plane, b, extent);
        return;
    }
    const double share = above / (above - below);
    double cut[3];
    for (int k = 0; k < 3; k++)
        cut[k] = a[k] + share * (b[k] - a[k]);
    add_point(plane, cut, extent);
}

bool plane_make(const double box_size[3], const double point[3], const double normal[3], Plane *plane)
{
    PlaneExtent extent = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    make_axes(normal, plane);
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 1; axis < 8; axis *= 2)
            if (!(corner & axis)) {
                double a[3], b[3];
                box_corner(box_size, point, corner, a);
                box_corner(box_size, point, corner | axis, b);
                add_edge(plane, a, b, &extent);
            }
    const bool cuts = extent.high[0] > extent.low[0] && extent.high[1] > extent.low[1];
    for (int k = 0; k < 3; k++)
        plane->corner[k] =
            point[k] + (cuts ? extent.low[0] * plane->along[k] + extent.low[1] * plane->up[k] : 0);
    for (int k = 0; k < 2; k++)
        plane->size[k] = cuts ? extent.high[k] - extent.low[k] : 0;
    return cuts;
}

void plane_sample(const Plane *plane, const int samples[2], int column, int row, double at[3])
{
    const double x = plane->size[0] * (column + 0.5) / samples[0],
                 y = plane->size[1] * (row + 0.5) / samples[1];
    for (int k = 0; k < 3; k++)
        at[k] = plane->corner[k] + x * plane->along[k] + y * plane->up[k];
}

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

static void create_sum(PlaneSum *sum)
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

static void fill_block(PlaneSum *sum, const PlaneJob *job)
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

static void draw_quads(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles)
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

bool plane_sum_none(PlaneSum *sum, bool *stale)
{
    static const GLuint unknown = 2;
    GLuint any = unknown;
    if (!sum->asked)
        return sum->none;
    glGetQueryObjectuiv(sum->query, stale ? GL_QUERY_RESULT_NO_WAIT : GL_QUERY_RESULT, &any);
    if (any != unknown) {
        sum->none = !any;
        sum->asked = false;
    }
    if (stale)
        *stale |= sum->asked;
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
    create_sum(sum);
    if (!plane_sum_prepare(sum, job->kernel, error) || !follow_samples(sum, job->samples, error))
        return false;
    fill_block(sum, job); /* showing the sums reads these uniforms too */
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
    draw_quads(sum, job, particles);
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

static bool on_raster(const PlaneSum *sum, const int sample[2])
{
    return sample[0] >= 0 && sample[0] < sum->samples[0] && sample[1] >= 0 && sample[1] < sum->samples[1];
}

static void answer_at_once(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbeRequest *probes)
{
    probe->probes = *probes;
    memset(probe->sums, 0, sizeof probe->sums);
    for (int i = 0; i < probes->count; i++) {
        const int *sample = probes->sample[i];
        if (!on_raster(sum, sample))
            continue;
        const size_t at = (size_t)sample[1] * (size_t)sum->samples[0] + (size_t)sample[0];
        memcpy(probe->sums[i], sum->rows.out + 4 * at, sizeof probe->sums[i]);
    }
}

static void take_answer(PlaneProbe *probe)
{
    const GLsync fence = probe->fence;
    if (!fence || glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0) == GL_TIMEOUT_EXPIRED)
        return;
    glDeleteSync(fence);
    probe->fence = NULL;
    probe->probes = probe->asked;
    glGetNamedBufferSubData(probe->buffer, 0, sizeof probe->sums, probe->sums);
}

static void request_copy(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbeRequest *probes)
{
    static const GLsizei size = sizeof(float[4]);
    if (!probe->buffer) {
        glCreateBuffers(1, &probe->buffer);
        glObjectLabel(GL_BUFFER, probe->buffer, -1, "slice probe");
        glNamedBufferStorage(probe->buffer, sizeof probe->sums, NULL, 0);
    }
    glClearNamedBufferData(probe->buffer, GL_R32F, GL_RED, GL_FLOAT, NULL);
    glMemoryBarrier(GL_PIXEL_BUFFER_BARRIER_BIT); /* as in compute_buffer of sim/gpu/compute */
    glBindBuffer(GL_PIXEL_PACK_BUFFER, probe->buffer);
    for (int i = 0; i < probes->count; i++)
        if (on_raster(sum, probes->sample[i]))
            glGetTextureSubImage(sum->sums, 0, probes->sample[i][0], probes->sample[i][1], 0, 1, 1, 1,
                                 GL_RGBA, GL_FLOAT, size, (char *)NULL + (size_t)size * (size_t)i);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    probe->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    probe->asked = *probes;
}

void plane_probe_request(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbeRequest *probes)
{
    if (sum->by_rows) {
        answer_at_once(probe, sum, probes);
        return;
    }
    take_answer(probe);
    if (!probe->fence && sum->sums)
        request_copy(probe, sum, probes);
}

void plane_probe_destroy(PlaneProbe *probe)
{
    glDeleteBuffers(1, &probe->buffer);
    glDeleteSync(probe->fence);
    *probe = (PlaneProbe){0};
}
