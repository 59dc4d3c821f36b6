#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/lab/error_chart.h"
#include "app/run/measure/measure.h"
#include "sim/step/method.h"
#include "sim/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOOK_EVERY = 4 }; /* samples; a look costs as much as a few steps */

/* Adds the job's swept settings; row's swept text gets the last parts of the keys. */
static bool add_swept(RunSettings *job, const ChartJob *of, ChartRow *row, Error *error)
{
    size_t used = 0;
    for (int i = 0; i < of->set_count; i++) {
        const char *setting = of->set[i] + strlen("--sweep ");
        if (!run_settings_add(job, error, "%s", of->set[i]))
            return false;
        if (of->step_unnamed && strncmp(setting, "solver.step.", strlen("solver.step.")) == 0)
            continue;
        used += (size_t)snprintf(row->swept + used, CHART_SWEPT - used, "%s%s", used > 0 ? " " : "",
                                 key_last_part(setting));
        if (used >= CHART_SWEPT)
            return error_set(error, "the swept values have more than %d letters; sweep less at a time",
                             CHART_SWEPT - 1);
    }
    return true;
}

static bool load(const ChartSubject *subject, const ChartJob *job, RunSettings *settings, Scene *scene,
                 Notes *notes, Error *error)
{
    if (!subject->of)
        return scene_load(subject->scene, &settings->all, scene, notes, error);
    const CaseSetup setup = {.of = subject->of,
                             .level = CASE_DEFAULT,
                             .method = job->method,
                             .settings = &settings->all,
                             .notes = notes};
    return case_scene(&setup, scene, error);
}

/* Adds the job's spacing, adjusted to whole layers in the fills. */
static bool add_spacing(const ChartSubject *subject, const ChartJob *job, RunSettings *settings, Scene *scene,
                        ChartRow *row, Error *error)
{
    if (!run_settings_add(settings, error, "particles.spacing=%.9g", row->spacing) ||
        !load(subject, job, settings, scene, NULL, error))
        return false;
    row->spacing = scene->world.spacing;
    snprintf(settings->texts[settings->used - 1], RUN_TEXT_SIZE, "particles.spacing=%.9g", row->spacing);
    return true;
}

/* Loads the scene twice: first unchanged, to know its spacing and step; then with the job's spacing and
   step. A step of mode fixed shrinks with the spacing. */
bool chart_settings(const ChartSubject *subject, const ChartJob *job, RunSettings *settings, Scene *scene,
                    ChartRow *row, Error *error)
{
    *settings = (RunSettings){.all = *subject->settings};
    bool ok = run_settings_add(settings, error, "solver.method=%s", job->method) &&
              run_settings_add(settings, error, "solver.backend=%s", job->backend) &&
              add_swept(settings, job, row, error) && load(subject, job, settings, scene, NULL, error);
    if (!ok)
        return false;
    const WorldDef *def = &scene->world;
    row->spacing = def->spacing * job->coarsening;
    const bool follows = settings->all.particles > 0; /* the step followed the spacing, in this load only */
    settings->all.particles = 0;
    if (def->step_mode == STEP_CFL) {
        const double number = def->cfl_number / (1 << job->fineness);
        snprintf(row->step, NAME_SIZE, "number %.3g", number);
        ok = ok && run_settings_add(settings, error, "solver.step.number=%.9g", number);
        if (method_find(def->method)->incompressible) /* max_dt bounds the step of a slow fluid */
            ok = ok && run_settings_add(settings, error, "solver.step.max_dt=%.9g",
                                        def->max_dt * sqrt(job->coarsening) / (1 << job->fineness));
    } else {
        const int substeps = (int)ceil(def->substeps * (1 << job->fineness) / job->coarsening - 1e-6);
        snprintf(row->step, NAME_SIZE, "%.3g ms", 1000 * def->dt / substeps);
        ok = ok && run_settings_add(settings, error, "solver.step.substeps=%d", substeps) &&
             (!follows || run_settings_add(settings, error, "solver.step.dt=%.9g", def->dt));
    }
    return ok &&
           (job->jitter == 0 ||
            run_settings_add(settings, error, "particles.jitter=%.9g", def->jitter + job->jitter)) &&
           add_spacing(subject, job, settings, scene, row, error);
}

bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Notes *notes, Error *error)
{
    RunSettings settings;
    char rest[128];
    *row = (ChartRow){.role = job->role,
                      .fineness = job->fineness,
                      .seconds = (double)NAN,
                      .error = (double)NAN,
                      .key = RUN_KEY};
    if (!chart_settings(subject, job, &settings, scene, row, error) ||
        !load(subject, job, &settings, scene, notes, error) || !world_can(&scene->world, error))
        return false;
    snprintf(row->method, NAME_SIZE, "%s", scene->world.method);
    snprintf(row->backend, NAME_SIZE, "%s", scene->world.backend);
    snprintf(rest, sizeof rest, "%d %.9g", (int)job->role, subject->time);
    const char *name = subject->of ? subject->of->name : "";
    row->key = run_key_text(run_key_text(row->key, rest), name);
    return run_key_scene(scene, false, &row->key, error);
}

/* The run of a scene over time. */
typedef struct SceneRun {
    const Scene *scene;
    World *world;
    MetricState state;
    Probes *probes;    /* NULL: no metric needs probes */
    float *read;       /* one number per column */
    bool wants_forces; /* true: a probe measures force, into `forces` */
    Forces forces;     /* summed since the last sample */
    WorldInfo info;
    double before[CHART_QUANTITIES], now[CHART_QUANTITIES]; /* at `before_time` and at present, s */
    double before_time;
    double spent;  /* computing time, s */
    Error failure; /* why the run broke */
    OutcomeHistory history;
} SceneRun;

/* Reads the first number of each probe. */
static void read_probes(SceneRun *run)
{
    const ProbeList *list = &run->scene->probes;
    const float *at = run->read;
    Forces forces = {0};
    if (!run->probes)
        return;
    if (run->wants_forces)
        world_forces(run->world, &forces);
    forces_add_mean(&run->forces, &forces);
    forces = run->forces;
    forces_mean(&forces);
    probes_read(run->probes, &run->state.cloud, &forces, run->read);
    run->state.probe_count = list->count;
    for (int k = 0; k < list->count; at += probe_columns(&list->probe[k]), k++)
        run->state.probe[k] = (double)*at;
}

/* Returns false if memory is short. `failure` is set if the backend cannot sum forces. */
static bool start_probes(SceneRun *run)
{
    const Scene *scene = run->scene;
    bool asked = false;
    for (int m = 0; m < scene->metric_count; m++)
        asked |= metric_kinds[scene->metrics[m]].numbers == 0;
    if (!asked)
        return true;
    run->wants_forces =
        probe_list_has_forces(&scene->probes) && world_enable_forces(run->world, &run->failure);
    run->probes = probes_create(&scene->probes, &scene->world);
    if (run->probes)
        run->read = malloc(((size_t)probes_columns(run->probes) + 1) * sizeof *run->read);
    return run->read != NULL;
}

/* Writes the metrics of the present state, one after the other. Returns the count of numbers, or -1 if
   memory is short. */
static int note_state(SceneRun *run, double at[CHART_QUANTITIES])
{
    const Scene *scene = run->scene;
    int used = 0;
    if (!metric_state_read(&run->state, &scene->world, run->world, scene->metrics, scene->metric_count))
        return -1;
    read_probes(run);
    for (int m = 0; m < scene->metric_count; m++) {
        metric_kinds[scene->metrics[m]].of(&run->state, at + used);
        used += metric_numbers(scene->metrics[m], scene->probes.count);
    }
    return used;
}

/* Steps until a sound state at or after `due`. On a GPU trouble is found after the step, and the next step
   goes back. Leaves the metrics of the state before in `before`; only states within 1.5 steps of `due` are
   measured. Returns false if the run broke or a signal came. */
static bool advance_to(SceneRun *run, double due, double until, const ProgressPart *part)
{
    double length = 0;
    bool sound = true;
    run->forces = (Forces){0};
    while (!sound || run->info.time < due - 1e-9) {
        const double from = run->info.time;
        if (sound && (length <= 0 || from + 1.5 * length >= due)) {
            run->before_time = from;
            note_state(run, run->before);
        }
        const double begin = wall_ms();
        const bool ok = world_step(run->world, NULL, &run->failure);
        sound = world_is_valid(run->world); /* waits for the GPU, so that the time includes its work */
        run->spent += (wall_ms() - begin) / 1000;
        world_info(run->world, &run->info);
        length = run->info.time - from;
        progress_part_update(part, fmin(run->info.time / until, 1));
        if (!ok || interrupted())
            return false;
    }
    return true;
}

