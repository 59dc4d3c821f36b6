#include "app/command/bench_ablate.h"

#include "app/ablate/ablate_report.h"
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/run/offscreen.h"

#include <stdlib.h>
#include <string.h>

static const double DEFAULT_TIME = 2; /* s */

static bool names_view(const SceneSettings *settings)
{
    bool named = false;
    for (int i = 0; i < settings->count; i++)
        named |= settings->said[i] && strncmp(settings->said[i], "--view ", strlen("--view ")) == 0;
    return named;
}

/* Names an option without effect, or NULL. */
static const char *has_no_place(const Args *args)
{
    return args->table                   ? "--table"
           : args->play                  ? "--play"
           : args->micro                 ? "--micro"
           : args->device                ? "--device"
           : args->sweep_count > 0       ? "--sweep"
           : args->frames > 0            ? "--frames"
           : args->clock                 ? "--clock"
           : args->size_given            ? "--size"
           : args->seconds_given         ? "--seconds"
           : names_view(&args->settings) ? "--view"
                                         : NULL;
}

/* Reads all scenes before the first run. */
static bool scenes_check(const Plan *plan, bool *context, Error *error)
{
    static Scene scene;
    const Args *args = plan->args;
    *context = false;
    const char *other = has_no_place(args);
    if (other)
        return error_set(error, "slosh bench: --ablate stands alone; leave %s out", other);
    if (args->time_given && !(args->time > 0))
        return error_set(error, "slosh bench: --ablate needs a --time of more than 0");
    for (size_t i = 0; i < plan_cases(plan); i++) {
        if (!plan_case_load(plan, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        *context |= world_on_gpu(&scene.world);
    }
    return true;
}

/* Returns false if a scene fails; the following scenes still run. */
static bool ablate_all(const Plan *plan, const Headless *context, Ablation *ablations, size_t *done)
{
    const Args *args = plan->args;
    bool ok = true;
    for (*done = 0; *done < plan_cases(plan) && !interrupted(); (*done)++) {
        Ablation *one = &ablations[*done];
        Error error = {{0}};
        const AblateSetup setup = {.scene = plan->scenes[*done],
                                   .settings = &plan->settings,
                                   .time = args->time_given ? args->time : DEFAULT_TIME,
                                   .quiet = args->quiet};
        if (!ablate(&setup, one, &error)) {
            fprintf(stderr, "%s\n", error.message);
            ok = false;
        }
        snprintf(one->renderer, sizeof one->renderer, "%s", context ? headless_renderer(context) : "");
        if (!args->quiet)
            ablate_print(one, stdout);
    }
    return ok;
}

int bench_ablate(const Plan *plan)
{
    Error error = {{0}};
    const Args *args = plan->args;
    bool wants_context;
    size_t done = 0;
    if (!scenes_check(plan, &wants_context, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    Headless *context = NULL;
    Ablation *ablations = calloc(plan_cases(plan), sizeof *ablations);
    bool ok = ablations ? !args->json || json_file_check(args->json, &error)
                        : error_set(&error, "no memory for the results");
    ok = ok && (!wants_context || (context = headless_create(args->gpu, &error)));
    if (context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    const bool ran = ok && ablate_all(plan, context, ablations, &done);
    ok = ok && (!args->json || done == 0 || ablate_write_json(ablations, done, args->json, &error));
    headless_destroy(context);
    free(ablations);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : ok && ran ? 0 : EXIT_FAILED;
}
