#include "render/glyphs/glyph_arrows.h"

#include "render/particles/work.h"
#include "render/plane/plane.h"
#include "render/plane/plane_kernel.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

enum { SAMPLES_MOST = 1000000, USUAL_SAMPLES = 24 };

bool glyph_arrows_create(GlyphArrows *arrows, Error *error)
{
    static const char *const particles[] = {"glyphs/glyphs_particles.comp", NULL};
    static const char *const samples[] = {"glyphs/glyphs_samples.comp", NULL};
    arrows->particles = program_create("glyphs of particles", particles, NULL, error);
    arrows->samples = arrows->particles ? program_create("glyphs of samples", samples, NULL, error) : 0;
    arrows->sorts = arrows->samples != 0;
    return arrows->sorts && neighbourhood_create(&arrows->neighbourhood, error) &&
           glyph_tallies_create(&arrows->tallies, error);
}

void glyph_arrows_destroy(GlyphArrows *arrows)
{
    glDeleteProgram(arrows->particles);
    glDeleteProgram(arrows->samples);
    if (arrows->sorts)
        neighbourhood_destroy(&arrows->neighbourhood);
    glDeleteBuffers(1, &arrows->arrows);
    glyph_tallies_destroy(&arrows->tallies);
    glDeleteBuffers(1, &arrows->no_scalar);
    *arrows = (GlyphArrows){0};
}

static void reserve(GlyphArrows *arrows, size_t count)
{
    enum { ARROW_BYTES = 8 * sizeof(float) };
    if (!arrows->no_scalar)
        work_buffer_remake(&arrows->no_scalar, sizeof(uint32_t[4]), "glyphs without a scalar");
    if (count <= arrows->capacity)
        return;
    arrows->capacity = work_capacity(arrows->capacity, count);
    work_buffer_remake(&arrows->arrows, arrows->capacity * ARROW_BYTES, "glyphs");
}

/* No arrow yet: one instance of no index. */
static void begin(const GlyphArrows *arrows)
{
    static const uint32_t none = 0, one = 1;
    const unsigned command = arrows->tallies.box.buffer;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glClearNamedBufferData(command, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    glClearNamedBufferSubData(command, GL_R32UI, sizeof one, sizeof one, GL_RED_INTEGER, GL_UNSIGNED_INT,
                              &one);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLYPH_COMMAND_STORAGE, command);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLYPH_ARROWS_STORAGE, arrows->arrows);
}

/* The vector shown; buffer 0: the state lacks the vector. */
static const ParticleAttribute *vector_of(const ParticleBuffers *particles, const Frame *frame)
{
    return &particles->vector[glyphs_def(frame->def)->vector];
}

static void set_vector(const GlyphArrows *arrows, GLuint program, const ParticleBuffers *particles,
                       const Frame *frame)
{
    const size_t count = particles->count;
    const Scalar shown = view_color_by(frame->def);
    particle_bind(program, particles, shown);
    glProgramUniform1ui(program, GLYPH_VECTOR_STRIDE_AT,
                        particle_bind_one(GLYPH_VECTORS_STORAGE, vector_of(particles, frame), count, 0));
    glProgramUniform1ui(
        program, SHOWN_STRIDE_AT,
        particle_bind_one(SHOWN_STORAGE, particle_shown(particles, shown), count, arrows->no_scalar));
    glProgramUniform1ui(program, SHOWN_IS_FLUID_AT, shown == SCALAR_FLUID);
}

static void of_particles(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    const int stride = glyphs_def(frame->def)->stride;
    const double dimensions = frame->slab > 0 ? 2 : 3;
    arrows->apart = particles->spacing * pow(stride, 1 / dimensions);
    arrows->most = particles->count;
    reserve(arrows, arrows->most);
    begin(arrows);
    set_vector(arrows, arrows->particles, particles, frame);
    particle_bind_one(GLYPH_IDS_STORAGE, &particles->id, particles->count, 0);
    glUseProgram(arrows->particles);
    glUniform1ui(GLYPH_COUNT_AT, (GLuint)particles->count);
    glUniform1ui(GLYPH_ID_STRIDE_AT, (GLuint)(particles->id.stride / 4));
    glUniform1ui(GLYPH_EVERY_AT, (GLuint)stride);
    work_run(particles->count);
}

/* Positions of samples: a lattice with three steps, m. */
typedef struct Samples {
    double first[3], step[3][3];
    int count[3];
} Samples;

