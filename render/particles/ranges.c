#include "render/particles/particles.h"

#include "shaders/derived/derived_bindings.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"

#include <epoxy/gl.h>
#include <stdint.h>

enum { RANKS = 4, BINS = RANKS * 2048, DIGITS = 3 };

/* Block Found of shaders/derived/ranks.glsl. */
typedef struct RangeCounts {
    uint32_t known, found[RANKS], left[RANKS];
} RangeCounts;

static unsigned compile(const char *file, Error *error)
{
    return program_create(file, (const char *const[]){file, NULL}, NULL, error);
}

bool ranges_create(Ranges *ranges, Error *error)
{
    *ranges = (Ranges){.count = compile("derived/ranks_count.comp", error)};
    ranges->find = ranges->count ? compile("derived/ranks_find.comp", error) : 0;
    if (!ranges->find)
        return false;
    work_buffer_remake(&ranges->bins, BINS * sizeof(uint32_t), "rank bins");
    glClearNamedBufferData(ranges->bins, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    return mailbox_create(&ranges->found, "ranks found", sizeof(RangeCounts)) ||
           error_set(error, "the GPU has no memory for the range of a scalar");
}

void ranges_destroy(Ranges *ranges)
{
    glDeleteProgram(ranges->count);
    glDeleteProgram(ranges->find);
    glDeleteBuffers(1, &ranges->bins);
    mailbox_destroy(&ranges->found);
    for (int s = 0; s < SCALAR_COUNT; s++)
        mailbox_destroy(&ranges->late[s].found);
    *ranges = (Ranges){0};
}

static void bind(const Ranges *ranges, const Mailbox *found, const ParticleAttribute *values, size_t count)
{
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, SCALARS_STORAGE, values->buffer, (GLintptr)values->offset,
                      (GLsizeiptr)(count * values->stride));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, RANKS_FOUND_STORAGE, found->buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, RANK_BINS_STORAGE, ranges->bins);
    glProgramUniform1ui(ranges->count, SCALAR_STRIDE_AT, (GLuint)(values->stride / 4));
    glProgramUniform1ui(ranges->count, GRID_PARTICLES_AT, (GLuint)count);
}

static void run_digit(const Ranges *ranges, GLuint digit, size_t count)
{
    glUseProgram(ranges->count);
    glUniform1ui(DIGIT_AT, digit);
    work_run(digit == 0 ? (count + RANKS_A_LANE - 1) / RANKS_A_LANE : count);
    glUseProgram(ranges->find);
    glUniform1ui(DIGIT_AT, digit);
    work_dispatch(1);
}

static void send(const Ranges *ranges, Mailbox *to, const ParticleAttribute *values, size_t count)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    bind(ranges, to, values, count);
    for (GLuint digit = 0; digit < DIGITS; digit++)
        run_digit(ranges, digit, count);
    mailbox_send(to);
}

/* From bits in the order of the numbers: see in_order of ranks_count.comp. */
static double number_of(uint32_t key)
{
    return (double)float_of_bits(key & 0x80000000U ? key & 0x7fffffffU : ~key);
}

/* If 98 of 100 values are equal, the ends are the least and the greatest value. */
static ScalarRange range_of(const RangeCounts *found)
{
    double at[RANKS];
    for (int r = 0; r < RANKS; r++)
        at[r] = number_of(found->found[r]);
    if (at[1] < at[2])
        return (ScalarRange){at[1], at[2], at[0], at[3], true, true};
    return (ScalarRange){at[0], at[3], at[0], at[3], true, true};
}

static const ScalarRange none = {.known = true};

static ScalarRange range_found(const RangeCounts *found)
{
    return found && found->known > 0 ? range_of(found) : none;
}

ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count)
{
    if (count == 0 || !values->buffer)
        return none;
    send(ranges, &ranges->found, values, count);
    return range_found(mailbox_wait(&ranges->found));
}

static bool same(const RangeSource *a, const RangeSource *b)
{
    return a->step == b->step && a->time == b->time && a->count == b->count &&
           a->values.buffer == b->values.buffer && a->values.offset == b->values.offset;
}

/* Takes an answer that has arrived. After a failed wait no answer will come: the last range stays. */
static void take(AsyncRange *late, const RangeCounts *found)
{
    if (late->found.fence)
        return;
    if (found)
        late->range = range_found(found);
    late->of = late->asked;
}

ScalarRange ranges_find_async(Ranges *ranges, Scalar scalar, const ParticleBuffers *particles, bool *stale)
{
    AsyncRange *late = &ranges->late[scalar];
    const ParticleAttribute *values = &particles->scalar[scalar];
    const RangeSource now = {particles->step, particles->time, particles->count, *values};
    if (now.count == 0 || !values->buffer)
        return none;
    if (!late->found.buffer && !mailbox_create(&late->found, "ranks found late", sizeof(RangeCounts))) {
        mailbox_destroy(&late->found);
        return ranges_find(ranges, values, now.count);
    }
    take(late, mailbox_look(&late->found));
    if (!late->found.fence && !(late->range.known && same(&late->of, &now))) {
        send(ranges, &late->found, values, now.count);
        late->asked = now;
    }
    if (!late->range.known) {
        take(late, mailbox_wait(&late->found));
        late->range.known = true;
    }
    *stale |= !same(&late->of, &now);
    return late->range;
}
