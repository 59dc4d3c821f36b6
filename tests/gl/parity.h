/* Two worlds in step: what a backend on the GPU makes of a state against what `cpu` makes of it. */
#ifndef SLOSH_PARITY_H
#define SLOSH_PARITY_H

#include "tests/gl/compute_fixture.h"

/* The magnitudes of what particle j does to i by pressure, viscosity and tension, N. */
static inline double pair_terms(const Solver *s, const State *state, size_t i, size_t j, double r)
{
    const double h = (double)s->support_radius,
                 gradient = -s->lattice.gradient_scale * s->lattice.pressure_kernel->derivative(r, h);
    const uint32_t fi = state->fluid[i], fj = state->fluid[j];
    const double vi = (double)state->position[4 * i + 3], vj = (double)state->position[4 * j + 3];
    const double mu = (double)(s->viscosity[fi] + s->viscosity[fj]);
    const double alpha =
        s->continuity ? (double)(s->artificial_viscosity[fi] + s->artificial_viscosity[fj]) : 0;
    double u = 0;
    for (size_t k = 0; k < 3; k++)
        u = hypot(u, (double)(state->velocity[4 * i + k] - state->velocity[4 * j + k]));
    double sum =
        gradient * (fabs((double)state->pressure[i]) * vi * vi + fabs((double)state->pressure[j]) * vj * vj);
    sum += vi * vj * u *
           (s->continuity ? (mu + alpha) * gradient / r
                          : 0.5 * mu * s->lattice.laplacian_scale * kernel_viscosity_laplacian(r, h));
    if (fi != fj || !s->tension_model)
        return sum;
    const double t = h * h - r * r, dims = s->dimensions;
    return sum + (double)s->tension[fi] * vi * vj *
                     (s->tension_model == TENSION_COHESION
                          ? fabs(cohesion_kernel(r, h))
                          : (double)s->colour * t * fabs(dims * h * h - (dims + 4) * r * r));
}

/* The sum of these and of its weight over its mass, m/s2. */
static inline double scale_of(const Solver *s, const State *state, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j < state->count; j++) {
        double r2 = 0;
        for (size_t k = 0; k < 3; k++) {
            const double d = (double)(state->position[4 * i + k] - state->position[4 * j + k]);
            r2 += d * d;
        }
        if (j != i && r2 < (double)(s->support_radius * s->support_radius))
            sum += pair_terms(s, state, i, j, sqrt(r2));
    }
    return sum / (double)s->mass[state->fluid[i]] + 9.81;
}

/* The greatest of what is off, and whose it is. */
typedef struct Worst {
    double off;
    size_t particle;
} Worst;

static inline void worst_of(Worst *worst, double off, size_t particle)
{
    if (!(off <= worst->off)) /* NaN is worse */
        *worst = (Worst){off, particle};
}

static inline void require(const char *what, const Worst *worst, double most, const State *state)
{
    const float *x = state->position + 4 * worst->particle;
    if (!(worst->off < most))
        fail_msg("%s of particle %zu at (%g, %g, %g) off by %g", what, worst->particle, (double)x[0],
                 (double)x[1], (double)x[2], worst->off);
}

/* rho / rho0 - 1 by id; the caller frees it. */
static inline float *compressions(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    float *values = malloc(info.count * sizeof *values);
    uint32_t *id = malloc(info.count * sizeof *id);
    ParticleArrays out = {.id = id};
    out.scalar[SCALAR_COMPRESSION] = values;
    world_read(world, &out);
    fixture_order(values, id, info.count, 1);
    free(id);
    return values;
}

/* wcsph: what a step adds to the densities, within 1e-3 of the greatest addition. */
static inline Worst compare_rates(World *cpu, World *gpu, const float *before)
{
    float *a = compressions(cpu), *b = compressions(gpu);
    double greatest = 0;
    Worst worst = {0};
    for (size_t i = 0; i < cpu->count; i++) {
        greatest = fmax(greatest, fabs((double)(a[i] - before[i])));
        worst_of(&worst, fabs((double)(a[i] - b[i])), i);
    }
    worst.off /= greatest;
    free(a);
    free(b);
    return worst;
}