/* Samples at k time / (CHART_TIMES - 1), by linear interpolation between the two states around. */
static bool sample_all(SceneRun *run, double until, ChartRow *row, const ProgressPart *part, Error *error)
{
    for (int k = 0; k < CHART_TIMES; k++) {
        const double due = until * k / (CHART_TIMES - 1);
        if (!advance_to(run, due, until, part))
            return !interrupted() || error_set(error, "stopped");
        row->quantities = note_state(run, run->now);
        if ((k % LOOK_EVERY == 0 || k == CHART_TIMES - 1) &&
            !outcome_sample(&run->history, &run->scene->world, false, run->world))
            row->quantities = -1;
        if (row->quantities < 0)
            return error_set(error, "no memory to read the particles; use a larger spacing");
        const double length = run->info.time - run->before_time;
        const double w =
            length > 0 && run->before_time < due ? fmin((due - run->before_time) / length, 1) : 1;
        for (int q = 0; q < row->quantities; q++)
            row->series[k][q] = w < 1 ? run->before[q] + w * (run->now[q] - run->before[q]) : run->now[q];
    }
    row->seconds = run->spent / until;
    row->steps = run->info.step;
    return true;
}

/* Fills in the outcome. For a broken run, prints the reason and advice at once. */
static void judge(OutcomeHistory *history, const WorldTrouble *trouble, const char *failure, ChartRow *row)
{
    history->trouble = *trouble;
    row->backs = trouble->count;
    if (!*failure || trouble->ended)
        outcome_judge(history, &row->outcome);
    else
        outcome_not_run(failure, &row->outcome);
    if (*failure)
        fprintf(stderr, "%s, %s, %s, spacing %.4g m: %s\n", row->method, row->backend, row->step,
                row->spacing, failure);
}

static bool run_scene(const Scene *scene, double until, ChartRow *row, const ProgressPart *part, Error *error)
{
    SceneRun run = {.scene = scene, .world = world_create(&scene->world, error)};
    if (!run.world)
        return false;
    world_info(run.world, &run.info);
    row->particles = run.info.count;
    const bool ok = !start_probes(&run)    ? error_set(error, "no memory for the probes")
                    : *run.failure.message ? true
                                           : sample_all(&run, until, row, part, error);
    judge(&run.history, &run.info.trouble, run.failure.message, row);
    metric_state_free(&run.state);
    probes_destroy(run.probes);
    free(run.read);
    world_destroy(run.world);
    return ok;
}

static bool run_case(const ChartSubject *subject, const ChartJob *job, ChartRow *row,
                     const ProgressPart *part, Error *error)
{
    CaseResult result;
    Scene scene;
    RunSettings settings;
    if (!chart_settings(subject, job, &settings, &scene, row, error))
        return false;
    Case of = *subject->of;
    of.time *= job->role == CHART_LONG ? CHART_LONGER : 1;
    CaseWatch watch = case_watch_begin(&of);
    const CaseSetup setup = {.of = &of,
                             .level = CASE_DEFAULT,
                             .method = job->method,
                             .settings = &settings.all,
                             .watch = case_watch,
                             .watcher = &watch};
    const bool ok = case_run(&setup, part->progress, part->done, part->part, &result, error);
    row->particles = result.particles;
    judge(&watch.history, &result.run.info.trouble, result.failure, row);
    if (ok && !*result.failure) {
        row->seconds = result.step_seconds / of.time;
        row->error = result.run.figures[0].error;
    }
    case_result_free(&result);
    return ok;
}

bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, const ProgressPart *part,
               Error *error)
{
    Scene scene;
    if (subject->of)
        return run_case(subject, job, row, part, error);
    RunSettings settings;
    return chart_settings(subject, job, &settings, &scene, row, error) &&
           load(subject, job, &settings, &scene, NULL, error) &&
           run_scene(&scene, subject->time * (job->role == CHART_LONG ? CHART_LONGER : 1), row, part, error);
}
