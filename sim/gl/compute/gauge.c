/* What is plotted of the state: a pass that adds up, a few numbers on their way back, no wait for them. */
#include "sim/gl/compute/compute.h"

#include <epoxy/gl.h>
#include <math.h>

enum { NUMBERS = 8 }; /* a group: shaders/sim/compute/gauge.comp */

/* The first time. */
static bool prepare(Compute *c)
{
    Error error;
    if (!c->gauge.buffer)
        mailbox_create(&c->gauge, "gauge", COMPUTE_GAUGE_GROUPS * NUMBERS * sizeof(float));
    if (!c->program[COMPUTE_GAUGE])
        c->program[COMPUTE_GAUGE] = compute_program(COMPUTE_GAUGE, c->defines, &error);
    return c->gauge.mapped && c->program[COMPUTE_GAUGE];
}

bool compute_gauge(void *state, const double gravity[3])
{
    Compute *c = state;
    if (!prepare(c))
        return false;
    glProgramUniform4f(c->program[COMPUTE_GAUGE], 0, (float)gravity[0], (float)gravity[1], (float)gravity[2],
                       c->constants->sound_speed * c->constants->sound_speed);
    compute_bind((const unsigned[]){c->now.position, c->now.velocity, c->now.name, c->gauge.buffer}, 4);
    compute_run(c, COMPUTE_GAUGE, (size_t)COMPUTE_GAUGE_GROUPS * COMPUTE_GROUP);
    c->gauged = c->count;
    mailbox_send(&c->gauge);
    return true;
}

bool compute_gauged(void *state, WorldGauge *gauge)
{
    Compute *c = state;
    const float *part = mailbox_look(&c->gauge);
    if (!part)
        return false;
    for (int group = 0; group < COMPUTE_GAUGE_GROUPS; group++, part += NUMBERS) {
        gauge->density_error_mean += (double)part[0];
        gauge->kinetic_energy += (double)part[1];
        gauge->potential_energy += (double)part[2];
        gauge->compression_energy += (double)part[3];
        gauge->density_error_max = fmax(gauge->density_error_max, (double)part[4]);
    }
    gauge->density_error_mean /= c->gauged > 0 ? (double)c->gauged : 1;
    return true;
}
