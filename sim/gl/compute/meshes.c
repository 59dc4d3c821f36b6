/* Distances to mesh solids for the shaders: shaders/sim/mesh_distance.glsl. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/mesh_block.h"
#include "sim/mesh/mesh_shape.h"

#include <epoxy/gl.h>
#include <string.h>

static const MeshShape *shape_of(const Compute *c, int solid)
{
    const SolidDef *def = &c->constants->solids[solid];
    return def->kind == SOLID_MESH ? def->mesh.shape : NULL;
}

static MeshGrid grid_of(const DistanceGrid *from, double scale, size_t first)
{
    MeshGrid grid = {.exact_cell = from->cell,
                     .exact_scale = scale,
                     .cell = (float)from->cell,
                     .scale = (float)scale,
                     .first = (int)first};
    for (int k = 0; k < 3; k++) {
        grid.exact_low[k] = from->low[k];
        grid.exact_inner[k] = from->inner[k];
        grid.low[k] = (float)from->low[k];
        grid.inner[k] = (float)from->inner[k];
        grid.size[k] = from->size[k];
    }
    return grid;
}

/* The first solid with the same mesh, whose values are shared. */
static int same_before(const Compute *c, int solid)
{
    int other = 0;
    while (shape_of(c, other) != shape_of(c, solid))
        other++;
    return other;
}

static size_t places(const Compute *c, MeshBlock *block)
{
    size_t count = 0;
    for (int k = 0; k < c->constants->solid_count; k++) {
        const MeshShape *shape = shape_of(c, k);
        const int same = shape ? same_before(c, k) : k;
        if (!shape)
            continue;
        block->meshes[k] = grid_of(&shape->distance, c->constants->solids[k].mesh.scale, count);
        if (same < k)
            block->meshes[k].first = block->meshes[same].first;
        else
            count += distance_count(&shape->distance);
    }
    return count;
}

bool compute_meshes_create(Compute *c, Error *error)
{
    MeshBlock block = {0};
    GLint most = 0;
    const size_t count = places(c, &block);
    if (count == 0)
        return true;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (count > (size_t)most)
        return error_set(
            error,
            "backend compute: the distances of the meshes are %zu numbers, and a texture of this driver holds "
            "%d; use the backend cpu",
            count, most);
    ComputeMeshes *meshes = &c->meshes;
    meshes->block = compute_buffer(c, "meshes", sizeof block);
    meshes->values = compute_buffer(c, "distances from meshes", sizeof(float) * count);
    if (!meshes->block || !meshes->values)
        return true; /* compute_buffer has set `full` */
    glNamedBufferSubData(meshes->block, 0, sizeof block, &block);
    for (int k = 0; k < c->constants->solid_count; k++)
        if (shape_of(c, k) && same_before(c, k) == k)
            glNamedBufferSubData(meshes->values, (GLintptr)sizeof(float) * block.meshes[k].first,
                                 (GLsizeiptr)(sizeof(float) * distance_count(&shape_of(c, k)->distance)),
                                 shape_of(c, k)->distance.value);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &meshes->texture);
    glObjectLabel(GL_TEXTURE, meshes->texture, -1, "distances from meshes");
    glTextureBuffer(meshes->texture, GL_R32F, meshes->values);
    return true;
}

void compute_meshes_destroy(Compute *c)
{
    const GLuint buffers[] = {c->meshes.block, c->meshes.values};
    glDeleteTextures(1, &c->meshes.texture);
    glDeleteBuffers(2, buffers);
}

void compute_meshes_bind(const Compute *c)
{
    if (!c->meshes.texture)
        return;
    glBindBufferBase(GL_UNIFORM_BUFFER, MESH_BLOCK, c->meshes.block);
    glBindTextureUnit(MESH_VALUES_TEXTURE, c->meshes.texture);
}
