#include "render/particles/particles.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

void slots_create(Slots *slots)
{
    *slots = (Slots){.written = SLOT_NONE, .newest = SLOT_NONE, .drawn = SLOT_NONE, .in_flight = SLOT_NONE};
    pthread_mutex_init(&slots->lock, NULL);
}

void slots_destroy(Slots *slots)
{
    pthread_mutex_destroy(&slots->lock);
}

int slots_write_begin(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    int slot = 0;
    while (slot == slots->newest || slot == slots->drawn || slot == slots->in_flight)
        slot++;
    slots->written = slot;
    pthread_mutex_unlock(&slots->lock);
    return slot;
}

void slots_write_end(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    slots->newest = slots->written;
    slots->written = SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
}

bool slots_have_new(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    const bool fresh = slots->newest != SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
    return fresh;
}

int slots_draw(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    if (slots->newest != SLOT_NONE) {
        slots->in_flight = slots->drawn;
        slots->drawn = slots->newest;
        slots->newest = SLOT_NONE;
    }
    const int drawn = slots->drawn;
    pthread_mutex_unlock(&slots->lock);
    return drawn;
}

void slots_release_in_flight(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    slots->in_flight = SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
}

typedef struct Slot {
    GLuint buffer;
    char *bytes;           /* mapped for the buffer's whole life */
    ParticleBuffers state; /* state in the slot */
    Births births;         /* birth times, of a world */
} Slot;

/* Offsets in each slot, bytes; SIZE_MAX: the attribute is not carried. */
typedef struct SlotLayout {
    size_t position, velocity, fluid, id, scalar[SCALAR_STATE_COUNT];
    size_t size;
} SlotLayout;

struct Upload {
    size_t capacity;
    unsigned attributes;
    SlotLayout layout;
    Slots turn;
    GLsync fence; /* after the last drawing from the slot in flight, or NULL */
    int drawn;    /* slot, or SLOT_NONE; used by the drawing thread only */
    Slot slots[SLOTS];
    GLuint device; /* copy of the drawn slot in GPU memory; 0: draw from the slot */
    ParticleBuffers drawn_state;
};

