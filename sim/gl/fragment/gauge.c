/* Plotted sums of the state: reduced with the targets of the watch, read back without a wait. */
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>
#include <math.h>

enum { NUMBERS = 5, ENERGY_VECTORS = 6 };

/* Created on first use. */
static bool prepare(Fragment *f, Mailbox *mailbox, const char *label, size_t numbers)
{
    Error error;
    if (!mailbox->buffer)
        mailbox_create(mailbox, label, numbers * sizeof(float));
    return mailbox->mapped && fragment_gauge_programs(f, &error);
}

static void reduce(const Fragment *f, FragmentPass first)
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
    gl_state_keep(&f->kept);
    reduce(f, FRAGMENT_GAUGE_FIRST);
    gl_state_restore(&f->kept);
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
        gl_state_keep(&f->kept);
        reduce(f, FRAGMENT_ENERGY_FIRST);
        gl_state_restore(&f->kept);
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
