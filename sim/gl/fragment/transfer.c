/* Between the textures and the plain arrays of sim/gl/transfer.h. */
#include "sim/gl/transfer.h"
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

/* All of a texture, into memory here. */
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

static bool download(const Fragment *f, Transfer *to)
{
    const size_t bytes = texture_bytes(f);
    float *all = malloc(bytes);
    if (!all || !transfer_make(to, f->count)) {
        free(all);
        return false;
    }
    texels_read(f->velocity[0], GL_RGBA, GL_FLOAT, bytes, all);
    memcpy(to->velocity, all, 16 * f->count);
    texels_read(f->position[0], GL_RGBA, GL_FLOAT, bytes, all);
    memcpy(to->position, all, 16 * f->count);
    texels_read(f->fields, GL_RGBA, GL_FLOAT, bytes, all);
    for (size_t i = 0; i < f->count; i++) {
        to->name[2 * i] = (uint32_t)i;
        to->name[2 * i + 1] = (uint32_t)to->position[4 * i + 3];
        to->position[4 * i + 3] = all[4 * i];
        to->pressure[2 * i] = all[4 * i + 1];
        to->pressure[2 * i + 1] = all[4 * i + 1] * all[4 * i] * all[4 * i];
    }
    free(all);
    return true;
}

static void texels_write(const Fragment *f, unsigned texture, const float *all)
{
    GLint unpack;
    glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glTextureSubImage2D(texture, 0, 0, 0, f->width, f->height, GL_RGBA, GL_FLOAT, all);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)unpack);
}

/* Each particle into the texel of its id, so that what follows does not depend on the order it came in. */
static bool upload(const Fragment *f, const Transfer *from)
{
    float *position = calloc(1, texture_bytes(f)), *velocity = calloc(1, texture_bytes(f));
    const bool enough = position && velocity;
    for (size_t i = 0; enough && i < f->count; i++) {
        const size_t id = from->name[2 * i];
        memcpy(position + 4 * id, from->position + 4 * i, 12);
        memcpy(velocity + 4 * id, from->velocity + 4 * i, 12);
        position[4 * id + 3] = (float)from->name[2 * i + 1];
    }
    if (enough) {
        texels_write(f, f->position[0], position);
        texels_write(f, f->velocity[0], velocity);
    }
    free(position);
    free(velocity);
    return enough;
}

bool fragment_set_particles(Fragment *f, const InitialState *initial)
{
    Transfer copy;
    if (!transfer_make(&copy, f->count))
        return false;
    transfer_set_initial(&copy, f->constants, initial);
    const bool done = upload(f, &copy);
    transfer_free(&copy);
    return done;
}

bool fragment_save(void *state, const ParticleColumns *to)
{
    const Fragment *f = state;
    Transfer copy;
    if (!download(f, &copy))
        return false;
    transfer_get_columns(&copy, f->constants, to);
    transfer_free(&copy);
    return true;
}

bool fragment_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Fragment *f = state;
    Transfer copy;
    if (count != f->count || !transfer_make(&copy, count))
        return false;
    transfer_set_columns(&copy, f->constants, from);
    const bool loaded = upload(f, &copy);
    transfer_free(&copy);
    if (loaded)
        fragment_watch_reset(f, guarded);
    return loaded;
}

bool fragment_read(void *state, const ParticleArrays *out)
{
    const Fragment *f = state;
    Transfer copy;
    if (!download(f, &copy))
        return false;
    transfer_get_arrays(&copy, f->constants, out);
    transfer_free(&copy);
    return true;
}

uint32_t *fragment_buckets_read(const Fragment *f)
{
    const size_t bytes = 16 * (size_t)f->bucket_width * (size_t)f->bucket_height * (size_t)f->layers;
    uint32_t *places = bytes <= INT32_MAX ? malloc(bytes) : NULL; /* more, a single read cannot bring */
    if (places)
        texels_read(f->buckets, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bytes, places);
    return places;
}

uint32_t fragment_bucket_at(const Fragment *f, const uint32_t *places, size_t cell, int place)
{
    const size_t layer = (size_t)f->bucket_width * (size_t)f->bucket_height, above = (size_t)place / 4;
    for (size_t below = 0; below < above; below++) /* what is above a layer that is not full is of old */
        if (places[4 * (below * layer + cell) + 3] == 0)
            return 0;
    return places[4 * (above * layer + cell) + (size_t)place % 4];
}

/* Others with r < h of particle i, in three cells. */
static size_t neighbours_in_row(const Fragment *f, const Transfer *copy, const uint32_t *places, size_t first,
                                size_t i)
{
    const float *x = copy->position + 4 * i, h2 = f->constants->support_radius * f->constants->support_radius;
    size_t count = 0;
    for (size_t cell = first; cell < first + 3; cell++)
        for (int place = 0; place < 4 * f->layers; place++) {
            const uint32_t number = fragment_bucket_at(f, places, cell, place);
            if (number == 0)
                break;
            const float *y = copy->position + 4 * ((size_t)number - 1);
            const float dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
            count += number - 1 != i && dx * dx + dy * dy + dz * dz < h2;
        }
    return count;
}

static size_t neighbours_of_cell(const Fragment *f, const Transfer *copy, const uint32_t *places, size_t cell)
{
    const int *size = f->constants->cells.size;
    size_t sum = 0;
    for (int place = 0; place < 4 * f->layers; place++) {
        const uint32_t number = fragment_bucket_at(f, places, cell, place);
        if (number == 0)
            break;
        for (int row = f->constants->first_row; row < f->constants->last_row; row++) {
            const long to = ((long)(row / 3 - 1) * size[1] + (row % 3 - 1)) * size[0] - 1;
            sum += neighbours_in_row(f, copy, places, (size_t)((long)cell + to), number - 1);
        }
    }
    return sum;
}

/* Of those that the buckets show: a particle without a place has no neighbours, and is nobody's. */
static double neighbours_mean(const Fragment *f, const Transfer *copy)
{
    uint32_t *places = fragment_buckets_read(f);
    size_t sum = 0;
    for (size_t cell = 0; places && cell < f->constants->cells.count; cell++)
        sum += neighbours_of_cell(f, copy, places, cell);
    free(places);
    return f->count > 0 ? (double)sum / (double)f->count : 0;
}

void fragment_sums(void *state, WorldSums *sums)
{
    const Fragment *f = state;
    Transfer copy;
    *sums = (WorldSums){0};
    if (!download(f, &copy))
        return;
    transfer_get_sums(&copy, f->constants, sums);
    sums->neighbours_mean = neighbours_mean(f, &copy);
    transfer_free(&copy);
}

void fragment_info(const void *state, WorldInfo *info)
{
    const Fragment *f = state;
    info->threads = 0;
    info->state_bytes = f->bytes;
    info->guarded = f->guarded_before + f->guarded;
    info->lost = f->lost;
}
