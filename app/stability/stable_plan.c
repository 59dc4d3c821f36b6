#include "app/stability/stable_plan.h"

#include "app/lab/chart.h"
#include "app/lab/chart_sweep.h"
#include "app/scene/scene.h"
#include "app/stability/stable_limits.h"
#include "app/stability/stable_search.h"
#include "sim/matter/fall.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

int stable_points(const StablePlan *plan, int axis)
{
    return axis < plan->axis_count ? plan->axis[axis].count : 1;
}

static int cells_of_series(const StablePlan *plan)
{
    return stable_points(plan, 0) * stable_points(plan, 1);
}

int stable_cells(const StablePlan *plan)
{
    return plan->series_count * cells_of_series(plan);
}

StableCell stable_cell(const StablePlan *plan, int number)
{
    const int each = cells_of_series(plan), last = stable_points(plan, 1);
    return (StableCell){.series = number / each, .at = {number % each / last, number % each % last}};
}

int stable_searched(const StablePlan *plan, int number)
{
    const StableCell cell = stable_cell(plan, number);
    const bool *effect = plan->series[cell.series].effect;
    return cell.series * cells_of_series(plan) + (effect[0] ? cell.at[0] : 0) * stable_points(plan, 1) +
           (effect[1] ? cell.at[1] : 0);
}

void stable_at(const StablePlan *plan, StableCell cell, char *text, size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (int a = 0; a < plan->axis_count; a++)
        if (plan->series[cell.series].effect[a] && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s=%s", used ? " " : "", plan->axis[a].key,
                                     plan->axis[a].text[cell.at[a]]);
}

/* The settings of the command line, with those of a cell added. */
typedef struct CellSettings {
    SceneSettings all;
    char texts[16][STABLE_KEY + STABLE_VALUE + 16];
    int used;
} CellSettings;

__attribute__((format(printf, 2, 3))) static void add(CellSettings *cell, const char *format, ...)
{
    static const char OPTION[] = "--axis ";
    char *text = cell->texts[cell->used++];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof cell->texts[0], format, arguments);
    va_end(arguments);
    const bool axis = strncmp(text, OPTION, sizeof OPTION - 1) == 0;
    cell->all.said[cell->all.count] = axis ? text : NULL;
    cell->all.set[cell->all.count++] = axis ? text + sizeof OPTION - 1 : text;
}

/* Adds the settings of the series, without the axes. */
static void add_series(const StableSeries *series, CellSettings *cell)
{
    add(cell, "solver.method=%s", series->method);
    add(cell, "solver.backend=%s", series->backend);
}

static void add_step(int rung, CellSettings *cell)
{
    add(cell, "solver.step.mode=fixed");
    add(cell, "solver.step.dt=%.17g", stable_step(rung));
    add(cell, "solver.step.substeps=1");
    add(cell, "solver.step.retries=1");
}

static bool begin(const StablePlan *plan, CellSettings *cell, Error *error)
{
    *cell = (CellSettings){.all = plan->args->settings};
    cell->all.purpose = SCENE_FOR_CHART;
    return cell->all.count + 16 <= SCENE_SETTINGS_MAX ||
           error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX - 16);
}

bool stable_scene(const StablePlan *plan, StableCell cell, const int *rung, Scene *scene, Error *error)
{
    CellSettings settings;
    if (!begin(plan, &settings, error))
        return false;
    const StableSeries *series = &plan->series[cell.series];
    add_series(series, &settings);
    for (int a = 0; a < plan->axis_count; a++)
        if (series->effect[a])
            add(&settings, "--axis %s=%s", plan->axis[a].key, plan->axis[a].text[cell.at[a]]);
    add(&settings, "solver.threads=1");
    if (rung)
        add_step(*rung, &settings);
    return scene_load(plan->scene_name, &settings.all, scene, NULL, error) && world_can(&scene->world, error);
}

void stable_range(const StablePlan *plan, const Scene *scene, int *first, int *most)
{
    enum { STEPS_LEAST = 8 }; /* per trial */
    StableLimits limits;
    stable_limits(&scene->world, &limits);
    *most = (int)floor(STABLE_RUNGS * log2(fmin(plan->time / STEPS_LEAST, 1)));
    *first = stable_rung(stable_guess(&scene->world, &limits));
    *first = *first < *most ? *first : *most;
}

/* True if an earlier series has the same method and backend. */
static bool is_there(const StablePlan *plan, const StableSeries *series)
{
    for (const StableSeries *other = plan->series; other < series; other++)
        if (strcmp(other->method, series->method) == 0 && strcmp(other->backend, series->backend) == 0)
            return true;
    return false;
}

/* Makes a series of each method and backend; skips impossible combinations. */
static bool find_series(StablePlan *plan, Error *error)
{
    const char *methods[SWEEP_NAMES_MAX], *backends[SWEEP_NAMES_MAX];
    int m = sweep_names(plan->args, "solver.method", methods),
        b = sweep_names(plan->args, "solver.backend", backends);
    methods[0] = m > 0 ? methods[0] : plan->scene.world.method;
    backends[0] = b > 0 ? backends[0] : plan->scene.world.backend;
    m = m > 0 ? m : 1;
    b = b > 0 ? b : 1;
    for (int i = 0; i < m * b && plan->series_count < STABLE_SERIES; i++) {
        static Scene scene;
        CellSettings settings;
        StableSeries *series = &plan->series[plan->series_count];
        snprintf(series->method, NAME_SIZE, "%s", methods[i % m]);
        snprintf(series->backend, NAME_SIZE, "%s", backends[i / m]);
        if (is_there(plan, series))
            return error_set(error, "slosh stability: --sweep has method %s on %s twice; name it once",
                             series->method, series->backend);
        if (!begin(plan, &settings, error))
            return false;
        add_series(series, &settings);
        if (!scene_load(plan->scene_name, &settings.all, &scene, NULL, error))
            return false;
        if (world_can(&scene.world, error))
            plan->series_count++;
        else
            fprintf(stderr, "left out: %s\n", error->message);
    }
    return plan->series_count > 0;
}

