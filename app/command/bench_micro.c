#include "app/command/bench_micro.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/lab/micro.h"
#include "sim/matter/seed.h"

#include <stdlib.h>
#include <string.h>

typedef struct Micro {
    const Plan *plan;
    Ceilings ceilings;
    MicroResult *results;
    size_t count;
    double ms_a_particle; /* least time of the last case, ms per particle */
    bool broke;           /* a simulation broke before --time */
} Micro;

/* Reads all cases before the first run, with few particles: too many particles are no mistake of the command
   line. */
static bool cases_check(const Plan *plan, Error *error)
{
    static Plan few;
    few = *plan;
    for (int i = 0; i < few.sweep_count; i++)
        for (int k = 0; strcmp(few.sweeps[i].key, "particles") == 0 && k < few.sweeps[i].count; k++)
            few.sweeps[i].values[k] = few.sweeps[i].values[0];
    for (size_t i = 0; i < plan_cases(&few); i++) {
        Scene scene;
        if (!plan_case_load(&few, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        if (world_on_gpu(&scene.world))
            return error_set(error, "slosh bench: --micro measures the backend cpu; leave %s out",
                             scene.world.backend);
    }
    return true;
}

static void leave_out(Micro *micro, size_t index, const char *why)
{
    MicroResult *result = &micro->results[micro->count++];
    snprintf(result->scene, sizeof result->scene, "%s",
             micro->plan->scenes[index / micro->plan->combinations]);
    plan_case_name(micro->plan, index, result->swept, sizeof result->swept);
    snprintf(result->left_out, sizeof result->left_out, "%.500s", why);
    if (!micro->plan->args->quiet)
        micro_print(result, stdout);
}

static double particles_of(const Scene *scene)
{
    size_t counts[FLUIDS_MAX], all = 0;
    seed_counts(&scene->world, counts);
    for (int f = 0; f < scene->world.fluid_count; f++)
        all += counts[f];
    return (double)all;
}

/* True if the case may be tried, judged by the time of the last case. */
static bool within_limits(Micro *micro, size_t index, Scene *scene)
{
    Error error;
    char why[256];
    if (!plan_case_load(micro->plan, index, true, scene, &error)) {
        leave_out(micro, index, error.message);
        return false;
    }
    const double limit = micro->plan->args->seconds,
                 expected = 1e-3 * micro->ms_a_particle * particles_of(scene);
    if (expected <= limit)
        return true;
    snprintf(why, sizeof why, "by the last case it would take %.3g s; use --seconds %.3g", expected,
             2 * expected);
    leave_out(micro, index, why);
    return false;
}

/* Measures a case; skips a world that exceeds memory, and a state that the simulation did not reach. */
static void measure_case(Micro *micro, size_t index, const Scene *scene)
{
    Error error;
    const Args *args = micro->plan->args;
    const MicroSetup setup = {.scene = scene,
                              .rounds = args->frames,
                              .seconds = args->seconds,
                              .from = args->time_given ? args->time : 0};
    int found;
    MicroResult *results = &micro->results[micro->count];
    const bool first = micro->ceilings.copies == 0;
    const bool ok = micro_measure(&setup, &micro->ceilings, results, &found, &error);
    if (first && found > 0 && !args->quiet)
        micro_print_ceilings(&micro->ceilings, results[0].threads, stdout);
    for (int k = 0; k < found; k++) {
        plan_case_name(micro->plan, index, results[k].swept, sizeof results[k].swept);
        if (!args->quiet)
            micro_print(&results[k], stdout);
    }
    micro->count += (size_t)found;
    if (found > 0 && results[0].particles > 0)
        micro->ms_a_particle = results[0].least_ms / (double)results[0].particles;
    if (ok || interrupted())
        return;
    micro->broke |= found > 0;
    leave_out(micro, index, error.message);
}

static void measure_all(Micro *micro)
{
    for (size_t i = 0; i < plan_cases(micro->plan) && !interrupted(); i++) {
        Scene scene;
        if (within_limits(micro, i, &scene))
            measure_case(micro, i, &scene);
    }
}

int bench_micro(const Plan *plan)
{
    Error error = {{0}};
    const Args *args = plan->args;
    Micro micro = {.plan = plan};
    if (!cases_check(plan, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    micro.results = calloc(2 * plan_cases(plan), sizeof *micro.results);
    if (!micro.results) {
        fprintf(stderr, "no memory for the results\n");
        return EXIT_FAILED;
    }
    bool ok = !args->json || json_file_check(args->json, &error);
    if (ok)
        measure_all(&micro);
    if (ok && args->json && micro.count > 0)
        ok = micro_write_json(micro.results, micro.count, &micro.ceilings, args->json, &error);
    free(micro.results);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : ok && !micro.broke ? 0 : EXIT_FAILED;
}
