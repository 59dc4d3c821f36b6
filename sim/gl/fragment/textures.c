/* Textures and framebuffers of the backend. */
#include "sim/gl/debug.h"
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>
#include <string.h>

static size_t texel_bytes(GLenum format)
{
    return format == GL_R32UI ? 4 : format == GL_DEPTH32F_STENCIL8 ? 8 : 16;
}

static void clear(unsigned texture, GLenum format)
{
    if (format == GL_RGBA32F)
        glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, NULL);
    else if (format == GL_RGBA32UI)
        glClearTexImage(texture, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, NULL);
    else if (format == GL_R32UI)
        glClearTexImage(texture, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
}

/* Zeroed. */
static unsigned texture(Fragment *f, const char *label, GLenum format, int width, int height)
{
    GLuint name;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glObjectLabel(GL_TEXTURE, name, -1, label);
    glTextureStorage2D(name, 1, format, width, height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    clear(name, format);
    f->bytes += texel_bytes(format) * (size_t)width * (size_t)height;
    return name;
}

static void particles_create(Fragment *f)
{
    for (int k = 0; k < 2; k++) {
        f->position[k] = texture(f, "particle positions", GL_RGBA32F, f->width, f->height);
        f->velocity[k] = texture(f, "particle velocities", GL_RGBA32F, f->width, f->height);
        f->held[k] = texture(f, "times held by the guard", GL_R32UI, f->width, f->height);
    }
    f->fields = texture(f, "particle volumes and pressures", GL_RGBA32F, f->width, f->height);
    f->near = texture(f, "particle positions and pressure terms", GL_RGBA32F, f->width, f->height);
    f->acceleration = texture(f, "particle accelerations", GL_RGBA32F, f->width, f->height);
}

/* A framebuffer per layer; all share the depths. */
static void buckets_create(Fragment *f)
{
    const size_t texels = (size_t)f->bucket_width * (size_t)f->bucket_height;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &f->buckets);
    glObjectLabel(GL_TEXTURE, f->buckets, -1, "buckets");
    glTextureStorage3D(f->buckets, 1, GL_RGBA32UI, f->bucket_width, f->bucket_height, f->layers);
    glTextureParameteri(f->buckets, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(f->buckets, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    f->bytes += 16 * texels * (size_t)f->layers;
    f->bucket_depth = texture(f, "bucket depths", GL_DEPTH32F_STENCIL8, f->bucket_width, f->bucket_height);
    glCreateQueries(GL_ANY_SAMPLES_PASSED, f->layers, f->full);
    glCreateFramebuffers(f->layers, f->bucket_framebuffer);
    for (int layer = 0; layer < f->layers; layer++) {
        const GLuint framebuffer = f->bucket_framebuffer[layer];
        glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, "a layer of the buckets");
        glNamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT0, f->buckets, 0, layer);
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, f->bucket_depth, 0);
    }
}

/* Lists of indices for all particles; the first also has room for surplus texels of a texture. */
static void lists_create(Fragment *f)
{
    const size_t bytes = 4 * (size_t)f->width * ((size_t)f->height + 1);
    glCreateBuffers(3, f->listed);
    glCreateVertexArrays(3, f->lists);
    glCreateTransformFeedbacks(2, f->feedback);
    for (int k = 0; k < 3; k++) {
        glNamedBufferStorage(f->listed[k], (GLsizeiptr)bytes, NULL, 0);
        glObjectLabel(GL_BUFFER, f->listed[k], -1, "listed particles");
        glVertexArrayVertexBuffer(f->lists[k], 0, f->listed[k], 0, 4);
        glEnableVertexArrayAttrib(f->lists[k], 0);
        glVertexArrayAttribIFormat(f->lists[k], 0, 1, GL_UNSIGNED_INT, 0);
        glVertexArrayAttribBinding(f->lists[k], 0, 0);
    }
    for (int k = 0; k < 2; k++)
        glTransformFeedbackBufferBase(f->feedback[k], 0, f->listed[1 + k]);
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &f->by_cell);
    glObjectLabel(GL_TEXTURE, f->by_cell, -1, "particles by cell");
    glTextureBuffer(f->by_cell, GL_R32UI, f->listed[1]);
    glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &f->written);
    f->bytes += 3 * bytes;
}

