/* Findings of a frame's kicks: reduced by ever smaller targets, read at the begin of the next frame. Also
   the state marked for the sentinel. */
#include "sim/gl/float_bits.h"
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>
#include <math.h>

static void sample_level(const Fragment *f, int level)
{
    fragment_sample(FRAGMENT_SAMPLE_FINER, f->found[level]);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held_sum[level]);
}

static void reduce(const Fragment *f)
{
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_ACCELERATION, f->acceleration);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held[0]);
    for (int level = 0; level < f->levels; level++) {
        const unsigned targets[2] = {f->found[level], f->held_sum[level]};
        const int *size = f->level_size[level];
        fragment_draw(f, level == 0 ? FRAGMENT_WATCH_FIRST : FRAGMENT_WATCH_MORE, targets, 2, size[0],
                      size[1]);
        sample_level(f, level);
    }
    fragment_sample(FRAGMENT_SAMPLE_BEFORE, f->watch[0]);
    fragment_draw(f, FRAGMENT_WATCH_LAST, &f->watch[1], 1, 2, 1);
}

void fragment_watch_gather(Fragment *f, const float gravity[3], float dt)
{
    f->longest = fmaxf(f->longest, dt);
    fragment_set3(f, FRAGMENT_WATCH_FIRST, FRAGMENT_gravity, gravity);
    gl_state_keep(&f->kept);
    reduce(f);
    gl_state_restore(&f->kept);
    fragment_swap(f->watch);
    f->watch_due = true;
}

void fragment_watch_send(Fragment *f)
{
    if (!f->watch_due)
        return;
    fragment_pack(f->watch[0], GL_RGBA_INTEGER, f->watched.buffer, 0, f->watched.bytes);
    mailbox_send(&f->watched);
    f->watch_due = false;
}

static void forget(Fragment *f)
{
    glClearTexImage(f->watch[0], 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, NULL);
    f->longest = 0;
}

void fragment_watch_reset(Fragment *f, size_t guarded)
{
    forget(f);
    mailbox_forget(&f->watched);
    f->watch_due = false;
    f->marks = 0;
    glClearTexImage(f->held[0], 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    f->guarded_before = guarded;
    f->guarded = 0;
}

StepWatch fragment_watch(void *state)
{
    Fragment *f = state;
    fragment_watch_send(f);
    if (!f->watched.fence)
        return (StepWatch){.bounded = true};
    const uint32_t *found = mailbox_wait(&f->watched);
    if (!found)
        return (StepWatch){.bounded = false};
    const float fastest = f->constants->support_radius / f->longest, speed2 = float_of_bits(found[0]);
    f->lost = found[3];
    f->guarded = found[4];
    forget(f);
    return (StepWatch){.bounded = speed2 <= fastest * fastest,
                       .max_speed = sqrtf(speed2),
                       .max_acceleration = sqrtf(float_of_bits(found[1])),
                       .max_density_ratio = float_of_bits(found[2]),
                       .lost = f->lost,
                       .lost_limit = f->lost_limit};
}

static void copy_texture(const Fragment *f, unsigned from, unsigned to)
{
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, f->width, f->height,
                       1);
}

bool fragment_mark(void *state, Error *error)
{
    Fragment *f = state;
    if (!f->marked[0] && !fragment_marked_create(f, error))
        return false;
    fragment_order(f);
    copy_texture(f, f->position[0], f->marked[0]);
    copy_texture(f, f->velocity[0], f->marked[1]);
    return true;
}

void fragment_back(void *state, size_t count, size_t guarded)
{
    Fragment *f = state;
    (void)count; /* never changes */
    copy_texture(f, f->marked[0], f->position[0]);
    copy_texture(f, f->marked[1], f->velocity[0]);
    fragment_watch_reset(f, guarded);
}
