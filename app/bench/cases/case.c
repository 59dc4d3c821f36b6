#include "app/bench/cases/case.h"

#include "app/base/program.h"
#include "app/bench/cases/case_list.h"
#include "app/scene/scene.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool add_note(Reference *reference, const char *line)
{
    const size_t used = strlen(reference->notes);
    snprintf(reference->notes + used, sizeof reference->notes - used, "%s%s", used ? "\n" : "",
             line + 1 + strspn(line + 1, " "));
    return true;
}

/* Splits a line into cells; returns the count, or -1 if a cell is too long or there are too many cells. */
static int split(char *line, char cells[REFERENCE_COLUMNS][REFERENCE_CELL])
{
    int count = 0;
    for (char *at = line, *next; at; at = next, count++) {
        next = strchr(at, ',');
        if (next)
            *next++ = '\0';
        if (count == REFERENCE_COLUMNS || strlen(at) >= REFERENCE_CELL)
            return -1;
        snprintf(cells[count], REFERENCE_CELL, "%s", at);
    }
    return count;
}

static bool add_line(Reference *reference, char *line, int number, Error *error)
{
    line[strcspn(line, "\r\n")] = '\0';
    if (*line == '#')
        return add_note(reference, line);
    if (!*line)
        return true;
    if (reference->rows == REFERENCE_ROWS)
        return error_set(error, "%s:%d: more than %d rows", reference->path, number, REFERENCE_ROWS);
    const bool head = reference->columns == 0;
    const int count = split(line, head ? reference->column : reference->cell[reference->rows]);
    if (count < 0)
        return error_set(error, "%s:%d: more than %d columns, or a cell of more than %d letters",
                         reference->path, number, REFERENCE_COLUMNS, REFERENCE_CELL - 1);
    if (head)
        reference->columns = count;
    else if (count != reference->columns)
        return error_set(error, "%s:%d: %d cell%s; the columns are %d", reference->path, number, count,
                         plural((size_t)count), reference->columns);
    else
        reference->rows++;
    return true;
}

bool reference_load(const char *name, Reference *reference, Error *error)
{
    char line[512];
    *reference = (Reference){.rows = 0};
    if (!scene_path_find(name, reference->path, error))
        return false;
    FILE *file = fopen(reference->path, "r");
    if (!file)
        return error_set(error, "%s: cannot be opened", reference->path);
    bool ok = true;
    for (int number = 1; ok && fgets(line, sizeof line, file); number++)
        ok = add_line(reference, line, number, error);
    fclose(file);
    return ok && (reference->rows > 0 || error_set(error, "%s: has no rows", reference->path));
}

const char *reference_text(const Reference *reference, int row, const char *column)
{
    for (int c = 0; c < reference->columns; c++)
        if (strcmp(reference->column[c], column) == 0)
            return reference->cell[row][c];
    return "";
}

double reference_number(const Reference *reference, int row, const char *column)
{
    char *end;
    const char *text = reference_text(reference, row, column);
    const double number = strtod(text, &end);
    return *text && !*end ? number : (double)NAN;
}

#define X(name) &case_##name,
const Case *const case_list[] = {CASES(X) NULL};
#undef X

const char *case_suggest(const char *word)
{
    Suggestion near = suggest_for(word);
    for (const Case *const *at = case_list; *at; at++)
        suggest_offer(&near, (*at)->name);
    return near.best;
}

const Case *case_find(const char *name, Error *error)
{
    char all[512] = "";
    for (const Case *const *at = case_list; *at; at++) {
        if (strcmp((*at)->name, name) == 0)
            return *at;
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", *all ? ", " : "", (*at)->name);
    }
    const char *near = case_suggest(name);
    error_set(error, "there is no case '%.60s'%s%s%s; these are there: %s", name,
              near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "", all);
    return NULL;
}

CaseFigure figure_scaled(double value, double reference, double scale)
{
    return (CaseFigure){value, reference, fabs(value - reference) / fabs(scale)};
}

CaseFigure figure_relative(double value, double reference)
{
    return figure_scaled(value, reference, reference);
}

double figure_worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

const CaseMethod *case_method(const Case *of, const char *method)
{
    for (const CaseMethod *at = of->methods; at->name; at++)
        if (strcmp(at->name, method) == 0)
            return at;
    return NULL;
}

double case_tolerance(const Case *of, int m, CaseLevel level, const char *method)
{
    if (of->metrics[m].no_verdict)
        return (double)NAN;
    const CaseMethod *with = case_method(of, method);
    const bool coarse = level == CASE_COARSE;
    const double own = with ? (coarse ? with->coarse : with->tolerance)[m] : 0;
    return own > 0 ? own : coarse ? of->metrics[m].coarse : of->metrics[m].tolerance;
}

bool case_scene(const CaseSetup *setup, Scene *scene, Error *error)
{
    char spacing[64], method[64];
    SceneSettings all = {.particles = setup->settings->particles};
    snprintf(spacing, sizeof spacing, "particles.spacing=%.9g", setup->of->spacing[setup->level]);
    snprintf(method, sizeof method, "solver.method=%.32s", setup->method);
    bool ok = (all.particles > 0 || scene_settings_add(&all, NULL, spacing, error)) &&
              scene_settings_add(&all, NULL, method, error);
    if (ok && setup->of->setting)
        ok = scene_settings_add(&all, NULL, setup->of->setting, error);
    const CaseMethod *with = case_method(setup->of, setup->method);
    for (int i = 0; ok && with && i < CASE_SETTINGS && with->set[i]; i++)
        ok = scene_settings_add(&all, NULL, with->set[i], error);
    for (int i = 0; ok && i < setup->settings->count; i++)
        ok = scene_settings_add(&all, setup->settings->said[i], setup->settings->set[i], error);
    return ok && scene_load(setup->of->scene, &all, scene, setup->notes, error);
}

