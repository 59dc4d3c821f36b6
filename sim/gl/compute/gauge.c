/* Plotted sums of the state: a pass adds up, and a few numbers come back without a wait. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/gauge_part.h"

#include <epoxy/gl.h>
#include <math.h>

/* Created on first use. */
static bool prepare(Compute *c)
{
    Error error;
    if (!c->gauge.buffer)
        mailbox_create(&c->gauge, "gauge", COMPUTE_GAUGE_GROUPS * sizeof(GaugePart));
    if (!c->program[COMPUTE_GAUGE])
        c->program[COMPUTE_GAUGE] = compute_program(c, COMPUTE_GAUGE, c->defines, &error);
    return c->gauge.mapped && c->program[COMPUTE_GAUGE];
}

bool compute_gauge(void *state, const double gravity[3])
{
    Compute *c = state;
    if (!prepare(c))
        return false;
    glProgramUniform4f(c->program[COMPUTE_GAUGE], GRAVITY_C2_AT, (float)gravity[0], (float)gravity[1],
                       (float)gravity[2], c->constants->sound_speed * c->constants->sound_speed);
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [NAMES_BUFFER] = c->now.name, [PARTS_BUFFER] = c->gauge.buffer);
    compute_run(c, COMPUTE_GAUGE, (size_t)COMPUTE_GAUGE_GROUPS * COMPUTE_GROUP);
    c->gauged = c->count;
    mailbox_send(&c->gauge);
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
