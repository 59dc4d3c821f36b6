#include "render/particles/particle_bind.h"

#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/timer.h"

#include <epoxy/gl.h>
#include <stdbool.h>
#include <stdint.h>

/* Each block that a program declares gets a buffer, even if the shader does not read the block: an unbound
   block makes some drivers spoil other blocks. Positions replace a missing attribute. */
static void bind_attribute(GLuint binding, const ParticleAttribute *attribute,
                           const ParticleBuffers *particles)
{
    const ParticleAttribute *bound = attribute->buffer ? attribute : &particles->position;
    if (bound->buffer && particles->count)
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, bound->buffer, (GLintptr)bound->offset,
                          (GLsizeiptr)(particles->count * bound->stride));
}

void particle_bind(unsigned program, const ParticleBuffers *particles, Scalar scalar)
{
    const ParticleAttribute *shown = &particles->scalar[scalar];
    bind_attribute(POSITIONS_STORAGE, &particles->position, particles);
    bind_attribute(SCALARS_STORAGE, shown, particles);
    bind_attribute(FLUIDS_STORAGE, &particles->fluid, particles);
    glProgramUniform1ui(program, POSITION_STRIDE_AT, (GLuint)(particles->position.stride / 4));
    glProgramUniform1ui(program, SCALAR_STRIDE_AT, (GLuint)(shown->stride / 4));
    glProgramUniform1ui(program, FLUID_STRIDE_AT, (GLuint)(particles->fluid.stride / 4));
}

const ParticleAttribute *particle_shown(const ParticleBuffers *particles, Scalar color_by)
{
    return color_by == SCALAR_FLUID ? &particles->fluid : &particles->scalar[color_by];
}

unsigned particle_bind_one(unsigned binding, const ParticleAttribute *attribute, size_t count,
                           unsigned stand_in)
{
    if (attribute->buffer)
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, attribute->buffer, (GLintptr)attribute->offset,
                          (GLsizeiptr)(count * attribute->stride));
    else
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, stand_in);
    return attribute->buffer ? (unsigned)(attribute->stride / 4) : 0;
}

void particle_bind_ids(unsigned program, const ParticleBuffers *particles)
{
    const ParticleAttribute *ids = &particles->scalar[SCALAR_ID];
    bind_attribute(IDS_STORAGE, ids, particles);
    glProgramUniform1ui(program, ID_STRIDE_AT, (GLuint)(ids->buffer ? ids->stride / 4 : 0));
}

float point_limit(void)
{
    GLfloat range[2] = {0};
    if (gl_renderer_is_software())
        glGetFloatv(GL_POINT_SIZE_RANGE, range);
    return range[1];
}

void quad_indices_create(QuadIndices *indices)
{
    *indices = (QuadIndices){0};
    glCreateVertexArrays(1, &indices->vertex_array);
    glObjectLabel(GL_VERTEX_ARRAY, indices->vertex_array, -1, "quads");
}

void quad_indices_destroy(QuadIndices *indices)
{
    glDeleteVertexArrays(1, &indices->vertex_array);
    glDeleteBuffers(1, &indices->buffer);
    *indices = (QuadIndices){0};
}

static void fill(uint32_t *index, size_t count)
{
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    for (size_t i = 0; i < 6 * count; i++)
        index[i] = (uint32_t)(4 * (i / 6)) + corners[i % 6];
}

/* Makes the index buffer again for more particles. */
static void reserve(QuadIndices *indices, size_t count)
{
    const GLsizeiptr size = (GLsizeiptr)(6 * count * sizeof(uint32_t));
    glDeleteBuffers(1, &indices->buffer);
    glCreateBuffers(1, &indices->buffer);
    glObjectLabel(GL_BUFFER, indices->buffer, -1, "quad indices");
    glNamedBufferStorage(indices->buffer, size, NULL, GL_MAP_WRITE_BIT);
    uint32_t *mapped = glMapNamedBufferRange(indices->buffer, 0, size, GL_MAP_WRITE_BIT);
    indices->capacity = mapped ? count : 0;
    if (mapped)
        fill(mapped, count);
    glUnmapNamedBuffer(indices->buffer);
    glVertexArrayElementBuffer(indices->vertex_array, indices->buffer);
}

static bool prepare(QuadIndices *indices, size_t count)
{
    if (count > indices->capacity)
        reserve(indices, work_capacity(indices->capacity, count));
    glBindVertexArray(indices->vertex_array);
    return count && count <= indices->capacity;
}

void quad_indices_draw_indirect(QuadIndices *indices, size_t count, unsigned commands, size_t offset)
{
    if (!prepare(indices, count))
        return;
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands);
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, (const char *)NULL + offset);
}

void quad_indices_draw(QuadIndices *indices, size_t count)
{
    if (!prepare(indices, count))
        return;
    glDrawElements(GL_TRIANGLES, (GLsizei)(6 * count), GL_UNSIGNED_INT, NULL);
}