/* Finds the methods that read the axis; fails if none does. */
static bool find_effect(StablePlan *plan, int a, Error *error)
{
    static Scene scene;
    static Notes notes;
    bool any = false;
    const StableAxis *axis = &plan->axis[a];
    for (int s = 0; s < plan->series_count; s++) {
        StableSeries *series = &plan->series[s];
        const StableCell cell = {.series = s};
        series->effect[a] = false;
        if (!stable_scene(plan, cell, NULL, &scene, error))
            return false;
        notes.count = 0;
        scene_advise_key(&scene, axis->key, &notes);
        series->effect[a] = notes.count == 0;
        any |= series->effect[a];
        if (notes.count > 0)
            fprintf(stderr, "%s changes nothing with method %s: %s\n", axis->key, series->method,
                    notes.line[0]);
    }
    return any || error_set(error,
                            "slosh stability: --axis %s changes nothing: no method of the map reads it; name "
                            "another key",
                            axis->key);
}

/* Checks that the scene can be loaded at both ends of an axis. */
static bool check_ends(const StablePlan *plan, int a, Error *error)
{
    static Scene scene;
    bool ok = true;
    for (int end = 0; ok && end < 2; end++)
        for (int s = 0; ok && s < plan->series_count; s++) {
            StableCell cell = {.series = s};
            cell.at[a] = end ? plan->axis[a].count - 1 : 0;
            ok = stable_scene(plan, cell, NULL, &scene, error);
        }
    return ok;
}

static void choose_axes(StablePlan *plan)
{
    const char *methods[STABLE_SERIES];
    for (int s = 0; s < plan->series_count; s++)
        methods[s] = plan->series[s].method;
    plan->axis_count = stable_axes_choose(&plan->scene, methods, plan->series_count, plan->axis);
}

static bool find_axes(StablePlan *plan, Error *error)
{
    const Args *args = plan->args;
    if (args->axis_count > STABLE_AXES)
        return error_set(error, "slosh stability: a map has %d axes at most; leave out --axis %.60s",
                         STABLE_AXES, args->axes[STABLE_AXES]);
    for (int a = 0; a < args->axis_count; a++)
        if (!stable_axis_parse(args->axes[a], &plan->axis[a], error))
            return false;
    plan->axis_count = args->axis_count;
    if (args->axis_count == 0)
        choose_axes(plan);
    if (plan->axis_count == 2 && strcmp(plan->axis[0].key, plan->axis[1].key) == 0)
        return error_set(error, "slosh stability: --axis %s stands there twice; name another key",
                         plan->axis[0].key);
    for (int a = 0; a < plan->axis_count; a++)
        if (args->settings.particles > 0 && strcmp(plan->axis[a].key, "particles.spacing") == 0)
            return error_set(error,
                             "slosh stability: --particles %zu is a spacing of %.4g m, and the axis is the "
                             "spacing; %s",
                             args->settings.particles, plan->scene.world.spacing,
                             args->axis_count > 0 ? "leave --particles out" : "name another --axis");
    for (int a = 0; a < plan->axis_count; a++)
        if (!find_effect(plan, a, error) || !check_ends(plan, a, error))
            return false;
    return true;
}

/* Default time of a trial, s: four times the fall from the top, enough for the fluid to fall, run along
   the floor and return. */
static double usual_time(const WorldDef *def)
{
    const double *g = def->gravity, pull = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const double fall = greatest_fall(def);
    return pull > 0 && fall > 0 ? 4 * sqrt(2 * fall / pull) : 1;
}

static bool find_scene(StablePlan *plan, Error *error)
{
    CellSettings settings;
    const Args *args = plan->args;
    if (!begin(plan, &settings, error) ||
        !scene_load(plan->scene_name, &settings.all, &plan->scene, &plan->notes, error))
        return false;
    plan->notes.count = plan->notes.lasting; /* the dropped notes are about an unused step */
    plan->time = args->time_given ? args->time : usual_time(&plan->scene.world);
    const int threads = *world_threads(&plan->scene.world);
    plan->threads = threads > 0 ? threads : world_processors();
    return plan->time > 0 || error_set(error, "slosh stability: --time must be more than 0");
}

static bool check_sweeps(const Args *args, Error *error)
{
    for (int s = 0; s < args->sweep_count; s++)
        if (strcmp(args->sweeps[s].key, "solver.method") != 0 &&
            strcmp(args->sweeps[s].key, "solver.backend") != 0)
            return error_set(error,
                             "slosh stability: --sweep takes method=... and backend=... here; use --axis for "
                             "%.60s",
                             args->sweeps[s].key);
    return true;
}

bool stable_plan_make(const Args *args, StablePlan *plan, Error *error)
{
    *plan = (StablePlan){.args = args, .scene_name = args->scenes[0]};
    for (int s = 0; s < STABLE_SERIES; s++)
        for (int a = 0; a < STABLE_AXES; a++)
            plan->series[s].effect[a] = true;
    return check_sweeps(args, error) && chart_table_name(args->output, plan->csv, error) &&
           find_scene(plan, error) && find_series(plan, error) && find_axes(plan, error);
}
