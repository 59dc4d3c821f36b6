#include "app/metric/metric_list.h"

#include "app/metric/metric.h"

#include <math.h>
#include <string.h>

/* 0 along periodic axes: a mean of wrapped positions has no meaning. */
static void centre_of_mass(const MetricState *state, double out[])
{
    for (int k = 0; k < 3; k++)
        out[k] = state->def->periodic[k] ? 0 : state->sums.centre[k];
}

static void kinetic_energy(const MetricState *state, double out[])
{
    out[0] = state->sums.kinetic_energy;
}

static void potential_energy(const MetricState *state, double out[])
{
    double centre[3];
    centre_of_mass(state, centre);
    out[0] = 0;
    for (int k = 0; k < 3; k++)
        out[0] -= state->sums.mass * state->info.gravity[k] * centre[k];
}

static void angular_momentum(const MetricState *state, double out[])
{
    memcpy(out, state->sums.angular_momentum, sizeof state->sums.angular_momentum);
}

static void max_speed(const MetricState *state, double out[])
{
    out[0] = state->sums.max_speed;
}

static void front(const MetricState *state, double out[])
{
    out[0] = metric_front(&state->cloud);
}

static void height(const MetricState *state, double out[])
{
    out[0] = -INFINITY;
    for (size_t i = 0; i < state->cloud.count; i++)
        out[0] = fmax(out[0], (double)state->cloud.position[4 * i + 1]);
    out[0] = state->cloud.count > 0 ? out[0] + 0.5 * state->cloud.spacing : (double)NAN;
}

static void density_error(const MetricState *state, double out[])
{
    const Cloud *cloud = &state->cloud;
    out[0] = 0;
    for (size_t i = 0; i < cloud->count; i++)
        out[0] += fmax((double)cloud->density[i] / state->def->fluids[cloud->fluid[i]].density - 1, 0) /
                  (double)cloud->count;
}

static void probes(const MetricState *state, double out[])
{
    memcpy(out, state->probe, (size_t)state->probe_count * sizeof *out);
}

int metric_numbers(int metric, int probe_count)
{
    return metric_kinds[metric].numbers ? metric_kinds[metric].numbers : probe_count;
}

const MetricKind metric_kinds[] = {
    {"centre_of_mass", "m", "of all fluid, in the box's frame, but for periodic axes", 3, false,
     centre_of_mass},
    {"kinetic_energy", "J", "of the motion in the box's frame", 1, false, kinetic_energy},
    {"potential_energy", "J", "in gravity, over the box's origin, but for periodic axes", 1, false,
     potential_energy},
    {"angular_momentum", "kg m2/s", "about the box's origin", 3, false, angular_momentum},
    {"max_speed", "m/s", "of the fastest particle", 1, false, max_speed},
    {"front", "m", "greatest x of the fluid on the floor, of particles with neighbours", 1, true, front},
    {"height", "m", "of the highest particle over the floor", 1, true, height},
    {"density_error", "", "mean of what particles are pressed above the rest density, over it", 1, true,
     density_error},
    {"probes", "", "what each of the scene's probes reads, its first number, over its range; their mean", 0,
     true, probes},
    {NULL, NULL, NULL, 0, false, NULL},
};

int metric_defaults(int metrics[])
{
    metrics[0] = 0; /* centre_of_mass */
    metrics[1] = 1; /* kinetic_energy */
    return 2;
}

bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count)
{
    bool particles = false;
    for (int m = 0; m < count; m++)
        particles |= metric_kinds[metrics[m]].particles;
    state->def = def;
    world_info(world, &state->info);
    world_sums(world, &state->sums);
    return !particles || cloud_read(&state->cloud, world);
}

void metric_state_free(MetricState *state)
{
    cloud_free(&state->cloud);
}
