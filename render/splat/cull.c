#include "render/splat/cull.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

enum { CHUNK = 32, COMMAND_SIZE = 32, CELLS_A_SIDE = 1024 };

/* A coarse map: see shaders/splat/cull.glsl. */
typedef struct Grid {
    GLuint columns, rows, side;
    GLfloat width, height; /* pixels */
} Grid;

static GLuint compile(const char *label, const char *file, const char *defines, Error *error)
{
    return program_create(label, (const char *const[]){file, NULL}, defines, error);
}

bool cull_create(Cull *cull, const char *body, Error *error)
{
    *cull = (Cull){0};
    work_buffer_remake(&cull->commands, (size_t)CULL_LISTS * COMMAND_SIZE, "cull commands");
    cull->occlude = compile("cull occlude", "splat/cull_occlude.comp", body, error);
    cull->test = cull->occlude ? compile("cull test", "splat/cull_test.comp", body, error) : 0;
    cull->sum = cull->test ? compile("cull sum", "splat/cull_sum.comp", NULL, error) : 0;
    cull->list = cull->sum ? compile("cull list", "splat/cull_list.comp", NULL, error) : 0;
    return cull->list != 0;
}

bool cull_create_limit(Cull *cull, Error *error)
{
    cull->limit = compile("cull limit", "splat/cull_limit.comp", NULL, error);
    return cull->limit != 0;
}

void cull_destroy(Cull *cull)
{
    glDeleteProgram(cull->occlude);
    glDeleteProgram(cull->test);
    glDeleteProgram(cull->sum);
    glDeleteProgram(cull->list);
    glDeleteProgram(cull->limit);
    glDeleteTextures(1, &cull->rows);
    glDeleteBuffers(CULL_LISTS, cull->lists);
    glDeleteBuffers(3, (GLuint[]){cull->map, cull->kept, cull->commands});
    *cull = (Cull){0};
}

static GLuint chunks_of(size_t count)
{
    return (GLuint)((count + CHUNK - 1) / CHUNK);
}

/* Rounded up to whole texels of `rows`. */
static size_t cells_of(const Grid *grid)
{
    return (size_t)(grid->columns + 3) / 4 * 4 * grid->rows;
}

static void reserve(Cull *cull, size_t count, size_t cells)
{
    if (cells > cull->cells) {
        cull->cells = work_capacity(cull->cells, cells) / 4 * 4;
        work_buffer_remake(&cull->map, cull->cells * sizeof(GLuint), "cull map");
        glDeleteTextures(1, &cull->rows);
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &cull->rows);
        glTextureBuffer(cull->rows, GL_RGBA32UI, cull->map);
    }
    if (count > cull->capacity) {
        cull->capacity = work_capacity(cull->capacity, count);
        work_buffer_remake(&cull->kept, chunks_of(cull->capacity) * 4 * sizeof(GLuint), "cull kept");
        for (int i = 0; i < CULL_LISTS; i++)
            work_buffer_remake(&cull->lists[i], cull->capacity * sizeof(GLuint), "cull list");
    }
}

static GLuint clamp_to(double value, double low, double high)
{
    return (GLuint)fmax(low, fmin(value, high)); /* `low` for NaN */
}

/* The largest cells such that the smallest sprite, `least` pixels wide inside its rim, always covers a
   whole cell: needs side + (side - 1) pixels. */
static Grid make_grid(double width, double height, double least)
{
    const double coarse = ceil(fmax(width, height) / CELLS_A_SIDE);
    const GLuint side = clamp_to(floor((least + 1) / 2), coarse, 4096);
    return (Grid){.columns = (GLuint)ceil(width / side),
                  .rows = (GLuint)ceil(height / side),
                  .side = side,
                  .width = (GLfloat)width,
                  .height = (GLfloat)height};
}

