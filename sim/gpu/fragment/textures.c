/* Textures and framebuffers of the backend. */
#include "sim/gpu/fragment/fragment.h"

#include "sim/gpu/gl.h"
#include "sim/gpu/packing.h"
#include "sim/step/backend.h"

#include <epoxy/gl.h>
#include <stdlib.h>
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
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT); /* as in compute_buffer */
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
    for (int i = 0; i < f->framebuffer_count; i++)
        glDeleteFramebuffers(1, &f->framebuffers[i].name);
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

/* The particles' columns in textures: layout and transfer both ways. */

enum { POSITION = 1, VELOCITY, FIELDS, TEXTURES };

#define AT(member) offsetof(ParticleColumns, member)

static const ColumnPacking packing = {.words = {[POSITION] = 4, [VELOCITY] = 4, [FIELDS] = 4},
                                      .column = {
                                          {POSITION, 0, AT(x), COLUMN_FLOAT},
                                          {POSITION, 3, AT(id), COLUMN_FLOAT},
                                          {VELOCITY, 0, AT(vx), COLUMN_FLOAT},
                                          {VELOCITY, 3, AT(fluid), COLUMN_FLOAT},
                                          {FIELDS, 0, AT(volume), COLUMN_FLOAT},
                                          {FIELDS, 1, AT(pressure), COLUMN_FLOAT},
                                      }};

static unsigned texture_of(const Fragment *f, int texture)
{
    return texture == POSITION ? f->position[0] : texture == VELOCITY ? f->velocity[0] : f->fields;
}

/* Reads a whole texture into memory. */
static void texels_read(unsigned texture, GLenum format, GLenum type, size_t bytes, void *out)
{
    GLint pack;
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glGetTextureImage(texture, 0, format, type, (GLsizei)bytes, out);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)pack);
}

static size_t texture_bytes(const Fragment *f)
{
    return 16 * (size_t)f->width * (size_t)f->height;
}

/* The id of each texel's particle, freed by the caller; NULL if memory is short. A lost context gives
   arbitrary values: invalid ids become the texel's index, to keep array accesses in bounds. */
static uint32_t *ids_read(const Fragment *f)
{
    float *texels = calloc(1, texture_bytes(f));
    uint32_t *id = texels ? malloc(sizeof *id * (f->count + 1)) : NULL;
    if (id)
        texels_read(f->position[0], GL_RGBA, GL_FLOAT, texture_bytes(f), texels);
    for (size_t i = 0; id && i < f->count; i++) {
        const float said = texels[4 * i + 3];
        id[i] = said >= 0 && said < (float)f->count ? (uint32_t)said : (uint32_t)i;
    }
    free(texels);
    return id;
}

/* Reads a texture's texels in the order of ids to `out`. */
static void texels_by_id(const Fragment *f, int texture, const uint32_t *id, uint32_t *texels, uint32_t *out)
{
    texels_read(texture_of(f, texture), GL_RGBA, GL_FLOAT, texture_bytes(f), texels);
    for (size_t i = 0; i < f->count; i++)
        memcpy(out + 4 * (size_t)id[i], texels + 4 * i, 16);
}

/* Downloads columns in the order of ids, for any order of texels; free with columns_destroy. False if
   memory is short. */
static bool download(const Fragment *f, ParticleColumns *columns)
{
    const Method *method = f->constants->method;
    const ColumnRows rows = packing_rows(&packing, method);
    uint32_t *texels = malloc(texture_bytes(f)), *sorted = malloc(texture_bytes(f)), *id = ids_read(f);
    *columns = (ParticleColumns){0};
    const bool done = texels && sorted && id && columns_create(columns, &rows, f->count, NULL);
    for (int t = POSITION; done && t < TEXTURES; t++) {
        texels_by_id(f, t, id, texels, sorted);
        packing_unpack(&packing, t, method, sorted, 0, f->count, columns);
    }
    if (!done)
        columns_destroy(columns);
    free(texels);
    free(sorted);
    free(id);
    return done;
}

static void texels_write(const Fragment *f, unsigned texture, const uint32_t *texels)
{
    GLint unpack;
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glTextureSubImage2D(texture, 0, 0, 0, f->width, f->height, GL_RGBA, GL_FLOAT, texels);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)unpack);
}

/* Writes each particle to the texel of its id, so that the result is independent of the input order. */
static bool upload(Fragment *f, const ParticleColumns *from)
{
    uint32_t *texels = malloc(texture_bytes(f));
    for (int t = POSITION; texels && t < FIELDS; t++) {
        memset(texels, 0, texture_bytes(f));
        packing_pack(&packing, t, f->constants->method, from, f->count, from->id, texels);
        texels_write(f, texture_of(f, t), texels);
    }
    if (texels)
        fragment_number(f);
    free(texels);
    return texels != NULL;
}

bool fragment_set_particles(Fragment *f, const InitialState *initial)
{
    const ColumnRows saved = column_rows(f->constants->method->columns, COLUMN_SAVED, f->constants);
    ParticleColumns columns = {0};
    bool done = columns_create(&columns, &saved, f->count, NULL);
    if (done) {
        particles_set(&columns, f->constants, initial);
        done = upload(f, &columns);
    }
    columns_destroy(&columns);
    return done;
}

