#include "render/frame/passes.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"
#include "sim/mesh/mesh_shape.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS_MOST = 1 << 22, SIDE_MOST = 1024, SIDES = 36 };

/* The voxels of one solid. */
typedef struct VoxelBlock {
    GLuint texture;
    SolidDef shape;
    double slab, wanted; /* m: inputs of the last voxelisation */
    double low[3], cell; /* m: position of the first texel; distance between texels */
    int size[3];         /* texels */
} VoxelBlock;

struct SolidVoxels {
    GLuint program, array;
    VoxelBlock block[SOLIDS_MAX];
    bool short_of_memory;
};

SolidVoxels *solid_voxels_create(Error *error)
{
    SolidVoxels *voxels = calloc(1, sizeof *voxels);
    if (!voxels) {
        error_set(error, "out of memory for the voxels of solids");
        return NULL;
    }
    glCreateVertexArrays(1, &voxels->array);
    voxels->program =
        program_create_pair("solid voxels", "volume/solid_voxels.vert", "volume/solid_voxels.frag", error);
    if (voxels->program)
        return voxels;
    solid_voxels_destroy(voxels);
    return NULL;
}

void solid_voxels_destroy(SolidVoxels *voxels)
{
    if (!voxels)
        return;
    for (int i = 0; i < SOLIDS_MAX; i++)
        glDeleteTextures(1, &voxels->block[i].texture);
    glDeleteProgram(voxels->program);
    glDeleteVertexArrays(1, &voxels->array);
    free(voxels);
}

const char *solid_voxels_missing(const SolidVoxels *voxels)
{
    return voxels && voxels->short_of_memory ? "solids, whose voxels there is no memory for" : NULL;
}

/* ---- voxelising ---- */

void solid_voxels_bounds(const SolidDef *solid, double slab, double low[3], double high[3])
{
    const double reach = solid->kind == SOLID_BOWL ? solid->radius + solid->thickness : solid->radius;
    for (int k = 0; k < 3; k++) {
        high[k] = reach;
        if (solid->kind == SOLID_BOX)
            high[k] = solid->size[k] / 2;
        else if (solid->kind == SOLID_MESH)
            high[k] = solid->mesh.shape ? solid->mesh.scale * solid->mesh.shape->half[k] : 0;
        else if (solid->kind == SOLID_CYLINDER && k == 1)
            high[k] = solid->height / 2;
        if (slab > 0 && k == 2 && solid->kind != SOLID_CYLINDER)
            high[k] = slab / 2;
        low[k] = -high[k];
    }
    if (solid->kind == SOLID_BOWL)
        high[1] = 0;
}

/* Adds a cell on each side, so that the outermost texels are outside. */
static double texels_of(VoxelBlock *block, const double low[3], const double high[3], double cell)
{
    double texels = 1, most = 0;
    for (int k = 0; k < 3; k++) {
        const double cells = ceil((high[k] - low[k]) / cell);
        block->size[k] = (int)fmin(cells, 1e6) + 3;
        block->low[k] = 0.5 * (low[k] + high[k] - (block->size[k] - 1) * cell);
        texels *= block->size[k];
        most = fmax(most, block->size[k]);
    }
    block->cell = cell;
    return most > SIDE_MOST ? INFINITY : texels;
}

typedef struct VoxelWork {
    const VoxelBlock *block;
    float *distance;
} VoxelWork;

/* In two dimensions: the plane's shape, extruded through the box's depth. */
static double distance_of(const VoxelBlock *block, const double x[3])
{
    const SolidDef *shape = &block->shape;
    if (!(block->slab > 0) || shape->kind == SOLID_CYLINDER)
        return solid_distance(shape, 3, x);
    return fmax(solid_distance(shape, 2, (double[3]){x[0], x[1], 0}), fabs(x[2]) - block->slab / 2);
}

static void layers_of(void *context, size_t begin, size_t end)
{
    const VoxelWork *work = context;
    const VoxelBlock *block = work->block;
    const int *size = block->size;
    for (size_t k = begin; k < end; k++)
        for (int j = 0; j < size[1]; j++)
            for (int i = 0; i < size[0]; i++) {
                const double x[3] = {block->low[0] + i * block->cell, block->low[1] + j * block->cell,
                                     block->low[2] + (double)k * block->cell};
                work->distance[(size_t)i + (size_t)size[0] * ((size_t)j + (size_t)size[1] * k)] =
                    (float)distance_of(block, x);
            }
}

