#include "render/particles/neighbourhood.h"

#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

enum { CELLS_A_PARTICLE = 8, CELLS_LEAST = 4096, CELLS_A_SIDE = 32768 };

static GLuint compile(const char *file, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, NULL, error);
}

bool neighbourhood_create(Neighbourhood *n, Error *error)
{
    *n = (Neighbourhood){0};
    n->bin = compile("render/neighbourhood_bin.comp", error);
    n->place =
        n->bin && prefix_sums_create(&n->sums, error) ? compile("render/neighbourhood_place.comp", error) : 0;
    n->sort = n->place ? compile("render/neighbourhood_sort.comp", error) : 0;
    return n->sort != 0;
}

void neighbourhood_destroy(Neighbourhood *n)
{
    const GLuint programs[] = {n->bin, n->place, n->sort};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++)
        glDeleteProgram(programs[i]);
    glDeleteBuffers(5, (GLuint[]){n->cell, n->rank, n->order, n->sorted, n->start});
    glDeleteTextures(2, (GLuint[]){n->texels, n->order_texels});
    prefix_sums_destroy(&n->sums);
    *n = (Neighbourhood){0};
}

static void show_as_texels(GLuint *texture, GLuint buffer)
{
    glDeleteTextures(1, texture);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, texture);
    glTextureBuffer(*texture, GL_RGBA32UI, buffer);
}

static void reserve(Neighbourhood *n, size_t count, size_t cells)
{
    if (count > n->capacity) {
        n->capacity = work_capacity(n->capacity, count);
        work_buffer_remake(&n->cell, n->capacity * sizeof(GLuint), "neighbourhood cell");
        work_buffer_remake(&n->rank, n->capacity * sizeof(GLuint), "neighbourhood rank");
        work_buffer_remake(&n->order, (n->capacity + 3) / 4 * 4 * sizeof(GLuint), "neighbourhood order");
        work_buffer_remake(&n->sorted, n->capacity * 4 * sizeof(GLfloat), "neighbourhood sorted");
        show_as_texels(&n->texels, n->sorted);
        show_as_texels(&n->order_texels, n->order);
    }
    if (cells > n->cells_capacity) {
        work_buffer_remake(&n->start, (cells + 2) * sizeof(GLuint), "neighbourhood start");
        n->cells_capacity = cells;
    }
}

/* Cells with an edge of h; larger if the box is so wide that most cells would be empty. Returns the number
   of cells. */
static size_t make_grid(Neighbourhood *n, const ParticleBuffers *particles)
{
    const double *box = particles->box_size, corner[3] = {-box[0] / 2, 0, -box[2] / 2};
    const double most = CELLS_A_PARTICLE * (double)particles->count + CELLS_LEAST;
    double edge = particles->support_radius, cells = INFINITY;
    for (; cells > most; edge *= 1.25) {
        cells = 1;
        for (int k = 0; k < 3; k++) {
            n->size[k] = (unsigned)fmax(1, fmin(ceil(box[k] / edge), CELLS_A_SIDE));
            cells *= n->size[k];
        }
        n->scale = (float)(1 / edge);
    }
    for (int k = 0; k < 3; k++)
        n->corner[k] = (float)corner[k];
    n->count = (unsigned)particles->count;
    return (size_t)cells;
}

static void bind_buffers(const Neighbourhood *n)
{
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, CELLS_STORAGE, 5,
                      (const unsigned[]){n->cell, n->rank, n->start, n->order, n->sorted});
}

static void run(const Neighbourhood *n, GLuint program, size_t invocations)
{
    glUseProgram(program);
    glUniform3uiv(GRID_SIZE_AT, 1, n->size);
    glUniform1ui(GRID_PARTICLES_AT, n->count);
    glUniform3fv(GRID_CORNER_AT, 1, n->corner);
    glUniform1f(GRID_SCALE_AT, n->scale);
    work_run(invocations);
}

static void bind_positions(const Neighbourhood *n, const ParticleBuffers *particles)
{
    const ParticleAttribute *position = &particles->position;
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, POSITIONS_STORAGE, position->buffer,
                      (GLintptr)position->offset, (GLsizeiptr)(particles->count * position->stride));
    glProgramUniform1ui(n->bin, POSITION_STRIDE_AT, (GLuint)(position->stride / 4));
    glProgramUniform1ui(n->sort, POSITION_STRIDE_AT, (GLuint)(position->stride / 4));
}

void neighbourhood_build(Neighbourhood *n, const ParticleBuffers *particles)
{
    const size_t cells = make_grid(n, particles);
    if (particles->count == 0)
        return;
    reserve(n, particles->count, cells);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(n->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    bind_positions(n, particles);
    bind_buffers(n);
    run(n, n->bin, n->count);
    prefix_sums_run(&n->sums, n->start, cells + 2);
    run(n, n->place, n->count);
    bind_positions(n, particles);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindTextureUnit(ORDER_UNIT, n->order_texels);
    run(n, n->sort, n->count);
}

void neighbourhood_run_for(const Neighbourhood *n, unsigned program, size_t invocations)
{
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindTextureUnit(SORTED_UNIT, n->texels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, STARTS_STORAGE, n->start);
    if (n->count > 0 && invocations > 0)
        run(n, program, invocations);
}

void neighbourhood_run(const Neighbourhood *n, unsigned program)
{
    neighbourhood_run_for(n, program, n->count);
}
