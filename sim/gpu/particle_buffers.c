#include "sim/gpu/particle_buffers.h"

#include "sim/gpu/gl.h"
#include "sim/gpu/packing.h"
#include "sim/step/method.h"
#include "sim/step/world.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { UNIT = 32 }; /* some drivers round uniform blocks up to as many bytes */

static GLuint labelled(const char *label)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, label);
    return buffer;
}

bool mailbox_create_copy(Mailbox *mailbox, const char *label, size_t bytes)
{
    const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    mailbox->bytes = (bytes + UNIT - 1) / UNIT * UNIT;
    mailbox->copy = labelled(label);
    glNamedBufferStorage(mailbox->copy, (GLsizeiptr)mailbox->bytes, NULL, access | GL_CLIENT_STORAGE_BIT);
    const bool none = gl_errors_take(GL_OUT_OF_MEMORY) > 0;
    if (!none)
        mailbox->mapped = glMapNamedBufferRange(mailbox->copy, 0, (GLsizeiptr)mailbox->bytes, access);
    return mailbox->mapped != NULL;
}

bool mailbox_create(Mailbox *mailbox, const char *label, size_t bytes)
{
    const size_t rounded = (bytes + UNIT - 1) / UNIT * UNIT;
    void *zeros = calloc(1, rounded);
    mailbox->buffer = labelled(label);
    glNamedBufferStorage(mailbox->buffer, (GLsizeiptr)rounded, zeros, GL_DYNAMIC_STORAGE_BIT);
    free(zeros);
    return mailbox_create_copy(mailbox, label, rounded);
}

void mailbox_destroy(Mailbox *mailbox)
{
    mailbox_forget(mailbox);
    glDeleteBuffers(1, &mailbox->buffer);
    glDeleteBuffers(1, &mailbox->copy);
    *mailbox = (Mailbox){0};
}

void mailbox_send(Mailbox *mailbox)
{
    mailbox_forget(mailbox);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(mailbox->buffer, mailbox->copy, 0, 0, (GLsizeiptr)mailbox->bytes);
    mailbox_close(mailbox);
}