static void keep_block(VoxelBlock *block, const float *distance)
{
    static const GLenum along[3] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    const int *size = block->size;
    glDeleteTextures(1, &block->texture);
    glCreateTextures(GL_TEXTURE_3D, 1, &block->texture);
    glObjectLabel(GL_TEXTURE, block->texture, -1, "solid voxels");
    glTextureStorage3D(block->texture, 1, GL_R32F, size[0], size[1], size[2]);
    glTextureParameteri(block->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(block->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (int k = 0; k < 3; k++)
        glTextureParameteri(block->texture, along[k], GL_CLAMP_TO_EDGE);
    glTextureSubImage3D(block->texture, 0, 0, 0, 0, size[0], size[1], size[2], GL_RED, GL_FLOAT, distance);
}

/* Returns false if memory is short: then there is no texture. */
static bool voxelise(VoxelBlock *block, const SolidDef *solid, double slab, double cell)
{
    double low[3], high[3];
    block->shape = *solid;
    block->slab = slab;
    block->wanted = cell;
    solid_voxels_bounds(solid, slab, low, high);
    while (texels_of(block, low, high, cell) > CELLS_MOST)
        cell *= 1.1;
    const size_t count = (size_t)block->size[0] * (size_t)block->size[1] * (size_t)block->size[2];
    VoxelWork work = {block, malloc(count * sizeof *work.distance)};
    if (!work.distance) {
        glDeleteTextures(1, &block->texture);
        block->texture = 0;
        return false;
    }
    parallel_ranges(parallel_processors(), (size_t)block->size[2], 1, layers_of, &work);
    keep_block(block, work.distance);
    free(work.distance);
    return true;
}

static bool update_block(VoxelBlock *block, const SolidDef *solid, double slab, double cell)
{
    const bool same = block->texture && block->slab == slab && block->wanted == cell &&
                      solid_mesh_same(&block->shape, solid);
    return same || voxelise(block, solid, slab, cell);
}

/* ---- drawing ---- */

static void draw_block(const VoxelBlock *block, const float to_eye[16], const float color[3])
{
    float high[3];
    for (int k = 0; k < 3; k++)
        high[k] = (float)(block->low[k] + (block->size[k] - 1) * block->cell);
    glUniformMatrix4fv(SOLID_TO_EYE_AT, 1, GL_FALSE, to_eye);
    glUniform3f(SOLID_LOW_AT, (GLfloat)block->low[0], (GLfloat)block->low[1], (GLfloat)block->low[2]);
    glUniform3fv(SOLID_HIGH_AT, 1, high);
    glUniform3fv(SOLID_COLOR_AT, 1, color);
    glUniform1f(SOLID_CELL_AT, (GLfloat)block->cell);
    glBindTextureUnit(FIELD_UNIT, block->texture);
    glDrawArrays(GL_TRIANGLES, 0, SIDES);
}

static void begin(const SolidVoxels *voxels, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(GL_FRONT);
    glUseProgram(voxels->program);
    glBindVertexArray(voxels->array);
}

void solid_voxels_draw(SolidVoxels *voxels, double cell, const ParticleBuffers *particles, const Frame *frame)
{
    const WorldDef *world = frame->world;
    voxels->short_of_memory = false;
    begin(voxels, frame);
    for (int i = 0; i < world->solid_count; i++) {
        float to_eye[16];
        if (world->solids[i].kind == SOLID_MESH && !world->solids[i].mesh.shape)
            continue; /* the mesh file is missing, as already reported */
        if (!update_block(&voxels->block[i], &world->solids[i], frame->slab, cell)) {
            voxels->short_of_memory = true;
            continue;
        }
        solid_to_world(&world->solids[i], i, particles, frame, to_eye);
        matrix_multiply(frame->camera.view, to_eye, to_eye);
        draw_block(&voxels->block[i], to_eye, world->solids[i].color);
    }
    glDisable(GL_CULL_FACE);
}