/* Arrays of the scene's own start, ordered by id. */
typedef struct Starting {
    size_t count;
    float *position, *velocity, *density, *pressure; /* 3, 3, 1, 1 per particle */
    uint8_t *fluid;
} Starting;

static bool starting_create(Starting *to, size_t count)
{
    *to = (Starting){count,
                     malloc(count * 3 * sizeof(float) + 1),
                     malloc(count * 3 * sizeof(float) + 1),
                     malloc(count * sizeof(float) + 1),
                     malloc(count * sizeof(float) + 1),
                     malloc(count + 1)};
    return to->position && to->velocity && to->density && to->pressure && to->fluid;
}

static void starting_free(Starting *starting)
{
    free(starting->position);
    free(starting->velocity);
    free(starting->density);
    free(starting->pressure);
    free(starting->fluid);
}

static void starting_set(Starting *to, const Cloud *from, const uint32_t *id)
{
    for (size_t k = 0; k < from->count; k++) {
        const size_t i = id[k];
        for (size_t a = 0; a < 3; a++) {
            to->position[3 * i + a] = from->position[4 * k + a];
            to->velocity[3 * i + a] = from->velocity[4 * k + a];
        }
        to->density[i] = from->density[k];
        to->pressure[i] = from->pressure[k];
        to->fluid[i] = (uint8_t)from->fluid[k];
    }
}

static bool starting_read(Starting *to, World *world)
{
    Cloud cloud = {0};
    WorldInfo info;
    world_info(world, &info);
    uint32_t *id = malloc(info.count * sizeof *id + 1);
    const bool ok = id && starting_create(to, info.count) && cloud_read(&cloud, world) &&
                    world_read(world, &(ParticleArrays){.id = id});
    if (ok)
        starting_set(to, &cloud, id);
    cloud_free(&cloud);
    free(id);
    return ok;
}

/* Makes the world with the scene's own start, as changed by the case. */
static World *start_world(const Case *of, const WorldDef *def, Error *error)
{
    World *own = world_create(def, error), *world = NULL;
    WorldDef with = *def;
    Starting s = {0};
    if (!own || !of->start)
        return own;
    if (starting_read(&s, own)) {
        of->start(def, &(CaseStart){s.count, s.position, s.velocity, s.density, s.fluid});
        with.initial = &(InitialState){s.count, s.position, s.velocity, s.fluid, s.density, s.pressure, 0};
        world = world_create(&with, error);
    } else {
        error_set(error, "no memory for the start; use a larger spacing");
    }
    starting_free(&s);
    world_destroy(own);
    return world;
}

static void read_probes(CaseRun *run, World *world)
{
    Forces forces = {0};
    if (run->wants_forces)
        world_forces(world, &forces);
    probes_read(run->probes, &run->cloud, &forces, run->probe);
}

static bool sample(CaseRun *run, World *world, Error *error)
{
    if (!cloud_read(&run->cloud, world))
        return error_set(error, "no memory to read %zu particles; use a larger spacing", run->info.count);
    if (run->probes)
        read_probes(run, world);
    if (run->of->sample)
        run->of->sample(run);
    return true;
}

/* Makes one step. Returns false if the simulation broke, with the reason in the result. `sound`: true if
   the state is final; on a GPU trouble is found after the step, and the next step goes back. */
static bool advance(CaseResult *result, World *world, bool *sound)
{
    Error broke = {{0}};
    const double begin = wall_ms();
    const bool ok = world_step(world, NULL, &broke);
    *sound = world_is_valid(world); /* waits for the GPU, so that the time includes its work */
    result->step_seconds += (wall_ms() - begin) / 1000;
    world_info(world, &result->run.info);
    if (!ok)
        snprintf(result->failure, sizeof result->failure, "%.250s", broke.message);
    return ok;
}

static bool simulate(const CaseSetup *setup, CaseResult *result, World *world, Progress *progress,
                     double done, double part, Error *error)
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
        if (sound && setup->watch && (last || run->info.time >= next))
            setup->watch(setup->watcher, run->def, world);
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

/* Opens the probes of the case's scene. */
static bool start_probes(CaseResult *result, World *world, Error *error)
{
    const ProbeList *list = &result->scene.probes;
    if (list->count == 0)
        return true;
    result->run.wants_forces = probe_list_has_forces(list);
    if (result->run.wants_forces && !world_enable_forces(world, error))
        return false;
    result->run.probes = probes_create(list, &result->scene.world);
    if (!result->run.probes)
        return error_set(error, "no memory for the probes of %s", result->of->name);
    return probes_columns(result->run.probes) <= CASE_PROBES ||
           error_set(error, "%s: a case has at most %d numbers of probes", result->scene.path, CASE_PROBES);
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
        result->run.figures[m] = (CaseFigure){(double)NAN, (double)NAN, (double)NAN};
    World *world = start_world(setup->of, &result->scene.world, error);
    if (!world)
        return false;
    const bool ok =
        start_probes(result, world, error) && simulate(setup, result, world, progress, done, part, error);
    result->particles = result->run.info.count;
    world_destroy(world);
    cloud_free(&result->run.cloud);
    probes_destroy(result->run.probes);
    result->run.probes = NULL;
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
    return isnan(tolerance) || result->run.figures[metric].error <= tolerance;
}
