#include "render/views/volume/volume_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { CUBE_BYTES = 8, CUBE_VERTICES = 3 * ISO_TRIANGLES_MOST };

/* As mesh.vert reads the cases: 15 edges in bytes, then the number of triangles. */
typedef struct PackedCases {
    uint8_t edge[ISO_CASES][CUBE_VERTICES + 1];
} PackedCases;

static GLuint create_cases(void)
{
    IsoCases cases;
    PackedCases packed;
    GLuint buffer;
    isosurface_cases(&cases);
    for (int i = 0; i < ISO_CASES; i++) {
        memcpy(packed.edge[i], cases.edge[i], CUBE_VERTICES);
        packed.edge[i][CUBE_VERTICES] = cases.triangles[i];
    }
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, "cases of marching cubes");
    glNamedBufferStorage(buffer, sizeof packed, &packed, 0);
    return buffer;
}

bool surface_mesh_create(SurfaceMesh *mesh, bool facets, Error *error)
{
    const char *const lists[] = {"volume/mesh_list.comp", NULL};
    *mesh = (SurfaceMesh){.list = program_create("surface mesh list", lists, NULL, error)};
    if (mesh->list)
        mesh->draw =
            program_create_pair("surface mesh", "volume/mesh.vert",
                                facets ? "volume/mesh_facets.frag" : "render/depth_only.frag", error);
    if (!mesh->draw)
        return false;
    mesh->cases = create_cases();
    glCreateBuffers(1, &mesh->commands);
    glObjectLabel(GL_BUFFER, mesh->commands, -1, "surface mesh command");
    glNamedBufferStorage(mesh->commands, 4 * sizeof(GLuint), NULL, GL_DYNAMIC_STORAGE_BIT);
    glCreateVertexArrays(1, &mesh->vertex_array);
    return true;
}

void surface_mesh_destroy(SurfaceMesh *mesh)
{
    glDeleteProgram(mesh->list);
    glDeleteProgram(mesh->draw);
    glDeleteBuffers(3, (GLuint[]){mesh->cases, mesh->cubes, mesh->commands});
    glDeleteVertexArrays(1, &mesh->vertex_array);
    *mesh = (SurfaceMesh){0};
}

/* All cubes of a small grid; of a large one as many as the driver takes in a buffer, and as have numbers. */
size_t surface_mesh_capacity(const VolumeGrid *grid)
{
    GLint64 most = 0;
    size_t cubes = 1;
    for (int k = 0; k < 3; k++)
        cubes *= (size_t)grid->size[k] + 1;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    most = most < INT32_MAX ? most : INT32_MAX;
    return cubes < (size_t)most / CUBE_BYTES ? cubes : (size_t)most / CUBE_BYTES;
}

static void make_room(SurfaceMesh *mesh, const VolumeGrid *grid)
{
    const size_t capacity = surface_mesh_capacity(grid);
    if (capacity <= mesh->capacity)
        return;
    glDeleteBuffers(1, &mesh->cubes);
    glCreateBuffers(1, &mesh->cubes);
    glObjectLabel(GL_BUFFER, mesh->cubes, -1, "cubes with a surface");
    glNamedBufferStorage(mesh->cubes, (GLsizeiptr)(capacity * CUBE_BYTES), NULL, 0);
    mesh->capacity = capacity;
}

void surface_mesh_make(SurfaceMesh *mesh, const VolumeGrid *grid, const int bricks[3])
{
    static const GLuint none[4] = {0, 1, 0, 0};
    make_room(mesh, grid);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glNamedBufferSubData(mesh->commands, 0, sizeof none, none);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, MESH_CUBES_STORAGE, mesh->cubes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, MESH_COMMAND_STORAGE, mesh->commands);
    glUseProgram(mesh->list);
    glDispatchCompute((GLuint)bricks[0], (GLuint)bricks[1], (GLuint)bricks[2]);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void surface_mesh_draw(const SurfaceMesh *mesh)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, MESH_CUBES_STORAGE, mesh->cubes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, MESH_CASES_STORAGE, mesh->cases);
    glUseProgram(mesh->draw);
    glBindVertexArray(mesh->vertex_array);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, mesh->commands);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
}

size_t surface_mesh_triangles(const SurfaceMesh *mesh)
{
    IsoCases cases;
    GLuint vertices = 0;
    size_t triangles = 0;
    isosurface_cases(&cases);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(mesh->commands, 0, sizeof vertices, &vertices);
    const size_t count = vertices / CUBE_VERTICES;
    GLuint(*cube)[2] = calloc(count + 1, sizeof *cube);
    if (cube && count > 0)
        glGetNamedBufferSubData(mesh->cubes, 0, (GLsizeiptr)(count * CUBE_BYTES), cube);
    for (size_t i = 0; cube && i < count; i++)
        triangles += cases.triangles[cube[i][1] >> 16];
    free(cube);
    return triangles;
}
