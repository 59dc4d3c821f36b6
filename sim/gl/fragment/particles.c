/* The particles' columns in textures: layout and transfer both ways. */
#include "sim/world/particles.h"
#include "sim/gl/fragment/fragment.h"
#include "sim/gl/packing.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { POSITION = 1, VELOCITY, FIELDS, TEXTURES };

#define AT(member) offsetof(ParticleColumns, member)

static const Packing packing = {.words = {[POSITION] = 4, [VELOCITY] = 4, [FIELDS] = 4},
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
        packing_unpack(&packing, t, method, sorted, f->count, columns);
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
