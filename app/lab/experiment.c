#include "app/lab/experiment.h"

#include "app/base/file.h"
#include "app/bench/plot.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool experiment_name_files(ExperimentRun *run, Error *error)
{
    if (!plot_table_name(run->args->output, run->csv, error))
        return false;
    snprintf(run->output, sizeof run->output, "%s", run->args->output);
    return true;
}

bool experiment_context(ExperimentRun *run, Error *error)
{
    if (!run->context && !(run->context = headless_create(run->args->gpu, error)))
        return false;
    if (!run->context_named)
        renderer_tell(headless_renderer(run->context));
    run->context_named = true;
    return true;
}

/* ---- settings ---- */

bool run_settings_add(RunSettings *settings, Error *error, const char *format, ...)
{
    va_list arguments;
    char *text = settings->texts[settings->used];
    if (settings->used == RUN_TEXTS)
        return error_set(error, "more than %d settings of a run; sweep less at a time", RUN_TEXTS);
    va_start(arguments, format);
    const bool whole = vsnprintf(text, RUN_TEXT_SIZE, format, arguments) < RUN_TEXT_SIZE;
    va_end(arguments);
    settings->used++;
    const bool named = strncmp(text, "--", 2) == 0;
    return (whole || error_set(error, "the setting %.60s is too long; write it into a scene file", text)) &&
           scene_settings_add(&settings->all, named ? text : NULL, named ? strchr(text, ' ') + 1 : text,
                              error);
}

const char *key_last_part(const char *path)
{
    const char *last = path;
    for (const char *at = path; *at && *at != '='; at++)
        last = *at == '.' ? at + 1 : last;
    return last;
}

bool key_has_effect(const Scene *scene, const char *path, char why[NOTE_SIZE])
{
    Notes notes = {.count = 0};
    scene_advise_key(scene, path, &notes);
    snprintf(why, NOTE_SIZE, "%s", notes.count > 0 ? notes.line[0] : "");
    return notes.count == 0;
}

/* ---- the trials of a plan ---- */

static bool take(const Experiment *of, void *row, const void *older)
{
    if (of->take)
        return of->take(row, older);
    memcpy(row, older, of->table->row_size);
    return true;
}

/* `row`: room for one. */
static bool prepare_all(ExperimentRun *run, void *row, bool made[], Error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < run->wanted; i++) {
        ok = run->of->prepare(run, i, row, error) &&
             (trials_append(&run->rows, row) || error_set(error, "no memory for the rows"));
        const void *older = ok ? trials_find(&run->file, run->rows.keys[i]) : NULL;
        made[i] = older && take(run->of, trials_row(&run->rows, i), older);
        run->there += made[i];
    }
    return ok;
}

/* Shares of the work to do: done before a trial, and the trial itself. */
static ProgressPart part_of(const ExperimentRun *run, const bool made[], int trial, Progress *progress)
{
    ProgressPart part = {.progress = progress};
    double all = 0;
    for (int i = 0; i < run->wanted; i++) {
        const double seconds = made[i] ? 0 : run->of->seconds ? run->of->seconds(run, i) : 1;
        all += seconds;
        part.done += i < trial ? seconds : 0;
        part.part += i == trial ? seconds : 0;
    }
    part.done /= all;
    part.part /= all;
    return part;
}

static bool make_all(ExperimentRun *run, const bool made[], Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, run->args->command->name, run->args->quiet);
    for (int i = 0; ok && i < run->wanted && !interrupted(); i++) {
        void *row = trials_row(&run->rows, i);
        const ProgressPart part = part_of(run, made, i, &progress);
        if (made[i])
            continue;
        ok = run->of->make(run, i, row, &part, error) && experiment_keep(run, row, error);
        run->there += ok;
        progress_part_update(&part, 1);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

static bool run_plan(ExperimentRun *run, void *row, bool made[], Error *error)
{
    if (!prepare_all(run, row, made, error))
        return false;
    if (!run->args->quiet && run->there > 0)
        fprintf(stderr, "%d of %d %ss %s in %s already\n", run->there, run->wanted, run->of->table->trial,
                run->there == 1 ? "is" : "are", run->csv);
    return make_all(run, made, error);
}

bool experiment_trials(ExperimentRun *run, Error *error)
{
    bool *made = calloc((size_t)run->wanted + 1, sizeof *made), ok = false;
    void *row = calloc(1, run->of->table->row_size);
    if (made && row)
        ok = run_plan(run, row, made, error);
    else
        error_set(error, "no memory for the rows");
    free(row);
    free(made);
    return ok;
}

bool experiment_keep(ExperimentRun *run, const void *row, Error *error)
{
    const TrialTable *table = run->of->table;
    if (table->possible && !table->possible(row))
        return true;
    return (trials_add(&run->file, row, &run->rows) || error_set(error, "no memory for the rows")) &&
           trials_keep(&run->file, run->csv, &run->rows, error);
}

/* ---- from start to end ---- */

static bool check_files(ExperimentRun *run, Error *error)
{
    const Args *args = run->args;
    const bool ok = run->of->check ? run->of->check(run, error)
                                   : plot_check(run->output, error) && output_check(run->output, error);
    return ok && output_check(run->csv, error) && (!args->json || json_file_check(args->json, error)) &&
           trials_read(&run->file, run->csv, stderr, error);
}

/* Writes the figures, or the failure alone. Returns false with the reason. */
static bool write_json(const ExperimentRun *run, const char *failure, Error *error)
{
    const Args *args = run->args;
    json_t *json = run->has_figures
                       ? run->of->json(run, failure)
                       : json_pack("{s:s, s:s, s:s*, s:s}", "command", args->command->name, "scene",
                                   args->scenes[0], "output", run->output, "error", failure);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static int execute(ExperimentRun *run, Error *error)
{
    const char *json = run->args->json, *trial = run->of->table->trial;
    Error none;
    bool ok = check_files(run, error) && (run->of->run ? run->of->run : experiment_trials)(run, error) &&
              !interrupted() && run->of->report(run, error);
    if (interrupted()) {
        ok = run->has_figures = false;
        if (run->wanted > 0)
            error_set(error, "stopped after %d of %d %ss; the same command goes on", run->there, run->wanted,
                      trial);
        else
            error_set(error, "stopped after %d %ss; the same command goes on", run->there, trial);
    }
    if (!ok)
        fprintf(stderr, "%s\n", error->message);
    if (json && (ok || json_file_check(json, &none)) && !write_json(run, ok ? NULL : error->message, &none)) {
        fprintf(stderr, "%s\n", none.message);
        ok = false;
    }
    return interrupted() ? EXIT_INTERRUPTED : ok ? 0 : EXIT_FAILED;
}

int experiment_run(const Experiment *experiment, const Args *args)
{
    Error error = {{0}};
    ExperimentRun run = {.of = experiment,
                         .args = args,
                         .state = calloc(1, experiment->size),
                         .file = {.table = experiment->table},
                         .rows = {.table = experiment->table}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (run.state && experiment->plan(&run, &error))
        code = execute(&run, &error);
    else
        fprintf(stderr, "%s\n", run.state ? error.message : "no memory for the plan");
    if (run.state && experiment->close)
        experiment->close(&run);
    headless_destroy(run.context);
    trials_free(&run.file);
    trials_free(&run.rows);
    free(run.state);
    return code;
}
