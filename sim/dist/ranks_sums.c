/* Greatest values and sums over all ranks. */
#include "sim/dist/ranks_state.h"
#include "sim/dist/reduce.h"

#include <string.h>

StepWatch ranks_watch(void *state)
{
    Ranks *ranks = state;
    Clock begin = clock_now();
    StepWatch watch = cpu_watch(ranks->cpu);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    double most[5] = {(double)watch.max_speed, (double)watch.max_acceleration,
                      (double)watch.max_density_ratio, !watch.bounded, watch.memory};
    reduce_most(most, 5);
    watch.max_speed = (float)most[0];
    watch.max_acceleration = (float)most[1];
    watch.max_density_ratio = (float)most[2];
    watch.bounded = most[3] == 0;
    watch.memory = most[4] != 0;
    ranks->guarded = ranks->began_guarded + (size_t)reduce_count((int64_t)ranks->cpu->guarded);
    exchanged(ranks, begin);
    return watch;
}

Excess ranks_excess(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    double most = (double)cpu_excess_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    reduce_most(&most, 1);
    exchanged(ranks, begin);
    return (Excess){.mean = exact_value(&sum) / (ranks->total > 0 ? (double)ranks->total : 1),
                    .greatest = (float)most};
}

double ranks_sum(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    cpu_sum_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    exchanged(ranks, begin);
    return exact_value(&sum);
}

void ranks_energy(void *state, bool turning, EnergySums *sums)
{
    Ranks *ranks = state;
    ExactSum all[ENERGY_SUMS] = {{.strange = false}};
    double each[ENERGY_SUMS];
    cpu_energy_part(ranks->cpu, turning, all);
    reduce_exact(all, ENERGY_SUMS);
    for (int k = 0; k < ENERGY_SUMS; k++)
        each[k] = exact_value(&all[k]);
    memcpy(sums, each, sizeof *sums);
}

void ranks_sums(void *state, WorldSums *sums)
{
    Ranks *ranks = state;
    enum { COUNT = sizeof *sums / sizeof(double) };
    double each[COUNT], most;
    const double owned = (double)ranks->cpu->owned;
    cpu_sums(ranks->cpu, sums);
    for (int k = 0; k < 3; k++)
        sums->centre[k] = owned > 0 ? sums->centre[k] * sums->mass : 0;
    sums->neighbours_mean *= owned;
    most = sums->max_speed;
    memcpy(each, sums, sizeof each);
    reduce_sum(each, COUNT);
    reduce_most(&most, 1);
    memcpy(sums, each, sizeof each);
    sums->max_speed = most;
    for (int k = 0; k < 3 && sums->mass > 0; k++)
        sums->centre[k] /= sums->mass;
    sums->neighbours_mean /= ranks->total > 0 ? (double)ranks->total : 1;
}