static void use(GLuint program, const Grid *grid, const ParticleBuffers *particles, const Frame *frame)
{
    glUseProgram(program);
    if (particles)
        particle_bind(program, particles, view_color_by(frame->def));
    glUniform2ui(CELLS_AT, grid->columns, grid->rows);
    glUniform1ui(CELL_SIDE_AT, grid->side);
    glUniform2f(CULL_PIXELS_AT, grid->width, grid->height);
}

static void make_map(Cull *cull, const Grid *grid, const ParticleBuffers *particles, const Frame *frame)
{
    static const GLfloat nothing = INFINITY;
    const size_t cells = cells_of(grid);
    reserve(cull, particles->count, cells);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    glClearNamedBufferSubData(cull->map, GL_R32F, 0, (GLsizeiptr)(cells * sizeof nothing), GL_RED, GL_FLOAT,
                              &nothing);
    use(cull->occlude, grid, particles, frame);
    glUniform1ui(CULL_COUNT_AT, (GLuint)particles->count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_MAP_STORAGE, cull->map);
    glBindTextureUnit(CULL_ROWS_UNIT, cull->rows);
    work_run_scattered(particles->count);
}

static void make_lists(Cull *cull, size_t count, unsigned vertices)
{
    glUseProgram(cull->sum);
    glUniform1ui(CHUNKS_AT, chunks_of(count));
    glUniform1ui(VERTICES_AT, vertices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_COMMANDS_STORAGE, cull->commands);
    work_run(1);
    glUseProgram(cull->list);
    glUniform1ui(CHUNKS_AT, chunks_of(count));
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, NEAREST_LIST_STORAGE, CULL_LISTS, cull->lists);
    work_run(chunks_of(count));
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

static void test(Cull *cull, const Grid *grid, const ParticleBuffers *particles, const Frame *frame,
                 float eps, unsigned vertices, bool hidden)
{
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    use(cull->test, grid, particles, frame);
    glBindTextureUnit(CULL_ROWS_UNIT, cull->rows);
    glUniform1ui(CULL_COUNT_AT, (GLuint)particles->count);
    glUniform1f(EPS_AT, eps);
    glUniform1ui(INVERT_AT, hidden);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_KEPT_STORAGE, cull->kept);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_MARKS_STORAGE, cull->marks);
    work_run(chunks_of(particles->count));
    make_lists(cull, particles->count, vertices);
}

static void make(Cull *cull, const Grid *grid, const ParticleBuffers *particles, const Frame *frame,
                 float eps, unsigned vertices, bool hidden)
{
    make_map(cull, grid, particles, frame);
    test(cull, grid, particles, frame, eps, vertices, hidden);
}

/* Diameter in pixels of a sphere at `distance` in the middle of the picture. */
static double pixels_across(const Frame *frame, double distance)
{
    return frame->particle_radius / fmax(distance, frame->camera.near_plane) / frame->camera.tangent[1] *
           frame->height;
}

static Grid eye_grid(const Frame *frame)
{
    return make_grid(frame->width, frame->height, pixels_across(frame, frame->farthest) * sqrt(0.5));
}

void cull_for_eye(Cull *cull, const ParticleBuffers *particles, const Frame *frame, float eps,
                  unsigned vertices, bool hidden)
{
    const Grid grid = eye_grid(frame);
    if (particles->count > 0)
        make(cull, &grid, particles, frame, eps, vertices, hidden);
}

void cull_to_limit(Cull *cull, const ParticleBuffers *particles, const Frame *frame, unsigned limit,
                   unsigned vertices)
{
    const Grid grid = eye_grid(frame);
    if (particles->count == 0)
        return;
    reserve(cull, particles->count, cells_of(&grid));
    use(cull->limit, &grid, NULL, NULL);
    glBindTextureUnit(LIMIT_UNIT, limit);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_MAP_STORAGE, cull->map);
    work_run((size_t)grid.columns * grid.rows);
    test(cull, &grid, particles, frame, 0, vertices, false);
}

size_t cull_use(const Cull *cull, CullList list)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LISTED_STORAGE, cull->lists[list]);
    return (size_t)list * COMMAND_SIZE;
}
