/* Voxelization by compute shaders, and particles sorted by cells. */
#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Particles sorted by the cells of a grid as wide as the kernel's radius, on the GPU. The neighbours of a
   position are in three times three rows of cells (shaders/volume/field_sum.glsl). */

typedef struct CellLists {
    unsigned count, place; /* programs */
    PrefixSums sums;
    unsigned starts, particles, scalars; /* buffers; `scalars` only with a scalar */
    size_t cells, capacity;              /* capacity of the buffers in cells; in particles */
} CellLists;

static void cell_lists_bind(const CellLists *lists);

enum { CELLS_MAX = 1 << 24 };

double cell_lists_size(const VolumeGrid *grid, double radius, int size[3])
{
    const double all = (double)grid->size[0] * grid->size[1] * grid->size[2];
    const double side = fmax(radius, cbrt(all / CELLS_MAX) * 1.1);
    for (int k = 0; k < 3; k++)
        size[k] = (int)floor(grid->size[k] / side) + 1;
    return 1 / side;
}

static GLuint compile_lists(const char *label, const char *file, const char *defines, Error *error)
{
    return program_create(label, (const char *const[]){file, NULL}, defines, error);
}

/* Returns false if a shader does not compile; call cell_lists_destroy in either case. */
static bool cell_lists_create(CellLists *lists, bool scalar, Error *error)
{
    *lists = (CellLists){0};
    lists->count = compile_lists("cell count", "volume/cell_count.comp", NULL, error);
    lists->place =
        lists->count && prefix_sums_create(&lists->sums, error)
            ? compile_lists("cell place", "volume/cell_count.comp",
                            scalar ? "#define PLACE 1\n#define SCALAR 1\n" : "#define PLACE 1\n", error)
            : 0;
    return lists->place != 0;
}

static void cell_lists_destroy(CellLists *lists)
{
    glDeleteProgram(lists->count);
    prefix_sums_destroy(&lists->sums);
    glDeleteProgram(lists->place);
    glDeleteBuffers(3, (GLuint[]){lists->starts, lists->particles, lists->scalars});
    *lists = (CellLists){0};
}

static void reserve_lists(CellLists *lists, size_t cells, size_t count, bool scalar)
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

static void run_lists(GLuint program, const VoxelizeJob *job, size_t invocations)
{
    glUseProgram(program);
    particle_bind(program, job->particles, job->carried);
    work_run(invocations);
}

/* Makes the lists, and leaves the buffers bound. */
static void cell_lists_make(CellLists *lists, const VoxelizeJob *job)
{
    const size_t count = job->particles->count;
    int size[3];
    cell_lists_size(&job->volume->grid, job->radius, size);
    reserve_lists(lists, (size_t)size[0] * size[1] * size[2], count, job->scalar);
    cell_lists_bind(lists);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(lists->starts, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    run_lists(lists->count, job, count);
    prefix_sums_run(&lists->sums, lists->starts, (size_t)size[0] * size[1] * size[2] + 1);
    run_lists(lists->place, job, count);
}

static void cell_lists_bind(const CellLists *lists)
{
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, LIST_STARTS_STORAGE, 3,
                      (GLuint[]){lists->starts, lists->particles, lists->scalars});
}

/* Voxelization by compute shaders: particles scatter or voxels gather; also makes the lists for the field
   without a volume. */

typedef struct ByCompute {
    VolumeMethod method;
    bool scalar, atomics; /* float atomics are supported */
    GLuint program;       /* 0 with `direct` */
    CellLists lists;      /* empty with `scatter` */
} ByCompute;

static void compute_destroy(void *state)
{
    ByCompute *own = state;
    glDeleteProgram(own->program);
    cell_lists_destroy(&own->lists);
    free(own);
}

static bool create_programs(ByCompute *own, Error *error)
{
    static const char *const scatter[] = {"volume/voxelize_scatter.comp", NULL};
    static const char *const gather[] = {"volume/voxelize_gather.comp", NULL};
    char defines[160];
    snprintf(defines, sizeof defines, "%s%s",
             own->atomics && own->method == VOLUME_SCATTER
                 ? "#extension GL_NV_shader_atomic_float : require\n#define FLOAT_ATOMICS 1\n"
                 : "",
             own->scalar ? "#define SCALAR 1\n" : "");
    if (own->method != VOLUME_SCATTER && !cell_lists_create(&own->lists, own->scalar, error))
        return false;
    if (own->method == VOLUME_DIRECT)
        return true;
    own->program =
        program_create("voxelize", own->method == VOLUME_SCATTER ? scatter : gather, defines, error);
    return own->program != 0;
}

static void *create(VolumeMethod method, bool scalar, bool atomics, Error *error)
{
    ByCompute *own = calloc(1, sizeof *own);
    if (!own) {
        error_set(error, "out of memory for the voxelizer");
        return NULL;
    }
    own->method = method;
    own->scalar = scalar;
    own->atomics = atomics;
    if (create_programs(own, error))
        return own;
    compute_destroy(own);
    return NULL;
}

static void *compute_create(VolumeMethod method, bool scalar, Error *error)
{
    return create(method, scalar, epoxy_has_gl_extension("GL_NV_shader_atomic_float"), error);
}

void *voxelize_compute_plain(VolumeMethod method, bool scalar, Error *error)
{
    return create(method, scalar, false, error);
}

static void bind_images(const ByCompute *own, const Volume *volume, bool bits, GLenum access)
{
    const GLenum format = bits ? GL_R32UI : GL_R32F;
    glBindImageTexture(FIELD_IMAGE, volume->field, 0, GL_TRUE, 0, access, format);
    if (own->scalar)
        glBindImageTexture(FIELD_SCALAR_IMAGE, volume->scalar, 0, GL_TRUE, 0, access, format);
}

static void scatter(ByCompute *own, const VoxelizeJob *job)
{
    static const GLfloat none = 0;
    const size_t discs = (size_t)ceil(2 * job->radius) + 1;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glClearTexImage(job->volume->field, 0, GL_RED, GL_FLOAT, &none);
    if (own->scalar)
        glClearTexImage(job->volume->scalar, 0, GL_RED, GL_FLOAT, &none);
    particle_bind(own->program, job->particles, job->carried);
    glProgramUniform1ui(own->program, DISCS_AT, (GLuint)discs);
    glUseProgram(own->program);
    bind_images(own, job->volume, !own->atomics, GL_READ_WRITE);
    work_run(job->particles->count * discs);
}

static void gather(ByCompute *own, const VoxelizeJob *job)
{
    const int *size = job->volume->grid.size;
    cell_lists_make(&own->lists, job);
    glUseProgram(own->program);
    bind_images(own, job->volume, false, GL_WRITE_ONLY);
    glDispatchCompute((GLuint)(size[0] + 7) / 8, (GLuint)(size[1] + 1) / 2, (GLuint)(size[2] + 1) / 2);
}

static bool compute_run(void *state, const VoxelizeJob *job, Error *error)
{
    ByCompute *own = state;
    (void)error;
    if (own->method == VOLUME_SCATTER)
        scatter(own, job);
    else if (own->method == VOLUME_GATHER)
        gather(own, job);
    else
        cell_lists_make(&own->lists, job);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return true;
}

void voxelize_compute_bind(const void *state)
{
    cell_lists_bind(&((const ByCompute *)state)->lists);
}

const VoxelizeMethod voxelize_compute = {
    .create = compute_create,
    .destroy = compute_destroy,
    .run = compute_run,
};
