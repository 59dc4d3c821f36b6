#include "app/lab/stability.h"
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/bench/gnuplot.h"
#include "app/cli/cli_private.h"

#include <string.h>

static bool check_outputs(const StablePlan *plan, StableRows *rows, Error *error)
{
    const Args *args = plan->args;
    return gnuplot_check(args->output, error) && output_check(args->output, error) &&
           output_check(plan->csv, error) && (!args->json || json_file_check(args->json, error)) &&
           stable_rows_read(rows, plan->csv, stderr, error);
}

/* Reports facts known before any trial. */
static void say_plan(const StablePlan *plan, const StableRows *rows)
{
    const int cells = stable_cells(plan);
    notes_print(&plan->notes, stderr);
    if (plan->args->quiet)
        return;
    fprintf(stderr,
            "%d cell%s of %.3g s each; steps of mode fixed, each a frame; the first trouble ends a trial\n",
            cells, plural((size_t)cells), plan->time);
    if (rows->count > 0)
        fprintf(stderr, "%zu trial%s in %s already\n", rows->count, rows->count == 1 ? " is" : "s are",
                plan->csv);
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

static bool finish(const StablePlan *plan, const StableRows *rows, bool *told, Error *error)
{
    StableMap map;
    const Args *args = plan->args;
    if (!stable_map_make(plan, rows, &map, error))
        return false;
    if (!args->quiet)
        stable_print(&map, stdout);
    bool ok = say_findings(&map, error) && stable_draw(&map, args->output, error);
    if (args->json) {
        Error none;
        *told = true;
        const bool written = stable_write_json(&map, ok ? NULL : error->message, args->json, &none);
        if (ok && !written)
            *error = none;
        ok = ok && written;
    }
    stable_map_free(&map);
    return ok;
}

static int stability(const StablePlan *plan, StableRows *rows)
{
    Error error = {{0}}, none;
    bool told = false;
    bool ok = check_outputs(plan, rows, &error);
    if (ok)
        say_plan(plan, rows);
    ok = ok && stable_run(plan, rows, &error) && finish(plan, rows, &told, &error);
    if (interrupted())
        error_set(&error, "stopped after %zu trials; the same command goes on", rows->count);
    else if (ok)
        return 0;
    fprintf(stderr, "%s\n", error.message);
    if (plan->args->json && !told && json_file_check(plan->args->json, &none))
        failure_json_write(failure_json("stability", "scene", plan->scene_name, plan->args->output, &error),
                           plan->args->json);
    return interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED;
}

int cmd_stability(const Args *args)
{
    static StablePlan plan;
    StableRows rows = {.count = 0};
    Error error = {{0}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (stable_plan_make(args, &plan, &error))
        code = stability(&plan, &rows);
    else
        fprintf(stderr, "%s\n", error.message);
    stable_rows_free(&rows);
    return code;
}
