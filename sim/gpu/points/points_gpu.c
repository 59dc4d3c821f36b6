#include "sim/gpu/points/points_gpu.h"

#include "shaders/surface/surface_bindings.h"
#include "sim/gpu/gl.h"
#include "sim/points/points.h"
#include "sim/points/walk.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELLS = COUNTING_CELLS * COUNTING_CELLS * COUNTING_CELLS,
    GROUPS_MOST = 32768 /* per dispatch; an axis allows 65,535 */
};

_Static_assert(WALK_NEWTON_STEPS == NEWTON_STEPS && WALK_HALVINGS == HALVINGS,
               "a step is the same on CPU and GPU");

static const size_t POINT = sizeof(SurfacePoint);

/* Any buffer binding may begin at a multiple: no driver requires more. */
static const size_t ALIGNED = 256;

bool surface_gpu_knows(const LevelField *field)
{
    char path[SHADER_PATH_MAX];
    snprintf(path, sizeof path, "surface/%s.glsl", field->kind->name);
    return shader_source_has(path);
}

/* ---- programs ---- */

static unsigned program_of(SurfaceGpu *gpu, const char *stage, const char *field, Error *error)
{
    char path[SHADER_PATH_MAX], define[SHADER_PATH_MAX], label[SHADER_PATH_MAX];
    const char *const stages[] = {path, NULL};
    for (int i = 0; i < gpu->program_count; i++)
        if (strcmp(gpu->programs[i].stage, stage) == 0 && strcmp(gpu->programs[i].field, field) == 0)
            return gpu->programs[i].program;
    if (gpu->program_count == SURFACE_GPU_PROGRAMS) {
        error_set(error, "more than %d kinds of surfaces", SURFACE_GPU_PROGRAMS);
        return 0;
    }
    snprintf(path, sizeof path, "surface/%s", stage);
    snprintf(define, sizeof define, "#define FIELD surface/%s.glsl\n", field);
    snprintf(label, sizeof label, "surface %s %s", stage, field);
    const unsigned program = program_create(label, stages, field[0] ? define : NULL, error);
    if (program)
        gpu->programs[gpu->program_count++] = (SurfaceProgram){stage, field, program};
    return program;
}

/* ---- buffers ---- */

/* Returns 0 if memory is short. */
static unsigned buffer_of(const char *label, const void *data, size_t bytes)
{
    static const uint32_t nothing[4] = {0};
    unsigned buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, label);
    gl_debug_errors(); /* errors found below belong to this buffer */
    glNamedBufferData(buffer, (GLsizeiptr)(bytes > 0 ? bytes : sizeof nothing), bytes > 0 ? data : nothing,
                      GL_STREAM_DRAW);
    if (gl_errors_take(0) == 0)
        return buffer;
    glDeleteBuffers(1, &buffer);
    return 0;
}

static bool make_buffer(const SurfaceGpu *gpu, unsigned *buffer, const char *label, const void *data,
                        size_t bytes, Error *error)
{
    glDeleteBuffers(1, buffer);
    *buffer = 0;
    if ((int64_t)bytes > gpu->block_bytes)
        return error_set(error,
                         "a walk on the GPU needs %zu bytes of %s, and this driver allows shaders %lld",
                         bytes, label, (long long)gpu->block_bytes);
    *buffer = buffer_of(label, data, bytes);
    return *buffer || error_set(error, "the GPU has no memory for %zu bytes of %s", bytes, label);
}

/* Uploads the field's arrays and numbers for the program in use. */
static bool take_field(SurfaceGpu *gpu, const LevelField *field, Error *error)
{
    static const char *const labels[] = {"field of a surface", "cells of a surface's field"};
    LevelParts parts;
    level_parts(field, &parts);
    glUniform4fv(FIELD_NUMBERS_AT, 4, parts.number);
    for (GLuint k = 0; k < 2; k++) {
        if (!make_buffer(gpu, &gpu->field[k], labels[k], parts.array[k].data, parts.array[k].bytes, error))
            return false;
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FIELD_FIRST_STORAGE + k, gpu->field[k]);
    }
    return true;
}

static bool take_walkers(SurfaceGpu *gpu, const Walkers *walkers, Error *error)
{
    const size_t count = walkers->count;
    if (!make_buffer(gpu, &gpu->walkers, "walkers", NULL, 4 * count * sizeof(float), error))
        return false;
    for (size_t k = 0; k < 4; k++)
        glNamedBufferSubData(gpu->walkers, (GLintptr)(k * count * sizeof(float)),
                             (GLsizeiptr)(count * sizeof(float)),
                             k < 3 ? (const void *)walkers->place[k] : (const void *)walkers->taken);
    gpu->walker_count = count;
    return true;
}

