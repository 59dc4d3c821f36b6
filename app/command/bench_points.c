#include "app/command/bench_points.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/lab/points_bench.h"

enum { USUAL_POINTS = 4000000, USUAL_FRAMES = 5 };

static bool render(const Plan *plan, PointsFigures *figures, Error *error)
{
    const Args *args = plan->args;
    Plan alone = *plan; /* --particles is for the points */
    Scene scene;
    Progress progress;
    alone.settings.particles = 0;
    if (!plan_case_load(&alone, 0, false, &scene, error))
        return false;
    Headless *context = headless_create(args->gpu, error);
    if (!context)
        return false;
    const BenchSetup setup = {.scene = &scene,
                              .context = context,
                              .draws = true,
                              .width = args->width,
                              .height = args->height,
                              .frames = args->frames ? args->frames : USUAL_FRAMES,
                              .clock = GL_CLOCK_AUTO};
    progress_begin(&progress, stderr, "bench", args->quiet);
    const bool ok = bench_measure(&setup, &progress, 0, 1, &figures->rendering);
    progress_end(&progress);
    headless_destroy(context);
    return ok || error_set(error, "%s", figures->rendering.failure.message);
}

static bool measure(const Plan *plan, Error *error)
{
    const Args *args = plan->args;
    static PointsFigures figures;
    static Reference reference;
    const size_t asked = plan->settings.particles;
    if ((args->json && !json_file_check(args->json, error)) ||
        !reference_load(plan->table->reference, &reference, error) ||
        !points_sampling((double)(asked ? asked : USUAL_POINTS), &figures, error) ||
        !render(plan, &figures, error))
        return false;
    if (!(points_shown(&figures.rendering) > 0))
        return error_set(error, "slosh bench: no point of %s was shown, or memory was short to count them",
                         figures.rendering.scene);
    if (!args->quiet)
        points_print(&figures, &reference, stdout);
    return !args->json || points_write_json(&figures, args->json, error);
}

int bench_points(const Plan *plan)
{
    Error error = {{0}};
    if (plan->args->output) {
        fprintf(stderr, "slosh bench: the table %s has no chart; leave -o out\n", plan->table->name);
        return EXIT_USAGE;
    }
    if (measure(plan, &error))
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED;
}
