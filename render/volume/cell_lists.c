#include "render/volume/cell_lists.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

enum { CELLS_MAX = 1 << 24 };

double cell_lists_size(const VolumeGrid *grid, double radius, int size[3])
{
    const double all = (double)grid->size[0] * grid->size[1] * grid->size[2];
    const double side = fmax(radius, cbrt(all / CELLS_MAX) * 1.1);
    for (int k = 0; k < 3; k++)
        size[k] = (int)floor(grid->size[k] / side) + 1;
    return 1 / side;
}

static GLuint compile(const char *label, const char *file, const char *defines, Error *error)
{
    return program_create(label, (const char *const[]){file, NULL}, defines, error);
}

bool cell_lists_create(CellLists *lists, bool scalar, Error *error)
{
    *lists = (CellLists){0};
    lists->count = compile("cell count", "volume/cell_count.comp", NULL, error);
    lists->place = lists->count && prefix_sums_create(&lists->sums, error)
                       ? compile("cell place", "volume/cell_count.comp",
                                 scalar ? "#define PLACE 1\n#define SCALAR 1\n" : "#define PLACE 1\n", error)
                       : 0;
    return lists->place != 0;
}

void cell_lists_destroy(CellLists *lists)
{
    glDeleteProgram(lists->count);
    prefix_sums_destroy(&lists->sums);
    glDeleteProgram(lists->place);
    glDeleteBuffers(3, (GLuint[]){lists->starts, lists->particles, lists->scalars});
    *lists = (CellLists){0};
}

static void reserve(CellLists *lists, size_t cells, size_t count, bool scalar)
{
    if (cells > lists->cells) {
        work_buffer_remake(&lists->starts, (cells + 1) * sizeof(GLuint), "cell starts");
        lists->cells = cells;
    }
    if (count > lists->capacity || !lists->particles) {
        lists->capacity = work_capacity(lists->capacity, count);
        work_buffer_remake(&lists->particles, (lists->capacity + 1) * 4 * sizeof(GLfloat), "cell particles");
        if (scalar)
            work_buffer_remake(&lists->scalars, (lists->capacity + 1) * sizeof(GLfloat), "cell scalars");
    }
}

static void run(GLuint program, const VoxelizeJob *job, size_t invocations)
{
    glUseProgram(program);
    particle_bind(program, job->particles, job->carried);
    work_run(invocations);
}

void cell_lists_make(CellLists *lists, const VoxelizeJob *job)
{
    const size_t count = job->particles->count;
    int size[3];
    cell_lists_size(&job->volume->grid, job->radius, size);
    reserve(lists, (size_t)size[0] * size[1] * size[2], count, job->scalar);
    cell_lists_bind(lists);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(lists->starts, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    run(lists->count, job, count);
    prefix_sums_run(&lists->sums, lists->starts, (size_t)size[0] * size[1] * size[2] + 1);
    run(lists->place, job, count);
}

void cell_lists_bind(const CellLists *lists)
{
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, LIST_STARTS_STORAGE, 3,
                      (GLuint[]){lists->starts, lists->particles, lists->scalars});
}
