/* Voxelization by drawing: a particle becomes a point in each slice that the particle cuts, and blending
   sums. */
#include "render/particles/particles.h"
#include "render/views/volume/volume_private.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

unsigned volume_texture(const int size[3], unsigned format, const char *label)
{
    static const GLfloat none[4] = {0};
    GLuint texture;
    gl_debug_errors(); /* drops earlier errors: the query below is for this texture */
    glCreateTextures(GL_TEXTURE_3D, 1, &texture);
    glObjectLabel(GL_TEXTURE, texture, -1, label);
    glTextureStorage3D(texture, 1, format, size[0], size[1], size[2]);
    if (gl_errors_take(0) > 0) {
        glDeleteTextures(1, &texture);
        return 0;
    }
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (GLenum axis = 0; axis < 3; axis++)
        glTextureParameteri(texture,
                            (GLenum[]){GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}[axis],
                            GL_CLAMP_TO_EDGE);
    glClearTexImage(texture, 0, format == GL_R32F ? GL_RED : GL_RGBA, GL_FLOAT, none);
    return texture;
}

/* A point takes up to eleven of a geometry shader's 1,024 components. */
enum { GEOMETRY_POINTS = 80, PACKED = 4 };

typedef struct ByPoints {
    VolumeMethod method;
    bool scalar;
    const char *layer_extension; /* for gl_Layer in a vertex shader; NULL: one draw per layer */
    GLuint program, unpack;
    int discs; /* slices per particle that `program` is compiled for; geometry only */
    GLuint framebuffer, vertex_array;
    GLuint packed[2]; /* textures of `planes`: four slices per texel */
    int packed_size[3];
} ByPoints;

static void points_destroy(void *state)
{
    ByPoints *own = state;
    glDeleteProgram(own->program);
    glDeleteProgram(own->unpack);
    glDeleteFramebuffers(1, &own->framebuffer);
    glDeleteVertexArrays(1, &own->vertex_array);
    glDeleteTextures(2, own->packed);
    free(own);
}

static int slices_a_pass(const ByPoints *own)
{
    if (own->method == VOLUME_PLANES)
        return PACKED;
    return own->method == VOLUME_LAYERS && !own->layer_extension ? 1 : 0;
}

/* Compiles the program for at most `discs` slices per particle; only the geometry shader needs the number. */
static GLuint create_program(const ByPoints *own, int discs, Error *error)
{
    static const char *const plain[] = {"volume/voxelize.vert", "volume/voxelize.frag", NULL};
    static const char *const with_geometry[] = {"volume/voxelize.vert", "volume/voxelize.geom",
                                                "volume/voxelize.frag", NULL};
    const int invocations = (discs + GEOMETRY_POINTS - 1) / GEOMETRY_POINTS;
    const char *scalar = own->scalar ? "#define SCALAR 1\n" : "";
    char defines[256];
    if (own->method == VOLUME_GEOMETRY)
        snprintf(defines, sizeof defines, "%s#define INVOCATIONS %d\n#define SLICES %d\n", scalar,
                 invocations, (discs + invocations - 1) / invocations);
    else if (slices_a_pass(own))
        snprintf(defines, sizeof defines, "%s#define PASS 1\n#define SLICES %d\n%s", scalar,
                 slices_a_pass(own), own->method == VOLUME_PLANES ? "#define PACKED 1\n" : "");
    else
        snprintf(defines, sizeof defines, "#extension %s : require\n#define LAYERS 1\n%s",
                 own->layer_extension, scalar);
    return program_create("voxelize", own->method == VOLUME_GEOMETRY ? with_geometry : plain, defines, error);
}

static bool create_programs(ByPoints *own, Error *error)
{
    static const char *const unpack[] = {"volume/voxelize_unpack.comp", NULL};
    own->discs = own->method == VOLUME_GEOMETRY ? 12 : 0;
    own->program = create_program(own, own->discs, error);
    if (!own->program || own->method != VOLUME_PLANES)
        return own->program != 0;
    own->unpack = program_create("voxelize unpack", unpack, NULL, error);
    return own->unpack != 0;
}

static void *create(VolumeMethod method, bool scalar, const char *layer_extension, Error *error)
{
    static const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    ByPoints *own = calloc(1, sizeof *own);
    if (!own) {
        error_set(error, "out of memory for the voxelizer");
        return NULL;
    }
    own->method = method;
    own->scalar = scalar;
    own->layer_extension = layer_extension;
    glCreateVertexArrays(1, &own->vertex_array);
    glCreateFramebuffers(1, &own->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, own->framebuffer, -1, "volume");
    glNamedFramebufferDrawBuffers(own->framebuffer, scalar ? 2 : 1, buffers);
    if (create_programs(own, error))
        return own;
    points_destroy(own);
    return NULL;
}

static void *points_create(VolumeMethod method, bool scalar, Error *error)
{
    static const char *const extensions[] = {"GL_ARB_shader_viewport_layer_array",
                                             "GL_AMD_vertex_shader_layer"};
    for (int i = 0; i < 2; i++)
        if (epoxy_has_gl_extension(extensions[i]))
            return create(method, scalar, extensions[i], error);
    return create(method, scalar, NULL, error);
}

void *voxelize_points_plain(VolumeMethod method, bool scalar, Error *error)
{
    return create(method, scalar, NULL, error);
}