void mailbox_close(Mailbox *mailbox)
{
    mailbox->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

/* Opens the mailbox after arrival or failure. */
static const void *open(Mailbox *mailbox, GLenum arrived)
{
    mailbox_forget(mailbox);
    return arrived == GL_WAIT_FAILED ? NULL : mailbox->mapped;
}

const void *mailbox_wait(Mailbox *mailbox)
{
    if (!mailbox->fence)
        return NULL;
    GLenum arrived;
    do
        arrived = glClientWaitSync(mailbox->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000);
    while (arrived == GL_TIMEOUT_EXPIRED);
    return open(mailbox, arrived);
}

const void *mailbox_look(Mailbox *mailbox)
{
    if (!mailbox->fence)
        return NULL;
    const GLenum arrived = glClientWaitSync(mailbox->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    return arrived == GL_TIMEOUT_EXPIRED ? NULL : open(mailbox, arrived);
}

void mailbox_forget(Mailbox *mailbox)
{
    glDeleteSync(mailbox->fence);
    mailbox->fence = NULL;
}

void particle_buffers_describe(const WorldInfo *info, ParticleBuffers *out)
{
    *out = (ParticleBuffers){.count = info->count,
                             .spacing = info->spacing,
                             .support_radius = info->support_radius,
                             .box = info->box,
                             .time = info->time,
                             .step = info->step};
    memcpy(out->floating, info->floating, sizeof out->floating);
    memcpy(out->box_size, info->box_size, sizeof out->box_size);
    memcpy(out->gravity, info->gravity, sizeof out->gravity);
}

bool world_shares(const World *world)
{
    return world->backend->share != NULL;
}

void world_share(World *world, unsigned attributes, ParticleBuffers *out)
{
    WorldInfo info;
    world_info(world, &info);
    particle_buffers_describe(&info, out);
    world->backend->share(world->state, attributes, out);
    out->births = &world->births;
}

bool world_births(const World *world, Births *to)
{
    return births_copy(&world->births, to);
}

static const PackedColumn *packed(const ColumnPacking *packing, const ColumnDef *column)
{
    const PackedColumn *row = packing->column;
    while (row->buffer > 0 && row->at != column->at)
        row++;
    return row->buffer > 0 ? row : NULL;
}

ColumnRows packing_rows(const ColumnPacking *packing, const Method *method)
{
    const ColumnRows all = column_rows(method->columns, 0, NULL);
    ColumnRows rows = {0};
    for (int r = 0; r < all.count; r++)
        if (packed(packing, all.row[r]))
            rows.row[rows.count++] = all.row[r];
    return rows;
}

static uint32_t word_of(const void *array, ColumnType here, ColumnType there, size_t i)
{
    uint32_t word;
    if (here == COLUMN_BYTE)
        word = ((const uint8_t *)array)[i];
    else if (here == COLUMN_INDEX)
        word = (uint32_t)((const ParticleId *)array)[i]; /* below PARTICLE_IDS_GPU */
    else
        memcpy(&word, (const char *)array + 4 * i, sizeof word);
    if (here != COLUMN_FLOAT && there == COLUMN_FLOAT) {
        const float value = (float)word;
        memcpy(&word, &value, sizeof word);
    }
    return word;
}

static void put_word(uint32_t word, ColumnType there, ColumnType here, void *array, size_t i)
{
    if (here != COLUMN_FLOAT && there == COLUMN_FLOAT) {
        float value;
        memcpy(&value, &word, sizeof word);
        word = (uint32_t)value;
    }
    if (here == COLUMN_BYTE)
        ((uint8_t *)array)[i] = (uint8_t)word;
    else if (here == COLUMN_INDEX)
        ((ParticleId *)array)[i] = word;
    else
        memcpy((char *)array + 4 * i, &word, sizeof word);
}

/* A component of a column in the buffer, for both directions. */
typedef struct PackedPart {
    const PackedColumn *packed;
    ColumnType type;
    void *array;
    int word;
} PackedPart;

/* Lists the components of present columns in `buffer`; returns their number. */
static int parts_of(const ColumnPacking *packing, int buffer, const Method *method, ParticleColumns columns,
                    PackedPart parts[PACKED_WORDS])
{
    const ColumnRows rows = packing_rows(packing, method);
    int count = 0;
    for (int r = 0; r < rows.count; r++) {
        const PackedColumn *row = packed(packing, rows.row[r]);
        for (int k = 0; row->buffer == buffer && k < rows.row[r]->components; k++) {
            void *array = *column_array(&columns, rows.row[r], k);
            if (array)
                parts[count++] = (PackedPart){row, rows.row[r]->type, array, row->word + k};
        }
    }
    return count;
}

bool packing_has(const ColumnPacking *packing, int buffer, const Method *method,
                 const ParticleColumns *columns)
{
    PackedPart part[PACKED_WORDS];
    return parts_of(packing, buffer, method, *columns, part) > 0;
}

void packing_pack(const ColumnPacking *packing, int buffer, const Method *method, const ParticleColumns *from,
                  size_t count, const ParticleId *place, uint32_t *entries)
{
    PackedPart part[PACKED_WORDS];
    const size_t words = (size_t)packing->words[buffer];
    for (int n = parts_of(packing, buffer, method, *from, part); n-- > 0;)
        for (size_t i = 0; i < count; i++)
            entries[words * (place ? place[i] : i) + (size_t)part[n].word] =
                word_of(part[n].array, part[n].type, part[n].packed->type, i);
}

void packing_unpack(const ColumnPacking *packing, int buffer, const Method *method, const uint32_t *entries,
                    size_t begin, size_t end, const ParticleColumns *to)
{
    PackedPart part[PACKED_WORDS];
    const size_t words = (size_t)packing->words[buffer];
    for (int n = parts_of(packing, buffer, method, *to, part); n-- > 0;)
        for (size_t i = begin; i < end; i++)
            put_word(entries[words * i + (size_t)part[n].word], part[n].packed->type, part[n].type,
                     part[n].array, i);
}