static size_t place(SlotLayout *layout, size_t capacity, size_t stride, bool wanted)
{
    enum { ALIGNMENT = 256 }; /* largest alignment of storage-buffer ranges that the GL standard allows */
    if (!wanted)
        return SIZE_MAX;
    size_t offset = layout->size;
    layout->size += (capacity * stride + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    return offset;
}

static SlotLayout make_layout(size_t capacity, unsigned attributes)
{
    SlotLayout layout = {0};
    layout.position = place(&layout, capacity, 4 * sizeof(float), true);
    layout.velocity = place(&layout, capacity, 4 * sizeof(float), attributes & PARTICLE_VELOCITY);
    layout.fluid = place(&layout, capacity, sizeof(uint32_t), attributes & PARTICLE_FLUID);
    layout.id = place(&layout, capacity, sizeof(uint32_t), attributes & PARTICLE_ID);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        layout.scalar[s] = place(&layout, capacity, sizeof(float), attributes & PARTICLE_SCALAR(s));
    return layout;
}

static bool slot_create(Slot *slot, size_t size)
{
    const GLbitfield access = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glCreateBuffers(1, &slot->buffer);
    glObjectLabel(GL_BUFFER, slot->buffer, -1, "particles");
    glNamedBufferStorage(slot->buffer, (GLsizeiptr)size, NULL, access | GL_CLIENT_STORAGE_BIT);
    slot->bytes = glMapNamedBufferRange(slot->buffer, 0, (GLsizeiptr)size, access);
    return slot->bytes != NULL;
}

unsigned upload_attributes(unsigned attributes)
{
    return attributes & ~PARTICLE_SCALAR(SCALAR_BORN);
}

Upload *upload_create(size_t capacity, unsigned attributes, Error *error)
{
    Upload *upload = calloc(1, sizeof *upload);
    if (!upload) {
        error_set(error, "out of memory for the upload");
        return NULL;
    }
    upload->capacity = capacity ? capacity : 1;
    upload->attributes = attributes;
    upload->layout = make_layout(upload->capacity, attributes);
    upload->drawn = SLOT_NONE;
    slots_create(&upload->turn);
    for (int i = 0; i < SLOTS; i++)
        if (!slot_create(&upload->slots[i], upload->layout.size)) {
            error_set(error, "the GPU has no %zu bytes for four states of %zu particles; use fewer particles",
                      SLOTS * upload->layout.size, capacity);
            upload_destroy(upload);
            return NULL;
        }
    if (!upload_set_copies(upload, !gl_renderer_is_software(), error)) {
        upload_destroy(upload);
        return NULL;
    }
    return upload;
}

bool upload_set_copies(Upload *upload, bool copies, Error *error)
{
    glDeleteBuffers(1, &upload->device);
    upload->device = 0;
    if (!copies)
        return true;
    gl_debug_errors(); /* drops earlier errors: the query below is for this buffer */
    glCreateBuffers(1, &upload->device);
    glObjectLabel(GL_BUFFER, upload->device, -1, "drawn particles");
    glNamedBufferStorage(upload->device, (GLsizeiptr)upload->layout.size, NULL, 0);
    return gl_errors_take(GL_OUT_OF_MEMORY) == 0 ||
           error_set(error, "the GPU has no %zu bytes for %zu particles; use fewer particles",
                     upload->layout.size, upload->capacity);
}

void upload_destroy(Upload *upload)
{
    if (!upload)
        return;
    glDeleteSync(upload->fence);
    glDeleteBuffers(1, &upload->device);
    for (int i = 0; i < SLOTS; i++) {
        glDeleteBuffers(1, &upload->slots[i].buffer);
        births_free(&upload->slots[i].births);
    }
    slots_destroy(&upload->turn);
    free(upload);
}

static void *in_slot(const Slot *slot, size_t offset)
{
    return offset == SIZE_MAX ? NULL : slot->bytes + offset;
}

static ParticleArrays slot_arrays(const Upload *upload, const Slot *slot)
{
    const SlotLayout *layout = &upload->layout;
    ParticleArrays arrays = {.position = in_slot(slot, layout->position),
                             .velocity = in_slot(slot, layout->velocity),
                             .fluid = in_slot(slot, layout->fluid),
                             .id = in_slot(slot, layout->id)};
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        arrays.scalar[s] = in_slot(slot, layout->scalar[s]);
    return arrays;
}

static ParticleAttribute attribute(const Slot *slot, size_t offset, size_t stride)
{
    return offset == SIZE_MAX ? (ParticleAttribute){0} : (ParticleAttribute){slot->buffer, offset, stride};
}

static void describe(const Upload *upload, Slot *slot)
{
    ParticleBuffers *out = &slot->state;
    const SlotLayout *layout = &upload->layout;
    memset(out->scalar, 0, sizeof out->scalar);
    memset(out->vector, 0, sizeof out->vector);
    memset(out->range, 0, sizeof out->range);
    out->position = attribute(slot, layout->position, 4 * sizeof(float));
    out->velocity = attribute(slot, layout->velocity, 4 * sizeof(float));
    out->fluid = attribute(slot, layout->fluid, sizeof(uint32_t));
    out->id = attribute(slot, layout->id, sizeof(uint32_t));
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        out->scalar[s] = attribute(slot, layout->scalar[s], sizeof(float));
}

static bool fits(const Upload *upload, size_t count, Error *error)
{
    return count <= upload->capacity ||
           error_set(error, "%zu particles do not fit the upload, which was made for %zu", count,
                     upload->capacity);
}

bool upload_write(Upload *upload, World *world, Error *error)
{
    WorldInfo info;
    world_info(world, &info);
    if (!fits(upload, info.count, error))
        return false;
    Slot *slot = &upload->slots[slots_write_begin(&upload->turn)];
    ParticleArrays arrays = slot_arrays(upload, slot);
    arrays.scalar[SCALAR_BORN] = NULL; /* births come by id */
    if (!world_read(world, &arrays) || !world_births(world, &slot->births))
        return error_set(error, "no memory to read %zu particles", info.count);
    ParticleBuffers *out = &slot->state;
    particle_buffers_describe(&info, out);
    describe(upload, slot);
    out->scalar[SCALAR_BORN] = (ParticleAttribute){0};
    out->births = &slot->births;
    slots_write_end(&upload->turn);
    return true;
}

static void copy(void *to, const void *from, size_t bytes)
{
    if (to && from && bytes)
        memcpy(to, from, bytes);
}

bool upload_write_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state,
                         Error *error)
{
    if (!fits(upload, state->count, error))
        return false;
    Slot *slot = &upload->slots[slots_write_begin(&upload->turn)];
    ParticleArrays to = slot_arrays(upload, slot);
    size_t count = state->count;
    copy(to.position, arrays->position, 4 * count * sizeof(float));
    copy(to.velocity, arrays->velocity, 4 * count * sizeof(float));
    copy(to.fluid, arrays->fluid, count * sizeof(uint32_t));
    copy(to.id, arrays->id, count * sizeof(uint32_t));
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        copy(to.scalar[s], arrays->scalar[s], count * sizeof(float));
    slot->state = *state;
    describe(upload, slot);
    slots_write_end(&upload->turn);
    return true;
}

bool upload_has_new(Upload *upload)
{
    return slots_have_new(&upload->turn);
}

static void land(Upload *upload)
{
    if (!upload->fence)
        return;
    while (glClientWaitSync(upload->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 1000000000) == GL_TIMEOUT_EXPIRED)
        continue;
    glDeleteSync(upload->fence);
    upload->fence = NULL;
    slots_release_in_flight(&upload->turn);
}

static void carry(const Upload *upload, ParticleAttribute *attribute, size_t count)
{
    if (!attribute->buffer)
        return;
    glCopyNamedBufferSubData(attribute->buffer, upload->device, (GLintptr)attribute->offset,
                             (GLintptr)attribute->offset, (GLsizeiptr)(count * attribute->stride));
    attribute->buffer = upload->device;
}

/* One buffer is enough: GL runs copies and draws in order. */
static void carry_over(Upload *upload)
{
    ParticleBuffers *state = &upload->drawn_state;
    *state = upload->slots[upload->drawn].state;
    if (!upload->device)
        return;
    carry(upload, &state->position, state->count);
    carry(upload, &state->velocity, state->count);
    carry(upload, &state->fluid, state->count);
    carry(upload, &state->id, state->count);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        carry(upload, &state->scalar[s], state->count);
}

bool upload_take(Upload *upload, ParticleBuffers *out)
{
    if (slots_have_new(&upload->turn)) {
        land(upload);
        if (upload->drawn != SLOT_NONE)
            upload->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        upload->drawn = slots_draw(&upload->turn);
        carry_over(upload);
    }
    if (upload->drawn == SLOT_NONE)
        return false;
    *out = upload->drawn_state;
    return true;
}
