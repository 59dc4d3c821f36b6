#include "render/particles/particles.h"

#include "shaders/shared/bindings.h"
#include "shaders/shared/scan.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

enum { BLOCK = 1024 };

static GLuint compile_sums(const char *file, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, NULL, error);
}

bool prefix_sums_create(PrefixSums *sums, Error *error)
{
    sums->scan = compile_sums("sim/compute/scan.comp", error);
    sums->add = sums->scan ? compile_sums("sim/compute/scan_add.comp", error) : 0;
    return sums->add != 0;
}

void prefix_sums_destroy(PrefixSums *sums)
{
    glDeleteProgram(sums->scan);
    glDeleteProgram(sums->add);
    glDeleteBuffers(PREFIX_SUM_LEVELS, sums->totals);
    *sums = (PrefixSums){0};
}

static size_t blocks_of(size_t size)
{
    return (size + BLOCK - 1) / BLOCK;
}

static void reserve_sums(PrefixSums *sums, size_t size)
{
    if (size <= sums->capacity)
        return;
    sums->capacity = size;
    for (int level = 0; level < PREFIX_SUM_LEVELS; level++)
        work_buffer_remake(&sums->totals[level], (size = blocks_of(size)) * sizeof(GLuint), "prefix sums");
}

static void run_sums(GLuint program, GLuint values, GLuint totals, size_t size)
{
    glUseProgram(program);
    glUniform1ui(SCAN_SIZE_AT, (GLuint)size);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, SCAN_VALUES_STORAGE, 2, (GLuint[]){values, totals});
    work_dispatch(blocks_of(size));
}

void prefix_sums_run(PrefixSums *sums, unsigned buffer, size_t size)
{
    GLuint values[PREFIX_SUM_LEVELS + 1] = {buffer};
    size_t sizes[PREFIX_SUM_LEVELS + 1] = {size};
    int level = 0;
    reserve_sums(sums, size);
    do {
        run_sums(sums->scan, values[level], sums->totals[level], sizes[level]);
        values[level + 1] = sums->totals[level];
        sizes[level + 1] = blocks_of(sizes[level]);
        level++;
    } while (sizes[level] > 1 && level < PREFIX_SUM_LEVELS);
    for (level -= 2; level >= 0; level--)
        run_sums(sums->add, values[level], values[level + 1], sizes[level]);
}

bool selection_create(Selection *selection, const char *label, const char *file, Error *error)
{
    const char *const files[] = {file, NULL};
    selection->mark = program_create(label, files, "#define MARK 1\n", error);
    selection->list = selection->mark ? program_create(label, files, NULL, error) : 0;
    return selection->list && prefix_sums_create(&selection->sums, error);
}

void selection_destroy(Selection *selection)
{
    glDeleteProgram(selection->mark);
    glDeleteProgram(selection->list);
    glDeleteBuffers(2, (GLuint[]){selection->bits, selection->starts});
    prefix_sums_destroy(&selection->sums);
    *selection = (Selection){0};
}

static size_t words_of(size_t count)
{
    return (count + 31) / 32;
}

static void run_selection(const Selection *selection, GLuint program, size_t count, size_t invocations,
                          void (*set)(unsigned program, const void *user), const void *user)
{
    glUseProgram(program);
    set(program, user);
    glUniform1ui(SELECT_COUNT_AT, (GLuint)count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SELECT_BITS_STORAGE, selection->bits);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SELECT_STARTS_STORAGE, selection->starts);
    work_run(invocations);
}

void selection_run(Selection *selection, size_t count, void (*set)(unsigned program, const void *user),
                   const void *user)
{
    const size_t words = words_of(count) + 1;
    if (count > selection->capacity || !selection->bits) {
        selection->capacity = work_capacity(selection->capacity, count);
        const size_t most = words_of(selection->capacity) + 1;
        work_buffer_remake(&selection->bits, most * sizeof(GLuint), "chosen particles");
        work_buffer_remake(&selection->starts, most * sizeof(GLuint), "chosen particles before");
    }
    run_selection(selection, selection->mark, count, 32 * words, set, user);
    prefix_sums_run(&selection->sums, selection->starts, words);
    run_selection(selection, selection->list, count, count > 0 ? count : 1, set, user);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

enum { CELLS_A_PARTICLE = 8, CELLS_LEAST = 4096, CELLS_A_SIDE = 32768 };

static GLuint compile_grid(const char *file, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, NULL, error);
}

bool neighbourhood_create(Neighbourhood *n, Error *error)
{
    *n = (Neighbourhood){0};
    n->bin = compile_grid("render/neighbourhood_bin.comp", error);
    n->place = n->bin && prefix_sums_create(&n->sums, error)
                   ? compile_grid("render/neighbourhood_place.comp", error)
                   : 0;
    n->sort = n->place ? compile_grid("render/neighbourhood_sort.comp", error) : 0;
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

static void reserve_grid(Neighbourhood *n, size_t count, size_t cells)
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

static void run_particles(const Neighbourhood *n, GLuint program, size_t invocations)
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

static bool is_of(const Neighbourhood *n, const ParticleBuffers *particles)
{
    const ParticleAttribute *position = &particles->position;
    return n->of.buffer == position->buffer && n->of.offset == position->offset &&
           n->of.stride == position->stride && n->count == particles->count;
}

void neighbourhood_build(Neighbourhood *n, const ParticleBuffers *particles)
{
    if (is_of(n, particles))
        return;
    const size_t cells = make_grid(n, particles);
    if (particles->count == 0)
        return;
    n->of = particles->position;
    reserve_grid(n, particles->count, cells);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(n->start, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    bind_positions(n, particles);
    bind_buffers(n);
    run_particles(n, n->bin, n->count);
    prefix_sums_run(&n->sums, n->start, cells + 2);
    run_particles(n, n->place, n->count);
    bind_positions(n, particles);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindTextureUnit(ORDER_UNIT, n->order_texels);
    run_particles(n, n->sort, n->count);
}

void neighbourhood_run_for(const Neighbourhood *n, unsigned program, size_t invocations)
{
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindTextureUnit(SORTED_UNIT, n->texels);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, STARTS_STORAGE, n->start);
    if (n->count > 0 && invocations > 0)
        run_particles(n, program, invocations);
}

void neighbourhood_run(const Neighbourhood *n, unsigned program)
{
    neighbourhood_run_for(n, program, n->count);
}
