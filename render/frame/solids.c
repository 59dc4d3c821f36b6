/* Solids: lit and opaque, drawn before every view, so that the view's depth test hides covered parts. Reads
   the def's solids at the state's time; writes the target's colour and depth, and the solids' shadow map.
   Has objects only in scenes with solids. */
#include "render/frame/effect.h"
#include "shaders/shared/solid_block.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(SOLIDS_DRAWN_MAX == SOLIDS_MAX, "the shaders draw all solids of a scene");

typedef struct Solids {
    GLuint program, casting;
    GLuint vertex_array, vertices, indices, poses;
    GLsizei index_count;
    int count; /* solids with a mesh; 0 before the first picture */
    SolidDef shapes[SOLIDS_MAX];
    double slab; /* depth of the flat box when the meshes were made, m; 0: not flat */
} Solids;

static bool solids_prepare(void *state, const Subject *subject, Error *error)
{
    Solids *solids = state;
    if (subject->world->solid_count == 0 || solids->casting)
        return true;
    if (!solids->poses) {
        glCreateVertexArrays(1, &solids->vertex_array);
        glCreateBuffers(1, &solids->poses);
        glObjectLabel(GL_BUFFER, solids->poses, -1, "solid poses");
        glNamedBufferStorage(solids->poses, sizeof(SolidBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    }
    if (!solids->program)
        solids->program = program_create_pair("solids", "render/solids.vert", "render/solids.frag", error);
    if (solids->program)
        solids->casting = program_create_pair("solids shadow", "render/solids_shadow.vert",
                                              "render/solids_shadow.frag", error);
    return solids->casting != 0;
}

static void solids_destroy(void *state)
{
    Solids *solids = state;
    if (!solids->poses)
        return;
    glDeleteProgram(solids->program);
    glDeleteProgram(solids->casting);
    glDeleteVertexArrays(1, &solids->vertex_array);
    glDeleteBuffers(1, &solids->vertices);
    glDeleteBuffers(1, &solids->indices);
    glDeleteBuffers(1, &solids->poses);
    *solids = (Solids){0};
}

static void solids_release(void *state, const Subject *subject)
{
    if (subject->world->solid_count == 0)
        solids_destroy(state);
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

static void solid_to_box(const SolidDef *solid, int number, const ParticleBuffers *particles,
                         float to_box[16])
{
    BoxState pose;
    solid_pose_in(solid, particles->time, &particles->floating[number], &pose);
    camera_box_matrix(&pose, to_box);
}

void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16])
{
    solid_to_box(solid, number, particles, to_world);
    matrix_multiply(frame->box_to_world, to_world, to_world);
}

/* Floating solids may leave the box. Of meshes the cut is unknown. */
static void fill_cut(DrawnSolid *drawn, const SolidDef *solid, double slab)
{
    static const uint32_t cuts[SOLID_KIND_COUNT] = {[SOLID_SPHERE] = SOLID_CUT_SPHERE,
                                                    [SOLID_BOX] = SOLID_CUT_BOX,
                                                    [SOLID_CYLINDER] = SOLID_CUT_CYLINDER,
                                                    [SOLID_BOWL] = SOLID_CUT_BOWL};
    drawn->cut = solid_floats(solid) ? 0 : cuts[solid->kind];
    drawn->across[0] = slab > 0 ? 0 : 1;
    drawn->size[0] = (float)solid->radius;
    drawn->size[1] =
        (float)(solid->kind == SOLID_BOWL ? solid->radius + solid->thickness : solid->height / 2);
    for (int k = 0; solid->kind == SOLID_BOX && k < 3; k++)
        drawn->size[k] = slab > 0 && k == 2 ? 1 : (float)(solid->size[k] / 2);
}

/* Makes the meshes again only if shapes, or the depth of a flat box, have changed. If memory is short, there
   are no meshes. */
static void update_poses(Solids *solids, const ParticleBuffers *particles, const Frame *frame)
{
    const WorldDef *world = frame->world;
    SolidBlock block = {0};
    follow_shapes(solids, world, frame->slab);
    for (int i = 0; i < world->solid_count; i++) {
        float to_world[16];
        DrawnSolid *drawn = &block.solids[i];
        solid_to_box(&world->solids[i], i, particles, drawn->to_box);
        matrix_multiply(frame->box_to_world, drawn->to_box, to_world);
        matrix_multiply(frame->camera.view, to_world, drawn->to_eye);
        matrix_multiply(frame->light.from_world, to_world, drawn->to_light);
        memcpy(drawn->color, world->solids[i].color, sizeof world->solids[i].color);
        fill_cut(drawn, &world->solids[i], frame->slab);
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

static bool solids_wanted(const Picture *picture)
{
    return picture->frame.world->solid_count > 0 && !picture->frame.no_solids;
}

static void solids_draw(void *state, Picture *picture)
{
    const Solids *solids = state;
    const Frame *frame = &picture->frame;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    draw_meshes(solids, solids->program, GL_BACK);
}

static const EffectState solids_state = {
    .size = sizeof(Solids), .prepare = solids_prepare, .release = solids_release, .destroy = solids_destroy};

const Effect effect_solids = {.name = "solids",
                              .stage = STAGE_SOLIDS,
                              .state = &solids_state,
                              .wanted = solids_wanted,
                              .draw = solids_draw};

/* Lit sides are a wall's thickness nearer to the light than the sides drawn, so the comparison needs almost
   no bias. Depths are clamped: solids outside the map's depth range still cast. */
void solids_cast(const Picture *picture)
{
    Solids *solids = effect_state(picture->states, &solids_state);
    update_poses(solids, picture->particles, &picture->frame);
    glEnable(GL_DEPTH_CLAMP);
    draw_meshes(solids, solids->casting, GL_FRONT);
    glDisable(GL_DEPTH_CLAMP);
}
