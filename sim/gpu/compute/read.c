/* Reads of the state: copies and sums. */
#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/gauge_part.h"
#include "shaders/sim/watch_block.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/step/backend.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>

bool compute_read(void *state, const ParticleArrays *out)
{
    const Compute *c = state;
    ParticleColumns copy;
    if (!compute_download(c, &copy))
        return false;
    particles_read(&copy, c->constants, NULL, 0, c->count, out);
    columns_destroy(&copy);
    return true;
}

/* Number of neighbours of particle i with r < h, in the last grid: in particle i's cell of `place` and the
   cells around. */
static size_t neighbours_of(const Compute *c, const ParticleColumns *p, const uint32_t *start, size_t place,
                            size_t i)
{
    const Constants *s = c->constants;
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    const uint32_t cell = c->fold.shared ? cell_near(s, &c->fold, place, x) : (uint32_t)place;
    const float h2 = s->support_radius * s->support_radius;
    size_t count = 0;
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(s, &c->fold, start, cell, rows);
    for (int row = 0; row < row_count; row++) {
        if (cell_row_repeats(s, &rows[row]))
            continue;
        for (size_t j = rows[row].begin; j < rows[row].end; j++) {
            float d[3] = {p->x[i] - p->x[j], p->y[i] - p->y[j], p->z[i] - p->z[j]};
            periodic_nearest(&s->periodic, d); /* for particles that crossed a side since */
            count += j != i && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < h2;
        }
    }
    return count;
}

/* Particles are ordered by their cells at the last `grid`: the cell starts give each particle's cell,
   wherever it is now. */
static double neighbours_mean(const Compute *c, const ParticleColumns *p)
{
    const size_t places = c->fold.count;
    uint32_t *start = malloc((places + 1) * sizeof *start);
    size_t sum = 0;
    if (!start)
        return 0;
    glGetNamedBufferSubData(c->start, 0, (GLsizeiptr)((places + 1) * sizeof *start), start);
    for (size_t place = 0; place < places; place++)
        for (size_t i = start[place]; i < start[place + 1]; i++)
            sum += neighbours_of(c, p, start, place, i);
    free(start);
    return c->count > 0 ? (double)sum / (double)c->count : 0;
}

void compute_sums(void *state, WorldSums *sums)
{
    const Compute *c = state;
    ParticleColumns copy;
    *sums = (WorldSums){0};
    if (!compute_download(c, &copy))
        return;
    particles_sums(&copy, c->constants, c->count, sums);
    sums->neighbours_mean = neighbours_mean(c, &copy);
    columns_destroy(&copy);
}

void compute_info(const void *state, WorldInfo *info)
{
    const Compute *c = state;
    info->threads = 0;
    info->state_bytes = c->bytes;
    info->unlisted = c->unlisted;
    info->guarded = c->guarded_before + c->guarded;
}

/* Particles for the views, in the buffers of the steps. Data not stored directly is written by a separate
   pass, only if wanted. */

/* A scalar, the fluid or the id: 4 bytes per particle. */
static ParticleAttribute show(Compute *c, int what)
{
    if (!c->shown[what])
        c->shown[what] = compute_buffer(c, "shown", 4 * c->capacity);
    if (!c->shown[what]) {
        c->full = false;
        return (ParticleAttribute){0};
    }
    BIND([POSITIONS_BUFFER] = c->now.position, [VELOCITIES_BUFFER] = c->now.velocity,
         [NAMES_BUFFER] = c->now.name, [PRESSURES_BUFFER] = c->pressure, [VALUES_BUFFER] = c->shown[what]);
    glProgramUniform1i(c->program[COMPUTE_SHOW], SHOWN_SCALAR_AT, what);
    compute_run(c, COMPUTE_SHOW, c->count);
    return (ParticleAttribute){c->shown[what], 0, 4};
}

/* A column of the method or a term; nothing if the scene has no column of the name. */
static ParticleAttribute show_own(Compute *c, Scalar scalar)
{
    const int place = columns_place(&c->own.rows, scalar);
    int k = 0;
    while (k < c->own.count && c->own.place[k] != place)
        k++;
    if (k == c->own.count)
        return (ParticleAttribute){0};
    if (!c->shown[scalar])
        c->shown[scalar] = compute_buffer(c, "shown", 4 * c->capacity);
    if (!c->shown[scalar]) {
        c->full = false;
        return (ParticleAttribute){0};
    }
    compute_own_copy_one(c, k, c->shown[scalar]);
    return (ParticleAttribute){c->shown[scalar], 0, 4};
}

