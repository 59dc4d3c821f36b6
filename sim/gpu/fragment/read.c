/* Plotted sums of the state: reduced with the targets of the watch, read back without a wait. */
#include "sim/gpu/fragment/fragment.h"

#include "sim/gpu/particle_buffers.h"

#include <epoxy/gl.h>
#include <math.h>

static void fragment_watch_send(Fragment *fragment);

enum { NUMBERS = 5, ENERGY_VECTORS = 6 };

/* Created on first use. */
static bool prepare(Fragment *f, Mailbox *mailbox, const char *label, size_t numbers)
{
    Error error;
    if (!mailbox->buffer)
        mailbox_create(mailbox, label, numbers * sizeof(float));
    return mailbox->mapped && fragment_gauge_programs(f, &error);
}

static void reduce_gauge(Fragment *f, FragmentPass first)
{
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    for (int level = 0; level < f->levels; level++) {
        const unsigned targets[2] = {f->found[level], f->held_sum[level]};
        fragment_draw(f, level == 0 ? first : FRAGMENT_GAUGE_MORE, targets, 2, f->level_size[level][0],
                      f->level_size[level][1]);
        fragment_sample(FRAGMENT_SAMPLE_FINER, f->found[level]);
        fragment_sample(FRAGMENT_SAMPLE_HELD, f->held_sum[level]);
    }
}

bool fragment_gauge(void *state, const double gravity[3])
{
    Fragment *f = state;
    if (!prepare(f, &f->gauge, "gauge", NUMBERS))
        return false;
    const float g[3] = {(float)gravity[0], (float)gravity[1], (float)gravity[2]};
    fragment_set3(f, FRAGMENT_GAUGE_FIRST, FRAGMENT_gravity, g);
    fragment_set1(f, FRAGMENT_GAUGE_FIRST, FRAGMENT_c2,
                  f->constants->sound_speed * f->constants->sound_speed);
    gl_state_keep(&f->caller_state);
    reduce_gauge(f, FRAGMENT_GAUGE_FIRST);
    gl_state_restore(&f->caller_state);
    fragment_pack(f->found[f->levels - 1], GL_RGBA_INTEGER, f->gauge.buffer, 0, 4 * sizeof(float));
    fragment_pack(f->held_sum[f->levels - 1], GL_RED_INTEGER, f->gauge.buffer, 4 * sizeof(float),
                  sizeof(float));
    mailbox_send(&f->gauge);
    return true;
}

bool fragment_gauged(void *state, WorldGauge *gauge, bool waits)
{
    Fragment *f = state;
    const float *found = waits ? mailbox_wait(&f->gauge) : mailbox_look(&f->gauge);
    if (!found)
        return false;
    const double unit = f->constants->unit_volume; /* masses are over the unit volume */
    gauge->density_error_mean = (double)found[0] / (f->count > 0 ? (double)f->count : 1);
    gauge->kinetic_energy = unit * (double)found[1];
    gauge->potential_energy = unit * (double)found[2];
    gauge->compression_energy = unit * (double)found[3];
    gauge->density_error_max = (double)found[4];
    return true;
}

/* Without an answer the energy is not a number, and the watch finds nothing. */
void fragment_energy(void *state, bool turning, EnergySums *sums)
{
    Fragment *f = state;
    const double unit = f->constants->unit_volume; /* masses are over the unit volume */
    const int count = turning ? ENERGY_VECTORS : ENERGY_VECTORS / 2;
    *sums = (EnergySums){.own = NAN};
    if (!prepare(f, &f->energy, "energy", (size_t)4 * ENERGY_VECTORS))
        return;
    fragment_set1(f, FRAGMENT_ENERGY_FIRST, FRAGMENT_c2,
                  f->constants->sound_speed * f->constants->sound_speed);
    for (int k = 0; k < count; k++) {
        fragment_set1(f, FRAGMENT_ENERGY_FIRST, FRAGMENT_which, (float)k);
        gl_state_keep(&f->caller_state);
        reduce_gauge(f, FRAGMENT_ENERGY_FIRST);
        gl_state_restore(&f->caller_state);
        fragment_pack(f->found[f->levels - 1], GL_RGBA_INTEGER, f->energy.buffer,
                      (size_t)k * 4 * sizeof(float), 4 * sizeof(float));
    }
    mailbox_send(&f->energy);
    const float(*part)[4] = mailbox_wait(&f->energy);
    if (!part)
        return;
    sums->own = unit * ((double)part[0][0] + (double)part[0][1]);
    sums->mass = unit * (double)part[0][2];
    for (int k = 0; k < 3; k++) {
        sums->momentum[k] = unit * (double)part[1][k];
        sums->first[k] = unit * (double)part[2][k];
        sums->second[k] = turning ? unit * (double)part[3][k] : 0;
        sums->second[3 + k] = turning ? unit * (double)part[4][k] : 0;
        sums->turn[k] = turning ? unit * (double)part[5][k] : 0;
    }
}

