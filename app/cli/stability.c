#include "app/lab/stability.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"

#include <string.h>

typedef struct StabilityState {
    StablePlan plan;
    StableMap map;
} StabilityState;

static bool stability_plan(ExperimentRun *run, Error *error)
{
    StabilityState *state = run->state;
    return experiment_name_files(run, error) && stable_plan_make(run->args, &state->plan, error);
}

/* Reports facts known before any trial. */
static void say_plan(const ExperimentRun *run, const StablePlan *plan)
{
    const int cells = stable_cells(plan), there = run->file.count;
    notes_print(&plan->notes, stderr);
    if (run->args->quiet)
        return;
    fprintf(stderr,
            "%d cell%s of %.3g s each; steps of mode fixed, each a frame; the first trouble ends a trial\n",
            cells, plural((size_t)cells), plan->time);
    if (there > 0)
        fprintf(stderr, "%d trial%s in %s already\n", there, there == 1 ? " is" : "s are", run->csv);
}

static bool stability_run(ExperimentRun *run, Error *error)
{
    const StabilityState *state = run->state;
    say_plan(run, &state->plan);
    const bool ok = stable_run(&state->plan, &run->file, run->csv, error);
    run->there = run->file.count;
    return ok;
}

/* Reports findings not visible in the map. */
static bool say_findings(const StableMap *map, Error *error)
{
    const StablePlan *plan = map->plan;
    const int idle = stable_idle_axis(map);
    int searched = 0, never = 0, always = 0;
    for (int s = 0; s < plan->series_count; s++) {
        const StableSpread spread = stable_spread(map, s);
        searched += spread.cells;
        never += spread.never;
        always += spread.always;
    }
    if (searched == 0)
        return error_set(error, "no cell could be searched: %.300s", map->found[0].why);
    if (never == searched)
        fprintf(
            stderr,
            "no step holds in any cell, whatever the axes are: what is wrong is not the step; the table says what it is\n");
    else if (always == searched)
        fprintf(
            stderr,
            "every step that was tried holds, up to an eighth of --time, whatever the axes are: a longer one would find a limit\n");
    else if (idle >= 0)
        fprintf(stderr, "--axis %s changes nothing: all cells along it have the same step\n",
                plan->axis[idle].key);
    return true;
}

static bool stability_report(ExperimentRun *run, Error *error)
{
    StabilityState *state = run->state;
    if (!stable_map_make(&state->plan, &run->file, &state->map, error))
        return false;
    run->has_figures = true;
    if (!run->args->quiet)
        stable_print(&state->map, stdout);
    return say_findings(&state->map, error) && stable_draw(&state->map, run->output, error);
}

static json_t *stability_json(const ExperimentRun *run, const char *failure)
{
    const StabilityState *state = run->state;
    return stable_json(&state->map, failure);
}

static void stability_close(ExperimentRun *run)
{
    StabilityState *state = run->state;
    stable_map_free(&state->map);
}

static const Experiment experiment = {
    .table = &stable_table,
    .size = sizeof(StabilityState),
    .plan = stability_plan,
    .run = stability_run,
    .report = stability_report,
    .json = stability_json,
    .close = stability_close,
};

static int run_command(const Args *args)
{
    return experiment_run(&experiment, args);
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("OUT", .files = files_chart, .help = "the map, OUT.svg or OUT.png; its trials in OUT.csv, which a later run goes on with"),
    {"--axis", "KEY=a:b", OPTION_LIST, OWN(StabilityOptions, axes), .help = "a key of the scene from a to b, at 8 values or, as a:b:n, at n; by factors where that is a decade and more; twice for a map (sound speed and viscosity around the scene's)"},
    ROW_TIME(0, "simulated seconds of a trial (four times what a fall from the top takes)"),
    {"--sweep", "KEY=A,B,...", OPTION_SWEEP, AT(sweeps), .help = "method=... or backend=...: a map each, in place of the scene's own"},
    ROWS_SCENE, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROW_DEVICE_REFUSED("what is compared moves as the scene says, and no other way"),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_stability = {
    .name = "stability",
    .usage = "SCENE -o OUT.svg|.png [OPTIONS]",
    .help = "where methods hold and how they fail: the largest step over two keys of a scene",
    .takes = "scene",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.svg or OUT.png",
    .own_size = sizeof(StabilityOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