/* Centres as many samples as fit along `size` m. */
static void fit(Samples *samples, int axis, double size, double cell, const double way[3])
{
    samples->count[axis] = (int)fmax(floor(size / cell + 1e-6), 1);
    const double begin = (size - cell * (samples->count[axis] - 1)) / 2;
    for (int k = 0; k < 3; k++) {
        samples->step[axis][k] = cell * way[k];
        samples->first[k] += begin * way[k];
    }
}

static void grid_samples(Samples *samples, const double box[3], double cell)
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    *samples = (Samples){.first = {-box[0] / 2, 0, -box[2] / 2}};
    for (int k = 0; k < 3; k++)
        fit(samples, k, box[k], cell, axes[k]);
}

static void plane_samples(Samples *samples, const Plane *plane, double cell)
{
    *samples = (Samples){.count = {0, 0, 1}};
    memcpy(samples->first, plane->corner, sizeof samples->first);
    fit(samples, 0, plane->size[0], cell, plane->along);
    fit(samples, 1, plane->size[1], cell, plane->up);
}

/* Returns false if there are no samples: the plane misses the box. */
static bool make_samples(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame,
                         Samples *samples)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    const double *box = particles->box_size, longest = fmax(box[0], fmax(box[1], box[2]));
    double cell = def->cell > 0 ? def->cell : longest / USUAL_SAMPLES, samples_there = 1;
    Plane plane;
    if (def->at == GLYPHS_PLANE && !plane_make(box, def->plane_point, def->plane_normal, &plane))
        return false;
    const double *sides = def->at == GLYPHS_PLANE ? plane.size : box;
    const int dimensions = def->at == GLYPHS_PLANE ? 2 : 3;
    for (int k = 0; k < dimensions; k++)
        samples_there *= fmax(sides[k] / cell, 1);
    arrows->coarser = samples_there > SAMPLES_MOST;
    if (arrows->coarser)
        cell *= pow(samples_there / SAMPLES_MOST, 1.0 / dimensions) * 1.1;
    arrows->apart = cell;
    if (def->at == GLYPHS_PLANE)
        plane_samples(samples, &plane, cell);
    else
        grid_samples(samples, box, cell);
    return true;
}

static void set3(GLint location, const double v[3])
{
    glUniform3f(location, (GLfloat)v[0], (GLfloat)v[1], (GLfloat)v[2]);
}

static void set_samples(const Samples *samples, size_t count)
{
    set3(GLYPH_FIRST_AT, samples->first);
    set3(GLYPH_ALONG_AT, samples->step[0]);
    set3(GLYPH_UP_AT, samples->step[1]);
    set3(GLYPH_DEEP_AT, samples->step[2]);
    glUniform2ui(GLYPH_SAMPLES_AT, (GLuint)samples->count[0], (GLuint)samples->count[1]);
    glUniform1ui(GLYPH_COUNT_AT, (GLuint)count);
}

static void of_samples(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    Samples samples;
    const int dimensions = frame->slab > 0 ? 2 : 3, kernel = plane_kernel_named("wendland_c2");
    const double h = particles->support_radius;
    if (!make_samples(arrows, particles, frame, &samples))
        return;
    arrows->most = (size_t)samples.count[0] * (size_t)samples.count[1] * (size_t)samples.count[2];
    reserve(arrows, arrows->most);
    neighbourhood_build(&arrows->neighbourhood, particles);
    begin(arrows);
    set_vector(arrows, arrows->samples, particles, frame);
    glUseProgram(arrows->samples);
    set_samples(&samples, arrows->most);
    glUniform1f(GLYPH_SUPPORT_AT, (GLfloat)h);
    glUniform1f(GLYPH_PEAK_AT, (GLfloat)(plane_kernels[kernel].norm[dimensions - 2] / pow(h, dimensions)));
    neighbourhood_run_for(&arrows->neighbourhood, arrows->samples, arrows->most);
}

void glyph_arrows_make(GlyphArrows *arrows, const ParticleBuffers *particles, const Frame *frame)
{
    const GlyphsDef *def = glyphs_def(frame->def);
    arrows->most = 0;
    arrows->coarser = false;
    if (particles->count == 0 || !vector_of(particles, frame)->buffer)
        return;
    if (def->at == GLYPHS_PARTICLES && particles->id.buffer)
        of_particles(arrows, particles, frame);
    else if (def->at != GLYPHS_PARTICLES)
        of_samples(arrows, particles, frame);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

const GlyphTally *glyph_arrows_count(GlyphArrows *arrows, const ParticleBuffers *particles,
                                     const Frame *frame)
{
    static const GlyphTally none;
    return arrows->most > 0 ? glyph_tallies_follow(&arrows->tallies, particles, frame) : &none;
}
