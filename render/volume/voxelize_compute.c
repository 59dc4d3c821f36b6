/* Voxelization by compute shaders: particles scatter or voxels gather; also makes the lists for the field
   without a volume. */
#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "render/volume/cell_lists.h"
#include "render/volume/voxelize.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

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