static bool take_spheres(SurfaceGpu *gpu, const Counting *counting, Error *error)
{
    const size_t members = counting->begin[CELLS], words = CELLS + 1 + members;
    float centre[COUNTING_SPHERES][4] = {{0}};
    uint32_t *cells = malloc(words * sizeof *cells);
    if (!cells)
        return error_set(error, "no memory for counting spheres");
    memcpy(cells, counting->begin, (CELLS + 1) * sizeof *cells);
    for (size_t m = 0; m < members; m++)
        cells[CELLS + 1 + m] = counting->member[m];
    for (int i = 0; i < counting->count; i++)
        memcpy(centre[i], counting->centre[i], sizeof counting->centre[i]);
    for (int k = 0; k < 3; k++) {
        gpu->sphere_low[k] = (float)counting->low[k];
        gpu->sphere_cell[k] = (float)(1 / counting->cell[k]);
    }
    gpu->sphere_radius = counting->radius;
    const bool ok =
        make_buffer(gpu, &gpu->spheres, "counting spheres", centre, sizeof centre, error) &&
        make_buffer(gpu, &gpu->cells, "cells of counting spheres", cells, words * sizeof *cells, error) &&
        make_buffer(gpu, &gpu->counts, "points in counting spheres", counting->inside,
                    sizeof counting->inside, error);
    free(cells);
    return ok;
}

/* Makes room for `count` points in total; keeps the contents. */
static bool reserve(SurfaceGpu *gpu, size_t count, Error *error)
{
    if (count <= gpu->point_capacity && gpu->points)
        return true;
    const unsigned larger = buffer_of("points on a surface", NULL, count * POINT);
    if (!larger)
        return error_set(
            error, "the GPU has no memory for %zu points on surfaces; ask for less opacity or fewer sets",
            count);
    if (gpu->point_count > 0) {
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glCopyNamedBufferSubData(gpu->points, larger, 0, 0, (GLsizeiptr)(gpu->point_count * POINT));
    }
    glDeleteBuffers(1, &gpu->points);
    gpu->points = larger;
    gpu->point_capacity = count;
    return true;
}

/* ---- dispatches ---- */

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Binds points first .. end - 1. Returns the word offset of the first point. */
static GLuint bind_points(const SurfaceGpu *gpu, size_t first, size_t end)
{
    const size_t from = first * POINT / ALIGNED * ALIGNED;
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, SURFACE_STORAGE, gpu->points, (GLintptr)from,
                      (GLsizeiptr)(end * POINT - from));
    return (GLuint)((first * POINT - from) / sizeof(uint32_t));
}

/* Number of points that fit in a block and a dispatch. */
static size_t points_at_once(const SurfaceGpu *gpu)
{
    const size_t block = ((size_t)gpu->block_bytes - ALIGNED) / POINT;
    return least(block, (size_t)gpu->group_most * SURFACE_GROUP);
}

/* Runs the program in use over points first .. end - 1, in pieces. */
static void run_over_points(const SurfaceGpu *gpu, size_t first, size_t end)
{
    while (first < end) {
        const size_t some = least(end - first, points_at_once(gpu));
        glUniform2ui(SURFACE_RANGE_AT, bind_points(gpu, first, first + some), (GLuint)some);
        glDispatchCompute((GLuint)((some + SURFACE_GROUP - 1) / SURFACE_GROUP), 1, 1);
        first += some;
    }
}

static void count_points(SurfaceGpu *gpu, unsigned program, size_t first, Counting *counting)
{
    glUseProgram(program);
    glUniform3fv(SPHERES_LOW_AT, 1, gpu->sphere_low);
    glUniform3fv(SPHERES_CELL_AT, 1, gpu->sphere_cell);
    glUniform3f(SPHERES_RADIUS_AT, gpu->sphere_radius, COUNTING_CELLS, CELLS);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SPHERES_STORAGE, gpu->spheres);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SPHERE_CELLS_STORAGE, gpu->cells);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, COUNTS_STORAGE, gpu->counts);
    run_over_points(gpu, first, gpu->point_count);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(gpu->counts, 0, sizeof counting->inside, counting->inside);
}

static void set_walk(const SurfaceGpu *gpu, const Walk *walk)
{
    glUniform1f(WALK_LEVEL_AT, walk->level);
    glUniform3fv(WALK_LOW_AT, 1, walk->low);
    glUniform3fv(WALK_HIGH_AT, 1, walk->high);
    glUniform3f(WALK_LENGTHS_AT, walk->step, walk->close, walk->reach);
    glUniform2uiv(WALK_KEY_AT, 1, walk->key.word);
    glUniform1ui(WALK_SURFACE_AT, walk->surface);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, WALKERS_STORAGE, gpu->walkers);
}