bool fragment_save(void *state, const ParticleColumns *to)
{
    const Fragment *f = state;
    const ColumnRows saved = column_rows(f->constants->method->columns, COLUMN_SAVED, f->constants);
    ParticleColumns copy;
    if (!download(f, &copy))
        return false;
    columns_copy(&saved, &copy, to, NULL, 0, f->count);
    for (int k = COLUMNS_LEFT; k < COLUMNS_SHOWN; k++) /* the backend keeps no remainders */
        if (to->own[k])
            memset(to->own[k], 0, f->count * sizeof(float));
    columns_destroy(&copy);
    return true;
}

bool fragment_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Fragment *f = state;
    const bool loaded = count == f->count && upload(f, from);
    if (loaded)
        fragment_watch_reset(f, guarded);
    return loaded;
}

bool fragment_read(void *state, const ParticleArrays *out)
{
    const Fragment *f = state;
    ParticleColumns copy;
    if (!download(f, &copy))
        return false;
    particles_read(&copy, f->constants, NULL, 0, f->count, out);
    columns_destroy(&copy);
    return true;
}

uint32_t *fragment_buckets_read(const Fragment *f)
{
    const size_t bytes = 16 * (size_t)f->bucket_width * (size_t)f->bucket_height * (size_t)f->layers;
    uint32_t *places = bytes <= INT32_MAX ? malloc(bytes) : NULL; /* limit of a single read */
    uint32_t *id = places ? ids_read(f) : NULL;
    if (id)
        texels_read(f->buckets, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bytes, places);
    for (size_t k = 0; id && k < bytes / sizeof *places; k++)
        if (places[k] > 0 && places[k] <= f->count)
            places[k] = id[places[k] - 1] + 1;
    if (!id) {
        free(places);
        return NULL;
    }
    free(id);
    return places;
}

uint32_t fragment_bucket_at(const Fragment *f, const uint32_t *places, size_t cell, int place)
{
    const size_t layer = (size_t)f->bucket_width * (size_t)f->bucket_height;
    return places[4 * ((size_t)place / 4 * layer + cell) + (size_t)place % 4];
}

/* Number of neighbours of particle i with r < h in three cells. */
static size_t neighbours_in_row(const Fragment *f, const ParticleColumns *p, const uint32_t *places,
                                size_t first, size_t i)
{
    const float h2 = f->constants->support_radius * f->constants->support_radius;
    size_t count = 0;
    for (size_t cell = first; cell < first + 3; cell++)
        for (int place = 0; place < 4 * f->layers; place++) {
            const uint32_t number = fragment_bucket_at(f, places, cell, place);
            if (number == 0)
                break;
            const size_t j = (size_t)number - 1;
            const float dx = p->x[i] - p->x[j], dy = p->y[i] - p->y[j], dz = p->z[i] - p->z[j];
            count += j != i && dx * dx + dy * dy + dz * dz < h2;
        }
    return count;
}

static size_t neighbours_of_cell(const Fragment *f, const ParticleColumns *p, const uint32_t *places,
                                 size_t cell)
{
    const int *size = f->constants->cells.size;
    size_t sum = 0;
    for (int place = 0; place < 4 * f->layers; place++) {
        const uint32_t number = fragment_bucket_at(f, places, cell, place);
        if (number == 0)
            break;
        for (int row = f->constants->first_row; row < f->constants->last_row; row++) {
            const long to = ((long)(row / 3 - 1) * size[1] + (row % 3 - 1)) * size[0] - 1;
            sum += neighbours_in_row(f, p, places, (size_t)((long)cell + to), number - 1);
        }
    }
    return sum;
}

/* Counts particles in the buckets: a particle without a place has no neighbours and is no neighbour. */
static double neighbours_mean(const Fragment *f, const ParticleColumns *p)
{
    uint32_t *places = fragment_buckets_read(f);
    size_t sum = 0;
    for (size_t cell = 0; places && cell < f->constants->cells.count; cell++)
        sum += neighbours_of_cell(f, p, places, cell);
    free(places);
    return f->count > 0 ? (double)sum / (double)f->count : 0;
}

void fragment_sums(void *state, WorldSums *sums)
{
    const Fragment *f = state;
    ParticleColumns copy;
    *sums = (WorldSums){0};
    if (!download(f, &copy))
        return;
    particles_sums(&copy, f->constants, f->count, sums);
    sums->neighbours_mean = neighbours_mean(f, &copy);
    columns_destroy(&copy);
}

void fragment_info(const void *state, WorldInfo *info)
{
    const Fragment *f = state;
    info->threads = 0;
    info->state_bytes = f->bytes;
    info->guarded = f->guarded_before + f->guarded;
    info->lost = f->lost;
}

void fragment_watch_forget(Fragment *f)
{
    glClearTexImage(f->watch[0], 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, NULL);
    f->longest = 0;
}

void fragment_watch_reset(Fragment *f, size_t guarded)
{
    fragment_watch_forget(f);
    mailbox_forget(&f->watched);
    f->watch_due = false;
    f->marks = 0;
    glClearTexImage(f->held[0], 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    f->guarded_before = guarded;
    f->guarded = 0;
}