static bool watch_create(Fragment *f)
{
    int width = f->width, height = f->height;
    do {
        int *size = f->level_size[f->levels];
        size[0] = width = (width + 7) / 8;
        size[1] = height = (height + 7) / 8;
        f->found[f->levels] = texture(f, "what was found", GL_RGBA32UI, width, height);
        f->held_sum[f->levels++] = texture(f, "how many were held", GL_R32UI, width, height);
    } while (width > 1 || height > 1);
    for (int k = 0; k < 2; k++)
        f->watch[k] = texture(f, "watch", GL_RGBA32UI, 2, 1);
    return mailbox_create(&f->watched, "watch", 8 * sizeof(uint32_t));
}

static bool memory_sufficed(const Fragment *f, bool enough, Error *error)
{
    enough &= gl_errors_take(GL_OUT_OF_MEMORY) == 0;
    return enough || error_set(error,
                               "the GPU has no memory for %zu particles and %zu cells of %d layers; use a "
                               "larger spacing",
                               f->count, f->constants->cells.count, f->layers);
}

bool fragment_textures_create(Fragment *f, Error *error)
{
    particles_create(f);
    buckets_create(f);
    const bool enough = watch_create(f);
    lists_create(f);
    glCreateFramebuffers(1, &f->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, f->framebuffer, -1, "solver passes");
    glCreateVertexArrays(1, &f->vertex_array);
    return memory_sufficed(f, enough, error) && fragment_terms_create(f, error);
}

/* Deletes textures without memory, so that their names are not used; false. */
static bool drop(unsigned *textures, int count)
{
    glDeleteTextures(count, textures);
    memset(textures, 0, (size_t)count * sizeof *textures);
    return false;
}

bool fragment_marked_create(Fragment *f, Error *error)
{
    f->marked[0] = texture(f, "kept particle positions", GL_RGBA32F, f->width, f->height);
    f->marked[1] = texture(f, "kept particle velocities", GL_RGBA32F, f->width, f->height);
    return memory_sufficed(f, true, error) || drop(f->marked, 2);
}

bool fragment_terms_create(Fragment *f, Error *error)
{
    if (!f->constants->viscous || f->moving)
        return memory_sufficed(f, true, error);
    f->moving = texture(f, "particle velocities and volumes", GL_RGBA32F, f->width, f->height);
    return memory_sufficed(f, true, error) || drop(&f->moving, 1);
}

void fragment_shown_create(Fragment *f)
{
    if (f->placed)
        return;
    f->placed = texture(f, "shown positions", GL_RGBA32F, f->width, f->height);
    f->word = texture(f, "shown scalar", GL_R32UI, f->width, f->height);
}

void fragment_textures_destroy(Fragment *f)
{
    const GLuint textures[] = {f->position[0], f->position[1], f->velocity[0],  f->velocity[1],  f->held[0],
                               f->held[1],     f->fields,      f->acceleration, f->buckets,      f->watch[0],
                               f->watch[1],    f->marked[0],   f->marked[1],    f->bucket_depth, f->placed,
                               f->word,        f->near,        f->moving,       f->by_cell};
    const GLuint buffers[] = {f->shown_position, f->shown_velocity};
    glDeleteFramebuffers(f->layers, f->bucket_framebuffer);
    glDeleteFramebuffers(1, &f->framebuffer);
    glDeleteTextures(sizeof textures / sizeof *textures, textures);
    glDeleteTextures(f->levels, f->found);
    glDeleteTextures(f->levels, f->held_sum);
    glDeleteQueries(f->layers, f->full);
    glDeleteQueries(1, &f->written);
    glDeleteVertexArrays(1, &f->vertex_array);
    glDeleteVertexArrays(3, f->lists);
    glDeleteTransformFeedbacks(2, f->feedback);
    glDeleteBuffers(3, f->listed);
    glDeleteBuffers(sizeof buffers / sizeof *buffers, buffers);
    glDeleteBuffers(sizeof f->shown / sizeof *f->shown, f->shown);
    mailbox_destroy(&f->watched);
    mailbox_destroy(&f->gauge);
    mailbox_destroy(&f->energy);
}