/* Runs all walkers, in pieces. */
static void dispatch_walkers(const SurfaceGpu *gpu, const Walk *walk, bool keep)
{
    const size_t all = gpu->walker_count, count = walk->count,
                 most = keep ? least(points_at_once(gpu) / count, (size_t)gpu->group_most * SURFACE_GROUP)
                             : (size_t)gpu->group_most * SURFACE_GROUP;
    glUniform3ui(WALK_STEPS_AT, walk->first, walk->count, keep);
    for (size_t w = 0; w < all; w += most) {
        const size_t end = least(w + most, all), first = gpu->point_count;
        glUniform3ui(WALK_WALKERS_AT, (GLuint)all, (GLuint)w, (GLuint)end);
        glUniform1ui(SURFACE_RANGE_AT, keep ? bind_points(gpu, first + w * count, first + end * count)
                                            : bind_points(gpu, 0, 1)); /* a block needs some buffer */
        glDispatchCompute((GLuint)((end - w + SURFACE_GROUP - 1) / SURFACE_GROUP), 1, 1);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/* ---- the device ---- */

static bool begin(void *own, const Walk *walk, const Counting *counting, size_t points, Error *error)
{
    SurfaceGpu *gpu = own;
    if (!surface_gpu_knows(walk->field))
        return error_set(error, "there is no shader surface/%s.glsl; let the CPU walk",
                         walk->field->kind->name);
    gpu->point_count = 0;
    return take_walkers(gpu, walk->walkers, error) && take_spheres(gpu, counting, error) &&
           reserve(gpu, points + points / 16 + 2 * walk->walkers->count, error);
}

static bool steps(void *own, const Walk *walk, bool keep, Counting *counting, Error *error)
{
    SurfaceGpu *gpu = own;
    const unsigned program = program_of(gpu, "walk.comp", walk->field->kind->name, error),
                   count = program ? program_of(gpu, "count.comp", "", error) : 0;
    const size_t first = gpu->point_count, more = keep ? walk->count * gpu->walker_count : 0;
    if (!count || !reserve(gpu, first + more, error))
        return false;
    glUseProgram(program);
    if (!take_field(gpu, walk->field, error))
        return false;
    set_walk(gpu, walk);
    dispatch_walkers(gpu, walk, keep);
    gpu->point_count += more;
    if (keep)
        count_points(gpu, count, first, counting);
    return true;
}

static bool colour(void *own, const LevelField *field, Error *error)
{
    SurfaceGpu *gpu = own;
    const unsigned program = program_of(gpu, "colour.comp", field->kind->name, error);
    if (!program)
        return false;
    glUseProgram(program);
    if (!take_field(gpu, field, error))
        return false;
    run_over_points(gpu, 0, gpu->point_count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return true;
}

static bool points(void *own, size_t count, SurfacePoint *out, Error *error)
{
    SurfaceGpu *gpu = own;
    (void)error;
    gpu->point_count = count;
    if (!out)
        return true;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(gpu->points, 0, (GLsizeiptr)(count * POINT), out);
    return true;
}

static size_t taken(void *own)
{
    SurfaceGpu *gpu = own;
    size_t sum = 0;
    uint32_t *each = malloc(gpu->walker_count * sizeof *each);
    if (!each)
        return 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(gpu->walkers, (GLintptr)(3 * gpu->walker_count * sizeof *each),
                            (GLsizeiptr)(gpu->walker_count * sizeof *each), each);
    for (size_t w = 0; w < gpu->walker_count; w++)
        sum += each[w];
    free(each);
    return sum;
}

/* Frees all buffers of a walk except the points. */
static void end(void *own)
{
    SurfaceGpu *gpu = own;
    unsigned *const buffers[] = {&gpu->field[0], &gpu->field[1], &gpu->walkers,
                                 &gpu->spheres,  &gpu->cells,    &gpu->counts};
    for (size_t k = 0; k < sizeof buffers / sizeof *buffers; k++) {
        glDeleteBuffers(1, buffers[k]);
        *buffers[k] = 0;
    }
}

/* ---- create and destroy ---- */

void surface_gpu_create(SurfaceGpu *gpu)
{
    *gpu = (SurfaceGpu){.block_bytes = gl_limits().block_bytes, .group_most = GROUPS_MOST};
    gpu->device = (SurfaceDevice){gpu, begin, steps, colour, points, taken, end};
}

unsigned surface_gpu_take_points(SurfaceGpu *gpu)
{
    const unsigned buffer = gpu->points;
    gpu->points = 0;
    gpu->point_count = gpu->point_capacity = 0;
    return buffer;
}

void surface_gpu_destroy(SurfaceGpu *gpu)
{
    end(gpu);
    glDeleteBuffers(1, &gpu->points);
    for (int i = 0; i < gpu->program_count; i++)
        glDeleteProgram(gpu->programs[i].program);
    *gpu = (SurfaceGpu){0};
}