void compute_share(void *state, unsigned attributes, ParticleBuffers *out)
{
    Compute *c = state;
    compute_watch_send(c);
    out->position = (ParticleAttribute){c->now.position, 0, 16};
    if (attributes & PARTICLE_VELOCITY)
        out->velocity = (ParticleAttribute){c->now.velocity, 0, 16};
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s))
            out->scalar[s] = s < SCALAR_OWN ? show(c, s) : show_own(c, (Scalar)s);
    if (attributes & PARTICLE_FLUID)
        out->fluid = show(c, COMPUTE_SHOW_FLUID);
    if (attributes & PARTICLE_ID)
        out->id = show(c, COMPUTE_SHOW_ID);
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

/* Plotted sums of the state: a pass adds up, and a few numbers come back without a wait. The sums of the
   watch over energy are waited for. */

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

void compute_energy_ahead(void *state)
{
    Compute *c = state;
    const float none = 0, sound = c->constants->sound_speed;
    if (!prepare(c, &c->energy, COMPUTE_ENERGY, "energy", ENERGY_VECTORS * 4 * sizeof(float)))
        return;
    glProgramUniform4f(c->program[COMPUTE_ENERGY], GRAVITY_C2_AT, none, none, none, sound * sound);
    add_up(c, &c->energy, COMPUTE_ENERGY);
    c->summed = true;
}

/* Without an answer the energy is not a number, and the watch finds nothing. */
void compute_energy(void *state, bool turning, EnergySums *sums)
{
    Compute *c = state;
    const double unit = c->constants->unit_volume; /* masses are over the unit volume */
    (void)turning;                                 /* all sums cost the same */
    *sums = (EnergySums){.own = NAN};
    const float(*part)[4] = c->summed ? mailbox_look(&c->energy) : NULL;
    if (!c->summed)
        compute_energy_ahead(c);
    if (!part)
        part = mailbox_wait(&c->energy);
    c->summed = false;
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

/* Findings of a frame's kicks, read at the begin of the next frame, and the state marked for the sentinel. */

/* The longest step since the last read bounds the distance per step. */
void compute_watch_note(Compute *c, float dt)
{
    c->longest = fmaxf(c->longest, dt);
    c->watch_due = true;
}

void compute_watch_send(Compute *c)
{
    if (!c->watch_due)
        return;
    mailbox_send(&c->watch);
    c->watch_due = c->watch_here = false;
}

StepWatch compute_watch(void *state)
{
    Compute *c = state;
    compute_watch_send(c);
    if (!c->watch.fence)
        return (StepWatch){.bounded = true};
    const WatchBlock *watched = c->watch_here ? mailbox_look(&c->watch) : NULL;
    if (!watched)
        watched = mailbox_wait(&c->watch);
    if (!watched)
        return (StepWatch){.bounded = false};
    Mailbox *forces = compute_forces_newest(c); /* sent before the watch */
    if (forces && forces->fence)
        compute_forces_arrive(c, mailbox_look(forces));
    const bool leaps = c->constants->method->leaps;
    const float fastest = leaps ? 1e18F : c->constants->support_radius / c->longest,
                speed2 = float_of_bits(watched->greatest_speed2);
    const StepWatch seen = {.bounded = watched->went_too_far == 0 && speed2 <= fastest * fastest,
                            .max_speed = sqrtf(speed2),
                            .max_acceleration = sqrtf(float_of_bits(watched->greatest_acceleration2)),
                            .max_density_ratio = float_of_bits(watched->greatest_density_ratio)};
    c->guarded = watched->guarded;
    c->longest = 0;
    static const WatchBlock nothing;
    glNamedBufferSubData(c->watch.buffer, 0, offsetof(WatchBlock, guarded), &nothing);
    return seen;
}

bool compute_mark(void *state, Error *error)
{
    Compute *c = state;
    if (!c->marked.position && !compute_particles_create(c, &c->marked, error)) {
        compute_particles_destroy(&c->marked);
        c->marked = (ComputeParticles){0};
        return c->full = false;
    }
    compute_particles_copy(c, c->now, c->marked);
    compute_forces_mark(c);
    return true;
}

void compute_back(void *state, size_t count, size_t guarded)
{
    Compute *c = state;
    compute_set_count(c, count);
    compute_particles_copy(c, c->marked, c->now);
    compute_forces_back(c);
    compute_watch_reset(c, guarded);
}
