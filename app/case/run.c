#include "app/case/run.h"

#include "app/base/interrupt.h"
#include "sim/base/stage.h"
#include "sim/matter/seed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool add_setting(SceneSettings *settings, const char *text, const char *said, Error *error)
{
    if (settings->count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    settings->said[settings->count] = said;
    settings->set[settings->count++] = text;
    return true;
}

bool case_scene(const CaseSetup *setup, Scene *scene, Error *error)
{
    char spacing[64], method[64];
    SceneSettings all = {.particles = setup->settings->particles};
    snprintf(spacing, sizeof spacing, "particles.spacing=%.9g", setup->of->spacing[setup->level]);
    snprintf(method, sizeof method, "solver.method=%.32s", setup->method);
    bool ok = add_setting(&all, spacing, NULL, error) && add_setting(&all, method, NULL, error);
    if (ok && setup->of->setting)
        ok = add_setting(&all, setup->of->setting, NULL, error);
    const CaseMethod *with = case_method(setup->of, setup->method);
    for (int i = 0; ok && with && i < CASE_SETTINGS && with->set[i]; i++)
        ok = add_setting(&all, with->set[i], NULL, error);
    for (int i = 0; ok && i < setup->settings->count; i++)
        ok = add_setting(&all, setup->settings->set[i], setup->settings->said[i], error);
    return ok && scene_load(setup->of->scene, &all, scene, NULL, error);
}

/* The lattice of the fills, moved by the case's start. */
static World *start_world(const Case *of, const WorldDef *def, Error *error)
{
    if (!of->start)
        return world_create(def, error);
    const size_t count = seed_count(def, def->spacing);
    WorldDef with = *def;
    World *world = NULL;
    float *position = malloc(count * 3 * sizeof *position + 1);
    float *velocity = calloc(count * 3 + 1, sizeof *velocity);
    float *density = malloc(count * sizeof *density + 1);
    uint8_t *fluid = malloc(count + 1);
    if (position && velocity && density && fluid) {
        seed_lattice(def, position, fluid);
        seed_jitter(def, position, count);
        for (size_t i = 0; i < count; i++)
            density[i] = (float)def->fluids[fluid[i]].density;
        of->start(def, &(CaseStart){count, position, velocity, density, fluid});
        with.initial = &(InitialState){count, position, velocity, fluid, density};
        world = world_create(&with, error);
    } else {
        error_set(error, "no memory for %zu particles; use a larger spacing", count);
    }
    free(position);
    free(velocity);
    free(density);
    free(fluid);
    return world;
}

static bool sample(CaseRun *run, World *world, Error *error)
{
    if (!cloud_read(&run->cloud, world))
        return error_set(error, "no memory to read %zu particles; use a larger spacing", run->info.count);
    if (run->of->sample)
        run->of->sample(run);
    return true;
}

/* False when it broke, with the reason in the result. `sound`: whether the state stays; on a GPU trouble is
   found behind the step, and the next one goes back. */
static bool advance(CaseResult *result, World *world, bool *sound)
{
    Error broke = {{0}};
    const double begin = wall_ms();
    const bool ok = world_step(world, NULL, &broke);
    *sound = world_sound(world); /* waits for a GPU, which is what is timed */
    result->step_seconds += (wall_ms() - begin) / 1000;
    world_info(world, &result->run.info);
    if (!ok)
        snprintf(result->failure, sizeof result->failure, "%.250s", broke.message);
    return ok;
}

static bool simulate(CaseResult *result, World *world, Progress *progress, double done, double part,
                     Error *error)
{
    CaseRun *run = &result->run;
    const Case *of = run->of;
    double next = 0;
    bool sound = true;
    world_info(world, &run->info);
    for (;;) {
        const bool last = sound && run->info.time >= of->time;
        if (sound && (last || run->info.time >= next) && !sample(run, world, error))
            return false;
        while (sound && next <= run->info.time)
            next += of->every;
        if (last)
            return of->judge(run, error);
        if (!advance(result, world, &sound))
            return true;
        if (interrupted())
            return error_set(error, "stopped");
        progress_update(progress, done + part * fmin(run->info.time / of->time, 1));
    }
}

bool case_run(const CaseSetup *setup, Progress *progress, double done, double part, CaseResult *result,
              Error *error)
{
    const double begin = wall_ms();
    *result = (CaseResult){.of = setup->of, .level = setup->level};
    if (!case_scene(setup, &result->scene, error))
        return false;
    result->run = (CaseRun){.of = setup->of, .def = &result->scene.world, .level = setup->level};
    for (int m = 0; m < CASE_METRICS; m++)
        result->run.figures[m] = (Figure){(double)NAN, (double)NAN, (double)NAN};
    World *world = start_world(setup->of, &result->scene.world, error);
    if (!world)
        return false;
    const bool ok = simulate(result, world, progress, done, part, error);
    result->particles = result->run.info.count;
    world_destroy(world);
    cloud_free(&result->run.cloud);
    result->seconds = (wall_ms() - begin) / 1000;
    return ok;
}

void case_result_free(CaseResult *result)
{
    for (int c = 0; c < CASE_COLUMNS; c++)
        curve_free(&result->run.column[c]);
    for (int c = 0; c < CASE_CURVES; c++) {
        curve_free(&result->run.found[c]);
        curve_free(&result->run.expected[c]);
    }
}

bool case_passed(const CaseResult *result, int metric)
{
    const double tolerance = case_tolerance(result->of, metric, result->level, result->scene.world.method);
    return result->run.figures[metric].error <= tolerance;
}
