#include "app/chart_run.h"

#include "app/interrupt.h"
#include "app/scene_keys.h"
#include "sim/stage.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTS = 6, TEXT_SIZE = 96 };

static uint64_t hash(uint64_t h, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) /* FNV-1a */
        h = (h ^ (uint8_t)text[i]) * 0x100000001b3ULL;
    return (h ^ 0xff) * 0x100000001b3ULL;
}

/* Of all settings as they were resolved, by whatever file or option, but for how it looks. */
static bool hash_scene(const Scene *scene, uint64_t *h, Error *error)
{
    char *text = scene_print_text(scene);
    for (const char *line = text; line && *line;) {
        const size_t size = strcspn(line, "\n");
        if (strncmp(line, "title ", 6) != 0 && strncmp(line, "view.", 5) != 0)
            *h = hash(*h, line, size);
        line += size + (line[size] == '\n');
    }
    free(text);
    return text != NULL || error_set(error, "no memory for the settings of %.200s", scene->path);
}

/* The settings that the job adds to those of the command line; `texts` holds them. */
typedef struct JobSettings {
    SceneSettings all;
    char texts[TEXTS][TEXT_SIZE];
    int used;
} JobSettings;

__attribute__((format(printf, 3, 4))) static bool add(JobSettings *job, Error *error, const char *format, ...)
{
    va_list arguments;
    if (job->all.count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    va_start(arguments, format);
    vsnprintf(job->texts[job->used], TEXT_SIZE, format, arguments);
    va_end(arguments);
    job->all.set[job->all.count++] = job->texts[job->used++];
    return true;
}

static bool load(const ChartSubject *subject, const ChartJob *job, JobSettings *settings, Scene *scene,
                 Error *error)
{
    char note[256];
    if (!subject->of)
        return scene_load(subject->scene, &settings->all, scene, note, error);
    const CaseSetup setup = {subject->of, CASE_DEFAULT, job->method, &settings->all};
    return case_scene(&setup, scene, error);
}

/* First as the scene has it, to know its spacing and step; then with those of the job. A step of mode fixed
   shrinks with the spacing. */
static bool job_settings(const ChartSubject *subject, const ChartJob *job, JobSettings *settings,
                         Scene *scene, ChartRow *row, Error *error)
{
    *settings = (JobSettings){.all = *subject->settings};
    bool ok = add(settings, error, "solver.method=%s", job->method) &&
              (!job->backend || add(settings, error, "solver.backend=%s", job->backend)) &&
              load(subject, job, settings, scene, error);
    if (!ok)
        return false;
    const WorldDef *def = &scene->world;
    row->spacing = def->spacing * job->coarsening;
    settings->all.particles = 0;
    ok = add(settings, error, "particles.spacing=%.9g", row->spacing);
    if (def->step_mode == STEP_CFL) {
        const double number = def->cfl_number / (1 << job->fineness);
        snprintf(row->step, NAME_SIZE, "number %.3g", number);
        ok = ok && add(settings, error, "solver.step.number=%.9g", number);
    } else {
        const int substeps = (int)ceil(def->substeps * (1 << job->fineness) / job->coarsening - 1e-6);
        snprintf(row->step, NAME_SIZE, "%.3g ms", 1000 * def->dt / substeps);
        ok = ok && add(settings, error, "solver.step.substeps=%d", substeps);
    }
    return ok && (job->jitter == 0 || add(settings, error, "particles.jitter=%.9g", job->jitter));
}

bool chart_prepare(const ChartSubject *subject, const ChartJob *job, Scene *scene, ChartRow *row,
                   Error *error)
{
    JobSettings settings;
    char rest[128];
    *row = (ChartRow){.role = job->role,
                      .fineness = job->fineness,
                      .seconds = (double)NAN,
                      .error = (double)NAN,
                      .key = 0xcbf29ce484222325ULL};
    if (!job_settings(subject, job, &settings, scene, row, error) ||
        !load(subject, job, &settings, scene, error) || !world_can(&scene->world, error))
        return false;
    snprintf(row->method, NAME_SIZE, "%s", scene->world.method);
    snprintf(row->backend, NAME_SIZE, "%s", scene->world.backend);
    snprintf(rest, sizeof rest, "%s %d %.9g", SLOSH_VERSION, (int)job->role, subject->time);
    const char *name = subject->of ? subject->of->name : "";
    row->key = hash(hash(row->key, rest, strlen(rest)), name, strlen(name));
    return hash_scene(scene, &row->key, error);
}

static void note_state(World *world, double at[CHART_QUANTITIES])
{
    WorldSums sums;
    world_sums(world, &sums);
    memcpy(at, sums.centre, sizeof sums.centre);
    at[3] = sums.kinetic_energy;
}

/* Samples at k time / (CHART_TIMES - 1), on straight lines between the states around them. */
static bool run_scene(const Scene *scene, double until, ChartRow *row, Progress *progress, double done,
                      double part, Error *error)
{
    World *world = world_create(&scene->world, error);
    double before[CHART_QUANTITIES] = {0}, now[CHART_QUANTITIES], from = 0, spent = 0;
    bool ok = true;
    if (!world)
        return false;
    WorldInfo info;
    world_info(world, &info);
    row->particles = info.count;
    note_state(world, now);
    for (int k = 0; ok && k < CHART_TIMES;) {
        const double due = until * k / (CHART_TIMES - 1);
        if (info.time >= due - 1e-9) {
            const double w = info.time > from ? fmin((due - from) / (info.time - from), 1) : 1;
            for (int q = 0; q < CHART_QUANTITIES; q++)
                row->series[k][q] = k == 0 ? now[q] : before[q] + w * (now[q] - before[q]);
            k++;
            continue;
        }
        Error broke = {{0}};
        const double begin = wall_ms();
        ok = world_step(world, NULL, &broke);
        spent += (wall_ms() - begin) / 1000;
        snprintf(row->failure, sizeof row->failure, "%.127s", broke.message);
        from = info.time;
        memcpy(before, now, sizeof before);
        world_info(world, &info);
        note_state(world, now);
        progress_update(progress, done + part * fmin(info.time / until, 1));
        if (interrupted()) {
            world_destroy(world);
            return error_set(error, "stopped");
        }
    }
    world_destroy(world);
    row->seconds = ok ? spent / until : (double)NAN;
    return true;
}

static bool run_case(const ChartSubject *subject, const ChartJob *job, ChartRow *row, Progress *progress,
                     double done, double part, Error *error)
{
    static CaseResult result;
    static Scene scene;
    JobSettings settings;
    if (!job_settings(subject, job, &settings, &scene, row, error))
        return false;
    const CaseSetup setup = {subject->of, CASE_DEFAULT, job->method, &settings.all};
    const bool ok = case_run(&setup, progress, done, part, &result, error);
    row->particles = result.particles;
    snprintf(row->failure, sizeof row->failure, "%.127s", result.failure);
    if (ok && !*result.failure) {
        row->seconds = result.step_seconds / subject->of->time;
        row->error = result.run.figures[0].error;
    }
    case_result_free(&result);
    return ok;
}

bool chart_run(const ChartSubject *subject, const ChartJob *job, ChartRow *row, Progress *progress,
               double done, double part, Error *error)
{
    static Scene scene;
    if (subject->of)
        return run_case(subject, job, row, progress, done, part, error);
    JobSettings settings;
    return job_settings(subject, job, &settings, &scene, row, error) &&
           load(subject, job, &settings, &scene, error) &&
           run_scene(&scene, subject->time, row, progress, done, part, error);
}