static bool points_fit(const VolumeGrid *grid, double radius, Error *error)
{
    GLfloat range[2] = {0};
    GLint layers = 0;
    glGetFloatv(GL_POINT_SIZE_RANGE, range);
    glGetIntegerv(GL_MAX_FRAMEBUFFER_LAYERS, &layers);
    if (2 * radius + 1 > range[1])
        return error_set(
            error,
            "a particle is %.0f cells wide, the driver draws points of %.0f pixels; take larger cells, or "
            "view.volume.method: slabs",
            2 * radius, range[1]);
    return grid->size[2] <= layers ||
           error_set(error,
                     "a volume of %d cells along z; this driver draws into %d layers: take larger cells",
                     grid->size[2], layers);
}

static void draw(const VoxelizeJob *job, GLsizei instances)
{
    const GLsizei count = (GLsizei)job->particles->count;
    if (count > 0)
        glDrawArraysInstanced(GL_POINTS, 0, count, instances);
}

/* Layer -1: all layers. */
static void attach(const ByPoints *own, const GLuint textures[2], int layer)
{
    for (int i = 0; i <= (int)own->scalar; i++)
        if (layer < 0)
            glNamedFramebufferTexture(own->framebuffer, GL_COLOR_ATTACHMENT0 + (GLenum)i, textures[i], 0);
        else
            glNamedFramebufferTextureLayer(own->framebuffer, GL_COLOR_ATTACHMENT0 + (GLenum)i, textures[i], 0,
                                           layer);
}

static void clear(const ByPoints *own, const GLuint textures[2])
{
    static const GLfloat none[4] = {0};
    attach(own, textures, -1);
    for (int i = 0; i <= (int)own->scalar; i++)
        glClearNamedFramebufferfv(own->framebuffer, GL_COLOR, i, none);
}

static void draw_passes(const ByPoints *own, const GLuint textures[2], const VoxelizeJob *job)
{
    const int slices = slices_a_pass(own), size = job->volume->grid.size[2];
    for (int slice = 0; slice < size; slice += slices) {
        attach(own, textures, slice / slices);
        glUniform1i(PASS_SLICE_AT, slice);
        draw(job, 1);
    }
}

static bool follow_packed(ByPoints *own, const VolumeGrid *grid, Error *error)
{
    const int size[3] = {grid->size[0], grid->size[1], (grid->size[2] + PACKED - 1) / PACKED};
    if (own->packed[0] && size[0] == own->packed_size[0] && size[1] == own->packed_size[1] &&
        size[2] == own->packed_size[2])
        return true;
    glDeleteTextures(2, own->packed);
    own->packed[0] = own->packed[1] = 0;
    for (int i = 0; i <= (int)own->scalar; i++) {
        own->packed[i] = volume_texture(size, GL_RGBA32F, "volume planes");
        if (!own->packed[i])
            return error_set(error, "the GPU has no memory for the planes of a volume; take larger cells");
    }
    for (int k = 0; k < 3; k++)
        own->packed_size[k] = size[k];
    return true;
}

static bool points_reserve(void *state, const VolumeGrid *grid, Error *error)
{
    ByPoints *own = state;
    return own->method != VOLUME_PLANES || follow_packed(own, grid, error);
}

static void unpack(const ByPoints *own, const GLuint textures[2], const int size[3])
{
    glUseProgram(own->unpack);
    for (int i = 0; i <= (int)own->scalar; i++) {
        glBindTextureUnit(PACKED_UNIT, own->packed[i]);
        glBindImageTexture(UNPACKED_IMAGE, textures[i], 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
        glDispatchCompute((GLuint)(size[0] + 7) / 8, (GLuint)(size[1] + 7) / 8, (GLuint)(size[2] + 3) / 4);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

/* The number of slices that a particle of `radius` may cut, in multiples of four. */
static bool follow_discs(ByPoints *own, double radius, Error *error)
{
    const int discs = (int)ceil(2 * radius / 4 + 0.25) * 4;
    if (own->method != VOLUME_GEOMETRY || discs == own->discs)
        return true;
    const GLuint program = create_program(own, discs, error);
    if (!program)
        return false;
    glDeleteProgram(own->program);
    own->program = program;
    own->discs = discs;
    return true;
}

static void begin(const ByPoints *own, const VoxelizeJob *job)
{
    glBindFramebuffer(GL_FRAMEBUFFER, own->framebuffer);
    glViewport(0, 0, job->volume->grid.size[0], job->volume->grid.size[1]);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(own->program);
    particle_bind(own->program, job->particles, job->carried);
    glBindVertexArray(own->vertex_array);
}

static bool points_run(void *state, const VoxelizeJob *job, Error *error)
{
    ByPoints *own = state;
    const GLuint volume[2] = {job->volume->field, job->volume->scalar};
    const bool planes = own->method == VOLUME_PLANES;
    if (!follow_discs(own, job->radius, error) || (planes && !follow_packed(own, &job->volume->grid, error)))
        return false;
    clear(own, planes ? own->packed : volume);
    begin(own, job);
    if (slices_a_pass(own))
        draw_passes(own, planes ? own->packed : volume, job);
    else
        draw(job, own->method == VOLUME_LAYERS ? (GLsizei)ceil(2 * job->radius) + 1 : 1);
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, 0); /* readers of the volume must not find the texture attached */
    if (planes)
        unpack(own, volume, job->volume->grid.size);
    return true;
}

const VoxelizeMethod voxelize_points = {
    .create = points_create,
    .destroy = points_destroy,
    .fits = points_fit,
    .reserve = points_reserve,
    .run = points_run,
};
