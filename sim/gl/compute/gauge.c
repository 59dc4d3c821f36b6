/* Plotted sums of the state: a pass adds up, and a few numbers come back without a wait. The sums of the
   watch over energy are waited for. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/gauge_part.h"

#include <epoxy/gl.h>
#include <math.h>

enum { ENERGY_VECTORS = 6 }; /* of a group in energy.comp */

/* Created on first use: `bytes` for each group. */
static bool prepare(Compute *c, Mailbox *mailbox, ComputePass pass, const char *label, size_t bytes)
{
    Error error;
    if (!mailbox->buffer)
        mailbox_create(mailbox, label, COMPUTE_GAUGE_GROUPS * bytes);
    if (!c->program[pass])
        c->program[pass] = compute_program(c, pass, c->defines, &error);
    return mailbox->mapped && c->program[pass];
}

/* Sums over the particles, into the mailbox. */
static void add_up(Compute *c, Mailbox *mailbox, ComputePass pass)
{
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [NAMES_BUFFER] = c->now.name, [PARTS_BUFFER] = mailbox->buffer);
    compute_run(c, pass, (size_t)COMPUTE_GAUGE_GROUPS * COMPUTE_GROUP);
    mailbox_send(mailbox);
}

bool compute_gauge(void *state, const double gravity[3])
{
    Compute *c = state;
    if (!prepare(c, &c->gauge, COMPUTE_GAUGE, "gauge", sizeof(GaugePart)))
        return false;
    glProgramUniform4f(c->program[COMPUTE_GAUGE], GRAVITY_C2_AT, (float)gravity[0], (float)gravity[1],
                       (float)gravity[2], c->constants->sound_speed * c->constants->sound_speed);
    add_up(c, &c->gauge, COMPUTE_GAUGE);
    c->gauged = c->count;
    return true;
}

bool compute_gauged(void *state, WorldGauge *gauge, bool waits)
{
    Compute *c = state;
    const GaugePart *part = waits ? mailbox_wait(&c->gauge) : mailbox_look(&c->gauge);
    if (!part)
        return false;
    const double unit = c->constants->unit_volume; /* masses are over the unit volume */
    for (int group = 0; group < COMPUTE_GAUGE_GROUPS; group++, part++) {
        gauge->density_error_mean += (double)part->density_error;
        gauge->kinetic_energy += unit * (double)part->kinetic_energy;
        gauge->potential_energy += unit * (double)part->potential_energy;
        gauge->compression_energy += unit * (double)part->compression_energy;
        gauge->density_error_max = fmax(gauge->density_error_max, (double)part->greatest_compression);
    }
    gauge->density_error_mean /= c->gauged > 0 ? (double)c->gauged : 1;
    return true;
}

/* Without an answer the energy is not a number, and the watch finds nothing. */
void compute_energy(void *state, bool turning, EnergySums *sums)
{
    Compute *c = state;
    const double unit = c->constants->unit_volume; /* masses are over the unit volume */
    const float(*part)[4] = NULL;
    (void)turning; /* all sums cost the same */
    *sums = (EnergySums){.own = NAN};
    if (prepare(c, &c->energy, COMPUTE_ENERGY, "energy", ENERGY_VECTORS * sizeof *part)) {
        glProgramUniform4f(c->program[COMPUTE_ENERGY], GRAVITY_C2_AT, 0, 0, 0,
                           c->constants->sound_speed * c->constants->sound_speed);
        add_up(c, &c->energy, COMPUTE_ENERGY);
        part = mailbox_wait(&c->energy);
    }
    if (part)
        sums->own = 0;
    for (int group = 0; part && group < COMPUTE_GAUGE_GROUPS; group++, part += ENERGY_VECTORS) {
        sums->own += unit * ((double)part[0][0] + (double)part[0][1]);
        sums->mass += unit * (double)part[0][2];
        for (int k = 0; k < 3; k++) {
            sums->momentum[k] += unit * (double)part[1][k];
            sums->first[k] += unit * (double)part[2][k];
            sums->second[k] += unit * (double)part[3][k];
            sums->second[3 + k] += unit * (double)part[4][k];
            sums->turn[k] += unit * (double)part[5][k];
        }
    }
}
