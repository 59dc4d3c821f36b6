/* Two worlds in step: a GPU backend's steps against `cpu` from the same state. */
#ifndef SLOSH_PARITY_H
#define SLOSH_PARITY_H

#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "sim/methods/mueller/mueller.h"
#include "sim/methods/wcsph/wcsph_private.h"
#include "sim/step/world.h"

/* Two viscous fluids in layers, stirred, in a box with all kinds of motion. */
static inline WorldDef stirred_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 1, 0.9);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.02 : 0.06;
    def.sound_speed = 15;
    def.dt = 0.0005;
    *world_threads(&def) = 1;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 3};
    fixture_block(&def, 0, -0.6, 0, -0.45, 0.1, 0.4, 0.45);
    fixture_block(&def, 1, -0.6, 0.4, -0.45, 0.3, 0.6, 0.45);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.3, 0}, .amplitude = 0.05, .frequency = 2});
    add_motion(&def, (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 20, .frequency = 1.5});
    return def;
}

/* The kernel and the support that mueller has by default in the plane with several fluids. */
static inline void for_layers(WorldDef *def)
{
    snprintf(mueller_def(def)->density_kernel, NAME_SIZE, "quintic");
    def->support = 3;
}

/* How much of p_i V_i^2 a pair takes: 1, but for the contrast of sim/methods/wcsph/pairs_surface.c. */
static inline double share_of_pressure(const Constants *s, uint32_t fi, uint32_t fj)
{
    const double mine = (double)s->density[fi], theirs = (double)s->density[fj];
    const double w = fmax(0, 1 - (double)CONTRAST_LEAST * fmin(mine, theirs) / fmax(mine, theirs));
    return !s->method->carries_density ? 1 : mine < theirs ? 1 + w : 1 - w;
}

/* The magnitudes of what particle j does to i by pressure, viscosity and tension, N. */
static inline double pair_terms(const Constants *s, const State *state, size_t i, size_t j, double r)
{
    const double h = (double)s->support_radius,
                 gradient = -s->lattice.gradient_scale * s->lattice.pressure_kernel->derivative(r, h);
    const uint32_t fi = state->fluid[i], fj = state->fluid[j];
    const double vi = (double)state->position[4 * i + 3], vj = (double)state->position[4 * j + 3];
    const double mu = pair_viscosity((double)s->viscosity[fi], (double)s->viscosity[fj]);
    const bool carries = s->method->carries_density, morris = s->friction.walls != DRAG_LAPLACIAN;
    const WcsphBlock *wcsph = wcsph_constants(s);
    const double radial = carries ? (double)wcsph->radial_friction : 0;
    const double alpha = carries ? (double)(wcsph->wcsph_fluids[fi].artificial_viscosity +
                                            wcsph->wcsph_fluids[fj].artificial_viscosity)
                                 : 0;
    double u = 0;
    for (size_t k = 0; k < 3; k++)
        u = hypot(u, (double)(state->velocity[4 * i + k] - state->velocity[4 * j + k]));
    double sum = gradient * (share_of_pressure(s, fi, fj) * fabs((double)state->pressure[i]) * vi * vi +
                             share_of_pressure(s, fj, fi) * fabs((double)state->pressure[j]) * vj * vj);
    sum += vi * vj * u *
           (morris ? ((radial > 0 ? mu * radial * r * r : mu) + alpha) * gradient / r
                   : 0.5 * mu * s->lattice.laplacian_scale * kernel_viscosity_laplacian(r, h));
    if (fi != fj || !s->tension_model || s->tension_model == TENSION_CURVATURE) /* the latter is of no pair */
        return sum;
    const double t = h * h - r * r, dims = s->dimensions, unit = s->unit;
    return sum + (double)s->tension[fi] * vi * vj *
                     (s->tension_model == TENSION_COHESION
                          ? fabs(cohesion_kernel(r, h)) / (s->unit_volume * pow(unit, 5))
                          : (double)s->colour / (s->unit_volume * pow(unit, 4)) * t *
                                fabs(dims * h * h - (dims + 4) * r * r));
}

/* The sum of the accelerations and of weight over mass, m/s2. */
static inline double scale_of(const Constants *s, const State *state, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j < state->count; j++) {
        double r2 = 0;
        float d[3];
        for (size_t k = 0; k < 3; k++)
            d[k] = state->position[4 * i + k] - state->position[4 * j + k];
        periodic_nearest(&s->periodic, d);
        for (size_t k = 0; k < 3; k++)
            r2 += (double)(d[k] * d[k]);
        if (j != i && r2 < (double)(s->support_radius * s->support_radius))
            sum += pair_terms(s, state, i, j, sqrt(r2));
    }
    return sum / constants_mass(s, (int)state->fluid[i]) + 9.81;
}

static inline void require(const char *what, const Worst *worst, double most)
{
    if (!(worst->off < most))
        fail_msg("%s of particle %u at (%g, %g, %g) off by %g", what, worst->id, (double)worst->x[0],
                 (double)worst->x[1], (double)worst->x[2], worst->off);
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
static inline Worst compare_rates(World *cpu, World *gpu, const float *before, const State *state)
{
    float *a = compressions(cpu), *b = compressions(gpu);
    double greatest = 0;
    Worst worst = {0};
    for (size_t i = 0; i < cpu->count; i++) {
        greatest = fmax(greatest, fabs((double)(a[i] - before[i])));
        worst_take(&worst, fabs((double)(a[i] - b[i])), (uint32_t)i, state->position + 4 * i);
    }
    worst.off /= greatest;
    free(a);
    free(b);
    return worst;
}

/* A step of two worlds: density within 1e-5 of rest, acceleration within 1e-4 of the sum of the
   magnitudes of the pair terms. */
static inline void compare_step(const char *label, World *cpu, World *gpu)
{
    float *before = compressions(cpu);
    fixture_step(cpu, 1);
    fixture_step(gpu, 1);
    State a = fixture_read(cpu), b = fixture_read(gpu);
    Worst density = {0}, change = {0}, rate = {0}, place = {0};
    for (size_t i = 0; i < a.count; i++) {
        worst_take(&density,
                   (double)(fabsf(a.density[i] - b.density[i]) / cpu->constants.density[a.fluid[i]]),
                   (uint32_t)i, a.position + 4 * i);
        float off[3];
        for (size_t k = 0; k < 3; k++)
            off[k] = a.position[4 * i + k] - b.position[4 * i + k];
        periodic_nearest(&cpu->constants.periodic, off);
        worst_take(&place, hypot(hypot((double)off[0], (double)off[1]), (double)off[2]), (uint32_t)i,
                   a.position + 4 * i);
        double velocity = 0;
        for (size_t k = 4 * i; k < 4 * i + 3; k++)
            velocity = hypot(velocity, (double)(a.velocity[k] - b.velocity[k]));
        worst_take(&change, velocity / (cpu->def.dt * scale_of(&cpu->constants, &a, i)), (uint32_t)i,
                   a.position + 4 * i);
        assert_true(b.velocity[4 * i + 3] == 0);
    }
    if (cpu->constants.method->carries_density)
        rate = compare_rates(cpu, gpu, before, &a);
    printf("%dD, %s: density off by %.1e of rest, its rate by %.1e, acceleration by %.1e of its terms\n",
           cpu->def.dimensions, label, density.off, rate.off, change.off);
    require("density", &density, 1e-5);
    require("place, m,", &place, 1e-6);
    require("rate of density", &rate, 1e-3);
    require("acceleration", &change, 1e-4);
    free(before);
    fixture_free(&a);
    fixture_free(&b);
}

#endif
