#include "render/frame/passes.h"
#include "shaders/shared/solid_block.h"
#include "sim/gpu/program.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

_Static_assert(SOLIDS_DRAWN_MAX == SOLIDS_MAX, "the shaders draw all solids of a scene");

struct Solids {
    GLuint program, casting;
    GLuint vertex_array, vertices, indices, poses;
    GLsizei index_count;
    int count; /* solids with a mesh; 0 before the first picture */
    SolidDef shapes[SOLIDS_MAX];
    double slab; /* depth of the flat box when the meshes were made, m; 0: not flat */
};

Solids *solids_create(Error *error)
{
    Solids *solids = calloc(1, sizeof *solids);
    if (!solids) {
        error_set(error, "out of memory for the solids");
        return NULL;
    }
    glCreateVertexArrays(1, &solids->vertex_array);
    glCreateBuffers(1, &solids->poses);
    glObjectLabel(GL_BUFFER, solids->poses, -1, "solid poses");
    glNamedBufferStorage(solids->poses, sizeof(SolidBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    solids->program = program_create_pair("solids", "render/solids.vert", "render/solids.frag", error);
    if (solids->program)
        solids->casting = program_create_pair("solids shadow", "render/solids_shadow.vert",
                                              "render/depth_only.frag", error);
    if (solids->casting)
        return solids;
    solids_destroy(solids);
    return NULL;
}

void solids_destroy(Solids *solids)
{
    if (!solids)
        return;
    glDeleteProgram(solids->program);
    glDeleteProgram(solids->casting);
    glDeleteVertexArrays(1, &solids->vertex_array);
    glDeleteBuffers(1, &solids->vertices);
    glDeleteBuffers(1, &solids->indices);
    glDeleteBuffers(1, &solids->poses);
    free(solids);
}

static GLuint create_buffer(const void *data, size_t size, const char *label)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, label);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, data, 0);
    return buffer;
}

static void set_attribute(GLuint vertex_array, GLuint number, GLint words, bool whole, size_t offset)
{
    glEnableVertexArrayAttrib(vertex_array, number);
    glVertexArrayAttribBinding(vertex_array, number, 0);
    if (whole)
        glVertexArrayAttribIFormat(vertex_array, number, words, GL_UNSIGNED_INT, (GLuint)offset);
    else
        glVertexArrayAttribFormat(vertex_array, number, words, GL_FLOAT, GL_FALSE, (GLuint)offset);
}

static void keep_mesh(Solids *solids, const SolidMesh *mesh)
{
    const GLuint array = solids->vertex_array;
    glDeleteBuffers(1, &solids->vertices);
    glDeleteBuffers(1, &solids->indices);
    solids->vertices =
        create_buffer(mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices, "solid vertices");
    solids->indices =
        create_buffer(mesh->indices, mesh->index_count * sizeof *mesh->indices, "solid indices");
    glVertexArrayVertexBuffer(array, 0, solids->vertices, 0, sizeof(SolidVertex));
    glVertexArrayElementBuffer(array, solids->indices);
    set_attribute(array, 0, 3, false, offsetof(SolidVertex, position));
    set_attribute(array, 1, 3, false, offsetof(SolidVertex, normal));
    set_attribute(array, 2, 1, true, offsetof(SolidVertex, solid));
}

static bool meshes_fit(const Solids *solids, const WorldDef *world, double slab)
{
    bool fit = solids->count == world->solid_count && solids->slab == slab;
    for (int i = 0; fit && i < world->solid_count; i++)
        fit = solid_mesh_same(&solids->shapes[i], &world->solids[i]);
    return fit;
}

static void follow_shapes(Solids *solids, const WorldDef *world, double slab)
{
    SolidMesh mesh = {0};
    bool whole = true;
    if (meshes_fit(solids, world, slab))
        return;
    for (int i = 0; whole && i < world->solid_count; i++)
        whole = solid_mesh_add(&mesh, &world->solids[i], slab, (uint32_t)i);
    solids->index_count = whole ? (GLsizei)mesh.index_count : 0;
    if (whole && mesh.index_count > 0) {
        keep_mesh(solids, &mesh);
        for (int i = 0; i < world->solid_count; i++)
            solids->shapes[i] = world->solids[i];
        solids->count = world->solid_count;
        solids->slab = slab;
    }
    solid_mesh_destroy(&mesh);
}

void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16])
{
    BoxState pose;
    solid_pose_in(solid, particles->time, &particles->floating[number], &pose);
    camera_box_matrix(&pose, to_world);
    matrix_multiply(frame->box_to_world, to_world, to_world);
}

void solids_update_poses(Solids *solids, const ParticleBuffers *particles, const Frame *frame)
{
    const WorldDef *world = frame->world;
    SolidBlock block = {0};
    follow_shapes(solids, world, frame->slab);
    for (int i = 0; i < world->solid_count; i++) {
        float to_world[16];
        solid_to_world(&world->solids[i], i, particles, frame, to_world);
        matrix_multiply(frame->camera.view, to_world, block.solids[i].to_eye);
        matrix_multiply(frame->world_to_light, to_world, block.solids[i].to_light);
        for (int k = 0; k < 3; k++)
            block.solids[i].color[k] = world->solids[i].color[k];
    }
    glNamedBufferSubData(solids->poses, 0, sizeof block, &block);
}

/* All meshes are closed: of each face, only the outside is ever seen. */
static void draw_meshes(const Solids *solids, GLuint program, GLenum hidden)
{
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(hidden);
    glBindBufferBase(GL_UNIFORM_BUFFER, SOLID_BLOCK, solids->poses);
    glUseProgram(program);
    glBindVertexArray(solids->vertex_array);
    glDrawElements(GL_TRIANGLES, solids->index_count, GL_UNSIGNED_INT, NULL);
    glDisable(GL_CULL_FACE);
}

/* Draws the sides away from the light. Lit sides are a wall's thickness nearer to the light, so the
   comparison needs almost no bias. Depths are clamped: solids outside the map's depth range still cast. */
void solids_cast(const Solids *solids)
{
    glEnable(GL_DEPTH_CLAMP);
    draw_meshes(solids, solids->casting, GL_FRONT);
    glDisable(GL_DEPTH_CLAMP);
}

void solids_draw(const Solids *solids, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    draw_meshes(solids, solids->program, GL_BACK);
}
