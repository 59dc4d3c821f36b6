/* An experiment in one file: the energy of motion that is left after --time, at three spacings. It adds its
   command to the list. */
#ifndef SLOSH_TESTS_TOY_EXPERIMENT_H
#define SLOSH_TESTS_TOY_EXPERIMENT_H

#include "app/bench/plot.h"
#include "app/cli/cli.h"
#include "app/cli/option_rows.h"
#include "app/lab/experiment.h"
#include "sim/world.h"

typedef struct CalmRow {
    uint64_t key;
    double spacing, energy; /* m, J */
} CalmRow;

static const TrialColumn calm_columns[] = {
    {"spacing_m", CELL_NUMBER, CELL(CalmRow, spacing), .flags = CELL_OPEN, .digits = 9},
    {"energy_j", CELL_NUMBER, CELL(CalmRow, energy), .digits = 9},
    {NULL},
};

static const TrialTable calm_table = {
    .who = "slosh calm",
    .result = "chart",
    .trial = "run",
    .head = "key,spacing_m,energy_j\n",
    .opening = "key,spacing_m,",
    .row_size = sizeof(CalmRow),
    .columns = calm_columns,
};

static bool calm_plan(ExperimentRun *run, Error *error)
{
    run->wanted = 3;
    return experiment_name_files(run, error);
}

static bool calm_prepare(ExperimentRun *run, int i, void *of, Error *error)
{
    static const char *const spacings[] = {"particles.spacing=0.2", "particles.spacing=0.15",
                                           "particles.spacing=0.1"};
    Scene *scene = run->state;
    CalmRow *row = of;
    SceneSettings settings = run->args->settings;
    char time[32];
    settings.set[settings.count++] = spacings[i];
    snprintf(time, sizeof time, "%g", run->args->time);
    row->key = run_key_text(RUN_KEY, time);
    if (!scene_load(run->args->scenes[0], &settings, scene, NULL, error))
        return false;
    row->spacing = scene->world.spacing;
    return run_key_scene(scene, false, &row->key, error);
}

static bool calm_make(ExperimentRun *run, int i, void *of, const ProgressPart *part, Error *error)
{
    CalmRow *row = of, inputs;
    const Scene *scene = run->state;
    WorldInfo info = {.time = 0};
    WorldSums sums;
    World *world = calm_prepare(run, i, &inputs, error) ? world_create(&scene->world, error) : NULL;
    bool ok = world != NULL;
    while (ok && info.time < run->args->time && !interrupted()) {
        ok = world_step(world, NULL, error);
        world_info(world, &info);
        progress_part_update(part, info.time / run->args->time);
    }
    if (ok) {
        world_sums(world, &sums);
        row->energy = sums.kinetic_energy;
    }
    world_destroy(world);
    return ok && !interrupted();
}

static bool calm_report(ExperimentRun *run, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    run->has_figures = true;
    if (!plot_begin(&plot, run->output, 640, 400, error))
        return false;
    plot_set(&plot, "xlabel", "spacing, m", "");
    plot_set(&plot, "ylabel", "energy of motion, J", "");
    plot_series(&plot, run->args->scenes[0], "with linespoints pt 7");
    for (int i = 0; i < run->rows.count; i++) {
        const CalmRow *row = trials_row(&run->rows, i);
        plot_point(&plot, row->spacing, row->energy);
        if (!run->args->quiet)
            printf("%8.4g m %12.4g J\n", row->spacing, row->energy);
    }
    plot_draw(&plot, NULL);
    return plot_end(&plot, error);
}

static json_t *calm_json(const ExperimentRun *run, const char *failure)
{
    json_t *runs = json_array();
    for (int i = 0; i < run->rows.count; i++) {
        const CalmRow *row = trials_row(&run->rows, i);
        json_array_append_new(runs, json_pack("{s:f, s:f}", "spacing", row->spacing, "energy", row->energy));
    }
    return json_pack("{s:s, s:o, s:s*}", "calm", run->args->scenes[0], "runs", runs, "error", failure);
}

static const Experiment calm_experiment = {
    .table = &calm_table,
    .size = sizeof(Scene),
    .plan = calm_plan,
    .prepare = calm_prepare,
    .make = calm_make,
    .report = calm_report,
    .json = calm_json,
};

static int calm_run(const Args *args)
{
    return experiment_run(&calm_experiment, args);
}

/* clang-format off */
static const OptionRow calm_options[] = {
    ROW_OUTPUT("OUT", .files = files_chart, .help = "the chart, OUT.svg or OUT.png; its figures in OUT.csv"),
    ROW_TIME(1, "simulated seconds (1)"), ROWS_SCENE, ROW_JSON, ROWS_END,
};
/* clang-format on */

static const Command command_calm = {
    .name = "calm",
    .usage = "SCENE -o OUT.svg|.png [OPTIONS]",
    .help = "how fast a fluid comes to rest, by its spacing",
    .takes = "scene",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.svg or OUT.png",
    .argument_files = files_scene,
    .options = calm_options,
    .run = calm_run,
};

static inline void toy_experiment_add(void)
{
    command_add(&command_calm);
}

#endif