/* One step of both: density within 1e-5 of rest, acceleration within 1e-4 of the sum of the magnitudes of the
   pair terms. */
static inline void compare_step(const char *label, World *cpu, World *gpu)
{
    float *before = compressions(cpu);
    fixture_step(cpu, 1);
    fixture_step(gpu, 1);
    State a = fixture_read(cpu), b = fixture_read(gpu);
    Worst density = {0}, change = {0}, rate = {0};
    for (size_t i = 0; i < a.count; i++) {
        worst_of(&density, (double)(fabsf(a.density[i] - b.density[i]) / cpu->solver.density[a.fluid[i]]), i);
        double velocity = 0;
        for (size_t k = 4 * i; k < 4 * i + 3; k++)
            velocity = hypot(velocity, (double)(a.velocity[k] - b.velocity[k]));
        worst_of(&change, velocity / (cpu->def.dt * scale_of(&cpu->solver, &a, i)), i);
        assert_true(b.velocity[4 * i + 3] == 0);
    }
    if (cpu->solver.continuity)
        rate = compare_rates(cpu, gpu, before);
    printf("%dD, %s: density off by %.1e of rest, its rate by %.1e, acceleration by %.1e of its terms\n",
           cpu->def.dimensions, label, density.off, rate.off, change.off);
    require("density", &density, 1e-5, &a);
    require("rate of density", &rate, 1e-3, &a);
    require("acceleration", &change, 1e-4, &a);
    free(before);
    fixture_free(&a);
    fixture_free(&b);
}

/* Centre of mass (m), energy, and where 99 of 100 particles are left of (m). */
typedef struct Outcome {
    double centre[3], energy, front;
} Outcome;

static inline int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static inline Outcome outcome_of(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    State s = fixture_read(world);
    Outcome out = {.energy = sums.kinetic_energy + sums.mass * 9.81 * sums.centre[1]};
    memcpy(out.centre, sums.centre, sizeof out.centre);
    for (size_t i = 0; i < s.count; i++)
        s.density[i] = s.position[4 * i];
    qsort(s.density, s.count, sizeof *s.density, ascending);
    out.front = (double)s.density[s.count * 99 / 100];
    fixture_free(&s);
    return out;
}

/* Differences as parts of the box's width and of the energy at first. */
static inline void compare_outcomes(const char *label, const Outcome *a, const Outcome *b,
                                    const Outcome *first, double width, double off[3])
{
    off[0] = 0;
    for (int k = 0; k < 3; k++)
        off[0] = fmax(off[0], fabs(a->centre[k] - b->centre[k]) / width);
    off[1] = fabs(a->energy - b->energy) / first->energy;
    off[2] = fabs(a->front - b->front) / width;
    printf("%s: centre off by %.1e, energy by %.1e, front by %.1e\n", label, off[0], off[1], off[2]);
}

/* Every x by one unit in the last place. */
static inline void perturb(World *world)
{
    WorldState saved = {0};
    Error error;
    assert_true(world_save(world, &saved, &error));
    for (size_t i = 0; i < saved.count; i++)
        saved.particles.x[i] = nextafterf(saved.particles.x[i], 0);
    if (!world_load(world, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

/* 200 steps on: within 1 %. What the CPU makes of the least perturbation stands beside it: where that is no
   better, the state is too violent to tell. */
static inline void compare_run(World *cpu, World *gpu)
{
    World *other = world_on(cpu->def, "cpu");
    copy_state(cpu, gpu);
    copy_state(cpu, other);
    perturb(other);
    const Outcome before = outcome_of(cpu);
    fixture_step(cpu, 200);
    fixture_step(gpu, 200);
    fixture_step(other, 200);
    const Outcome a = outcome_of(cpu), b = outcome_of(gpu), floor = outcome_of(other);
    double off[3];
    compare_outcomes("  the cpu after a perturbation by one ulp", &a, &floor, &before, cpu->def.box_size[0],
                     off);
    compare_outcomes("  after 200 steps", &a, &b, &before, cpu->def.box_size[0], off);
    assert_true(off[0] < 0.01 && off[1] < 0.01 && off[2] < 0.01);
    world_destroy(other);
}

#endif
