#include "render/overlays/streamlines/streamlines_private.h"

#include "render/frame/frame.h"
#include "shaders/shared/bindings.h"
#include "shaders/streamlines/streamlines_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { USUAL_SEEDS = 16 };

bool stream_lines_create(StreamLines *lines, Error *error)
{
    static const char *const files[] = {"streamlines/streamlines_trace.comp", NULL};
    lines->fastest = program_create("fastest seed of streamlines", files, "#define FASTEST 1\n", error);
    lines->trace = lines->fastest ? program_create("tracing of streamlines", files, NULL, error) : 0;
    return lines->trace != 0;
}

void stream_lines_destroy(StreamLines *lines)
{
    glDeleteProgram(lines->fastest);
    glDeleteProgram(lines->trace);
    glDeleteBuffers(3, (GLuint[]){lines->speed, lines->points, lines->no_scalar});
    *lines = (StreamLines){0};
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* True if both give the same lines. */
static bool same_def(const StreamlinesDef *a, const StreamlinesDef *b)
{
    return a->at == b->at && a->in_plane == b->in_plane && a->cell == b->cell && a->length == b->length &&
           a->step == b->step && a->slowest == b->slowest && same3(a->plane_point, b->plane_point) &&
           same3(a->plane_normal, b->plane_normal);
}

static bool same_buffer(const ParticleAttribute *a, const ParticleAttribute *b)
{
    return a->buffer == b->buffer && a->offset == b->offset;
}

static bool same_source(const StreamSource *a, const StreamSource *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count && a->scalar == b->scalar &&
           same_buffer(&a->vectors, &b->vectors) && same_buffer(&a->shown, &b->shown) &&
           same_def(&a->def, &b->def);
}

/* Returns false if there are no seeds: the plane misses the box. */
static bool make_seeds(StreamLines *lines, const ParticleBuffers *particles, const StreamlinesDef *def,
                       Plane *plane)
{
    const double *box = particles->box_size, longest = fmax(box[0], fmax(box[1], box[2]));
    const bool on_plane = def->at == STREAMLINES_PLANE;
    const double length = def->length > 0 ? def->length : longest;
    lines->step = def->step > 0 ? def->step : particles->spacing;
    if (!(lines->step > 0) || (on_plane && !plane_make(box, def->plane_point, def->plane_normal, plane)))
        return false;
    lines->shorter = length / lines->step > STREAM_STEPS_MOST;
    lines->steps = (int)fmax(1, fmin(ceil(length / lines->step - 1e-6), STREAM_STEPS_MOST));
    sample_grid_make(&lines->seeds, box, on_plane ? plane : NULL,
                     def->cell > 0 ? def->cell : longest / USUAL_SEEDS,
                     STREAM_POINTS_MOST / (2.0 * lines->steps + 1));
    lines->lines = sample_grid_places(&lines->seeds);
    return true;
}

static void reserve(StreamLines *lines, size_t points)
{
    static const uint32_t none = 0;
    if (!lines->no_scalar)
        work_buffer_remake(&lines->no_scalar, sizeof(uint32_t[4]), "streamlines without a scalar");
    if (!lines->speed)
        work_buffer_remake(&lines->speed, sizeof(uint32_t[4]), "streamlines' fastest seed");
    if (points > lines->capacity) {
        lines->capacity = work_capacity(lines->capacity, points);
        work_buffer_remake(&lines->points, lines->capacity * sizeof(float[4]), "streamlines");
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(lines->speed, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
}

static void set3(GLuint program, GLint location, const double v[3])
{
    glProgramUniform3f(program, location, (GLfloat)v[0], (GLfloat)v[1], (GLfloat)v[2]);
}

static void run(const StreamLines *lines, GLuint program, const ParticleBuffers *particles,
                const Frame *frame, const double normal[3], size_t invocations)
{
    vectors_bind(program, particles, VECTOR_VELOCITY, view_color_by(frame->def), lines->no_scalar);
    mean_set(program, particles->support_radius, frame->slab > 0 ? 2 : 3);
    sample_grid_set(&lines->seeds, program);
    set3(program, STREAM_NORMAL_AT, normal);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, STREAM_FASTEST_STORAGE, lines->speed);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, STREAM_POINTS_STORAGE, lines->points);
    neighbourhood_run_for(frame->neighbourhood, program, invocations);
}

static void set_steps(const StreamLines *lines, const ParticleBuffers *particles, const StreamlinesDef *def,
                      bool flat)
{
    const double *box = particles->box_size, deep = flat ? 1e30 : box[2] / 2;
    glProgramUniform1f(lines->trace, STREAM_STEP_AT, (GLfloat)lines->step);
    glProgramUniform1ui(lines->trace, STREAM_STEPS_AT, (GLuint)lines->steps);
    glProgramUniform1f(lines->trace, STREAM_SLOWEST_AT, (GLfloat)def->slowest);
    set3(lines->trace, STREAM_LEAST_AT, (double[3]){-box[0] / 2, 0, -deep});
    set3(lines->trace, STREAM_GREATEST_AT, (double[3]){box[0] / 2, box[1], deep});
}

static void trace(StreamLines *lines, const ParticleBuffers *particles, const Frame *frame)
{
    const StreamlinesDef *def = streamlines_def(frame->def);
    Plane plane = {.normal = {0}};
    if (!make_seeds(lines, particles, def, &plane))
        return;
    if (!def->in_plane)
        memset(plane.normal, 0, sizeof plane.normal);
    reserve(lines, lines->lines * (2 * (size_t)lines->steps + 1));
    neighbourhood_build(frame->neighbourhood, particles);
    run(lines, lines->fastest, particles, frame, plane.normal, lines->lines);
    set_steps(lines, particles, def, frame->slab > 0);
    for (GLuint begun = 0; begun < (GLuint)lines->steps; begun += STREAM_STEPS_A_RUN) {
        glProgramUniform1ui(lines->trace, STREAM_BEGUN_AT, begun);
        run(lines, lines->trace, particles, frame, plane.normal, 2 * lines->lines);
    }
}

void stream_lines_make(StreamLines *lines, const ParticleBuffers *particles, const Frame *frame)
{
    const ParticleAttribute *vectors = &particles->vector[VECTOR_VELOCITY];
    const Scalar scalar = view_color_by(frame->def);
    const StreamSource now = {.step = particles->step,
                              .time = particles->time,
                              .count = particles->count,
                              .vectors = *vectors,
                              .shown = *particle_color_attribute(particles, scalar),
                              .scalar = scalar,
                              .def = *streamlines_def(frame->def)};
    if (lines->known && same_source(&lines->of, &now))
        return;
    lines->lines = 0;
    lines->of = now;
    lines->known = true;
    if (particles->count > 0 && vectors->buffer)
        trace(lines, particles, frame);
}
