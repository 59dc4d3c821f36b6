/* The carried density and derived quantities. */
#include "sim/wcsph/passes.h"

PAIR_LOOPS(wcsph_slope);
PAIR_LOOPS(wcsph_rate);
PAIR_LOOPS(wcsph_images_rate);
PAIR_LOOPS(wcsph_corrected_rate);
PAIR_LOOPS(wcsph_interface_rate);

static void fill_rest_densities(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++)
        if (p->fluid[i] < FLUIDS_MAX)
            p->own[REST_DENSITY][i] = range->cpu->constants->density[p->fluid[i]];
}

/* Density += rate times dt; pressure, and V = V0 rho0 / rho. Diffusion uses the mean of before and after,
   which is stable for steps up to 4 over its rate; the value after alone allows only 2. */
static void state_body(const CpuRange *range)
{
    Cpu *cpu = range->cpu;
    const Constants *s = cpu->constants;
    const WcsphBlock *own = wcsph_constants(s);
    const CpuParticles *p = &cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        const int fluid = p->fluid[i];
        if (fluid >= FLUIDS_MAX) {
            cpu_boundary_terms(cpu, i);
            continue;
        }
        const float before = p->compression[i],
                    e = wcsph_density_after(before, p->own[RATE][i] * range->input->dt),
                    pressure = wcsph_state_of(s, fluid, e);
        p->compression[i] = e;
        p->volume[i] = 1 / ((1 + e) * s->rest_number_density);
        p->pressure[i] = s->negative_pressure || pressure > 0 ? pressure : 0;
        p->pressure_term[i] = p->pressure[i] * p->volume[i] * p->volume[i];
        if (p->own[RELATIVE])
            p->own[RELATIVE][i] = 0.5f * (before + e);
        if (p->own[ARTIFICIAL])
            p->own[ARTIFICIAL][i] = own->wcsph_fluids[fluid].artificial_viscosity;
        cpu_fill_terms(cpu, i);
    }
    if (p->own[REST_DENSITY])
        fill_rest_densities(range);
}

static void slope_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_slope);
}

static void rate_body(const CpuRange *range)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    const float *flow = p->ax;
    cpu_pairs(range, &wcsph_rate);
    cpu_pairs(range, &wcsph_images_rate);
    if (p->own[CORRECTION])
        cpu_pairs(range, &wcsph_corrected_rate);
    if (p->own[REST_DENSITY])
        cpu_pairs(range, &wcsph_interface_rate);
    for (size_t i = range->begin; i < range->end; i++)
        p->own[RATE][i] = flow[i] / s->rest_number_density;
}

#define STATE                                                                                                \
    {                                                                                                        \
        state_body, .solids = true                                                                           \
    }

static const CpuPass state = {.loops = {STATE}};
/* Per neighbour: {x, p V^2}, fluid and relative density. */
static PairCost slope_pair(const Constants *constants)
{
    return (PairCost){.gather = 16 + 4 + 4, .flops = 32 + wcsph_shape_flops(constants)};
}

/* Per neighbour: {x, p V^2} and {v, V}; with diffusion also the data of the slope's pass, and the slope. */
static PairCost continuity_pair(const Constants *constants)
{
    const bool diffuses = wcsph_diffuses(constants);
    return (PairCost){.gather = 32 + 20 * diffuses + 4 * wcsph_layers(constants),
                      .flops = 20 + 13 * diffuses + wcsph_shape_flops(constants)};
}

static const CpuPass slope = {.loops = {{slope_body, .walks = true}}, .pair = slope_pair};
static const CpuPass continuity = {.loops = {{rate_body, .walks = true}, STATE}, .pair = continuity_pair};

const Pass wcsph_state = {
    .name = "state",
    .stage = STAGE_DENSITY,
    .cpu = &state,
    .shader = "wcsph/state",
    .reads = "fluid compression rate",
    .writes = "compression volume pressure pressure_term relative kind viscosity artificial tension "
              "rest_density",
};

const Pass wcsph_gradient = {
    .name = "slope",
    .stage = STAGE_DENSITY,
    .cpu = &slope,
    .shader = "wcsph/slope",
    .reads = "position fluid relative kind",
    .writes = "slope",
    .needed = wcsph_diffuses,
};

const Pass wcsph_continuity = {
    .name = "continuity",
    .stage = STAGE_DENSITY,
    .cpu = &continuity,
    .shader = "wcsph/continuity",
    .reads = "position velocity fluid relative kind slope compression correction correction_mixed "
             "rest_density",
    .writes = "rate compression volume pressure pressure_term relative kind viscosity artificial tension "
              "rest_density acceleration",
};
