#include "app/lab/micro.h"

#include "app/base/program.h"
#include "sim/base/stage.h"

#include <math.h>
#include <string.h>

enum { ROUNDS_LEAST = 3, ROUNDS_MOST = 100 };

static const double enough_ms = 1000; /* for all rounds of a state */

double micro_copy(const Ceilings *ceilings, double bytes)
{
    double best = ceilings->copy[ceilings->copies - 1].rate;
    for (int k = 0; k < ceilings->copies; k++)
        if ((double)ceilings->copy[k].bytes >= bytes)
            best = fmax(best, ceilings->copy[k].rate);
    return best;
}

/* Lower bound of the time by each limit, s. */
static void least_times(const MicroPart *part, double particles, double pairs, const Ceilings *ceilings,
                        double seconds[MICRO_LIMIT_COUNT])
{
    const double streamed = part->stream * particles + part->stream_a_pair * pairs;
    seconds[MICRO_MEMORY] = streamed / micro_copy(ceilings, streamed);
    seconds[MICRO_CACHE] = part->pair.gather * pairs / micro_copy(ceilings, 0);
    seconds[MICRO_FLOPS] = part->pair.flops * pairs / ceilings->fused.rate;
}

static MicroFigure figure_of(const MicroPart *part, double particles, double pairs, double ms,
                             const Ceilings *ceilings)
{
    double least[MICRO_LIMIT_COUNT];
    const double seconds = 1e-3 * ms, bytes_a_pair = part->stream_a_pair + part->pair.gather;
    MicroFigure figure = {.name = part->name,
                          .pairs = part->pairs,
                          .pair = part->pair,
                          .bytes_per_particle = part->stream,
                          .bytes_per_pair = bytes_a_pair,
                          .ms = ms,
                          .particle_steps_per_second = particles / seconds};
    figure.bytes_per_second = (part->stream * particles + bytes_a_pair * pairs) / seconds;
    if (part->pairs) {
        figure.pairs_per_second = pairs / seconds;
        figure.flops_per_second = part->pair.flops * pairs / seconds;
        figure.flops_share = figure.flops_per_second / ceilings->fused.rate;
    }
    least_times(part, particles, pairs, ceilings, least);
    for (int k = 0; k < MICRO_LIMIT_COUNT; k++)
        figure.limit = least[k] > least[figure.limit] ? (MicroLimit)k : figure.limit;
    figure.share = least[figure.limit] / seconds;
    return figure;
}

/* Runs all parts in the order of a substep; keeps the least time of each. */
static void run_round(World *world, const MicroPart *parts, int count, double ms[MICRO_PARTS_MAX])
{
    for (int k = 0; k < count; k++) {
        const double began = wall_ms();
        world_micro_run(world, &parts[k]);
        ms[k] = fmin(ms[k], wall_ms() - began);
    }
}

static int run_rounds(World *world, int rounds, const MicroPart *parts, int count, double ms[MICRO_PARTS_MAX])
{
    double unused[MICRO_PARTS_MAX] = {0};
    int done = 0;
    run_round(world, parts, count, unused);
    for (int k = 0; k < count; k++)
        ms[k] = HUGE_VAL;
    for (const double began = wall_ms(); !interrupted() && done < (rounds ? rounds : ROUNDS_MOST); done++) {
        if (!rounds && done >= ROUNDS_LEAST && wall_ms() - began > enough_ms)
            break;
        run_round(world, parts, count, ms);
    }
    return done;
}

static bool measure_state(const MicroSetup *setup, World *world, double asked, const Ceilings *ceilings,
                          MicroResult *result, Error *error)
{
    WorldInfo info;
    WorldSums sums;
    MicroPart parts[MICRO_PARTS_MAX];
    double ms[MICRO_PARTS_MAX];
    world_info(world, &info);
    *result = (MicroResult){.threads = info.threads,
                            .particles = info.count,
                            .time = info.time,
                            .asked = asked,
                            .count = world_micro_parts(world, parts)};
    snprintf(result->scene, sizeof result->scene, "%s", setup->scene->path);
    snprintf(result->method, sizeof result->method, "%s", setup->scene->world.method);
    result->rounds = run_rounds(world, setup->rounds, parts, result->count, ms);
    if (result->rounds == 0)
        return error_set(error, "stopped before a round was measured");
    if (!world_micro_sound(world))
        return error_set(error, "no memory for lists of neighbours; use fewer particles");
    world_sums(world, &sums);
    result->neighbours_mean = sums.neighbours_mean;
    for (int k = 0; k < result->count; k++) {
        result->least_ms += (1 + ROUNDS_LEAST) * ms[k];
        result->figures[k] = figure_of(&parts[k], (double)info.count,
                                       (double)info.count * sums.neighbours_mean, ms[k], ceilings);
    }
    return true;
}

/* Steps until `from`, or until the wall time limit. Returns false if the simulation failed. */
static bool advance(World *world, double from, double until_ms, Error *error)
{
    WorldInfo info;
    for (world_info(world, &info); info.time < from && wall_ms() < until_ms && !interrupted();
         world_info(world, &info))
        if (!world_step(world, NULL, error))
            return false;
    return true;
}

static bool ceilings_ready(const World *world, Ceilings *ceilings, Error *error)
{
    MicroPart parts[MICRO_PARTS_MAX];
    if (world_micro_parts(world, parts) == 0)
        return error_set(error, "the passes of this backend cannot be run alone");
    return ceilings->copies > 0 || world_micro_ceilings(world, ceilings) ||
           error_set(error, "no memory for the copy that the passes are held against");
}

bool micro_measure(const MicroSetup *setup, Ceilings *ceilings, MicroResult results[2], int *count,
                   Error *error)
{
    *count = 0;
    const double began = wall_ms();
    World *world = world_create(&setup->scene->world, error);
    const double made = wall_ms() - began;
    bool ok = world && ceilings_ready(world, ceilings, error);
    const double until = wall_ms() + 1e3 * setup->seconds;
    ok = ok && measure_state(setup, world, 0, ceilings, &results[0], error);
    *count += ok;
    results[0].least_ms += made;
    if (ok && setup->from > 0) {
        ok = advance(world, setup->from, until, error) &&
             measure_state(setup, world, setup->from, ceilings, &results[1], error);
        *count += ok;
    }
    world_destroy(world);
    return ok;
}