/* Particles for the views: a pass draws to a texture, copied to a pixel buffer that is the vertex buffer;
   no data leaves the GPU. */

/* Outputs of SHOW besides scalars. */
enum { SHOW_FLUID = SCALAR_STATE_COUNT, SHOW_ID };

static ParticleAttribute pack(Fragment *f, unsigned *buffer, unsigned texture, GLenum format, size_t stride)
{
    const size_t bytes = stride * (size_t)f->width * (size_t)f->height;
    if (!*buffer) {
        glCreateBuffers(1, buffer);
        glObjectLabel(GL_BUFFER, *buffer, -1, "shown");
        glNamedBufferStorage(*buffer, (GLsizeiptr)bytes, NULL, 0);
        f->bytes += bytes;
    }
    fragment_pack(texture, format, *buffer, 0, bytes);
    return (ParticleAttribute){*buffer, 0, stride};
}

static void draw(Fragment *f, FragmentPass pass, unsigned target)
{
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_draw(f, pass, &target, 1, f->width, f->height);
}

static void show(Fragment *f, int what)
{
    glProgramUniform1i(f->program[FRAGMENT_SHOW], fragment_uniform(f, FRAGMENT_SHOW, FRAGMENT_scalar), what);
    draw(f, FRAGMENT_SHOW, f->word);
}

static void share_scalars(Fragment *f, unsigned attributes, ParticleBuffers *out)
{
    for (int s = 0; s < SCALAR_STATE_COUNT; s++) {
        if (!(attributes & PARTICLE_SCALAR(s)) || (s >= SCALAR_OWN && s != SCALAR_LOST))
            continue;
        show(f, s);
        out->scalar[s] = pack(f, &f->shown[s], f->word, GL_RED_INTEGER, 4);
    }
}

void fragment_share(void *state, unsigned attributes, ParticleBuffers *out)
{
    Fragment *f = state;
    fragment_watch_send(f);
    gl_state_keep(&f->caller_state);
    fragment_shown_create(f);
    draw(f, FRAGMENT_PLACE, f->placed);
    out->position = pack(f, &f->shown_position, f->placed, GL_RGBA, 16);
    if (attributes & PARTICLE_VELOCITY)
        out->velocity = pack(f, &f->shown_velocity, f->velocity[0], GL_RGBA, 16);
    share_scalars(f, attributes, out);
    if (attributes & PARTICLE_FLUID) {
        show(f, SHOW_FLUID);
        out->fluid = pack(f, &f->shown[SHOW_FLUID], f->word, GL_RED_INTEGER, 4);
    }
    if (attributes & PARTICLE_ID) {
        show(f, SHOW_ID);
        out->id = pack(f, &f->shown[SHOW_ID], f->word, GL_RED_INTEGER, 4);
    }
    gl_state_restore(&f->caller_state);
}

/* Findings of a frame's kicks: reduced by ever smaller targets, read at the begin of the next frame. Also
   the state marked for the sentinel. */

static void sample_level(const Fragment *f, int level)
{
    fragment_sample(FRAGMENT_SAMPLE_FINER, f->found[level]);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held_sum[level]);
}

static void reduce_watch(Fragment *f)
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
    gl_state_keep(&f->caller_state);
    reduce_watch(f);
    gl_state_restore(&f->caller_state);
    fragment_swap(f->watch);
    f->watch_due = true;
}

static void fragment_watch_send(Fragment *f)
{
    if (!f->watch_due)
        return;
    fragment_pack(f->watch[0], GL_RGBA_INTEGER, f->watched.buffer, 0, f->watched.bytes);
    mailbox_send(&f->watched);
    f->watch_due = false;
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
    fragment_watch_forget(f);
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
