#include "app/base/program.h"
#include "app/lab/error_chart.h"
#include "app/lab/stability.h"
#include "app/scene/scene.h"
#include "sim/def/fluids.h"
#include "sim/kernel/kernel.h"
#include "sim/start/start.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns a start for the search: the lattice limit; without sound the step for pressure
   (sim/step/constants.h). */
static double stable_guess(const WorldDef *def, const StableLimits *limits);

double stable_step(int rung)
{
    return exp2((double)rung / STABLE_RUNGS);
}

int stable_rung(double step)
{
    return (int)lround(STABLE_RUNGS * log2(step));
}

enum { POINTS = 8 };

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* Fills in the points between both ends, with their texts as in a scene file; whole numbers appear once. */
static void fill(StableAxis *axis, double from, double to, int points)
{
    axis->logarithmic = from > 0 && to >= 10 * from;
    axis->count = 0;
    for (int i = 0; i < points; i++) {
        const double part = points > 1 ? (double)i / (points - 1) : 0;
        const double value = axis->logarithmic ? from * pow(to / from, part) : from + part * (to - from);
        char *text = axis->text[axis->count];
        if (axis->row->type == KEY_INTEGER)
            snprintf(text, STABLE_VALUE, "%.0f", value);
        else
            snprintf(text, STABLE_VALUE, "%.5g", value);
        if (axis->count > 0 && strcmp(text, axis->text[axis->count - 1]) == 0)
            continue;
        axis->value[axis->count++] = strtod(text, NULL);
    }
}

static bool unknown(const char *name, Error *error)
{
    int count;
    const Key *keys = scene_keys(&count);
    Suggestion near = suggest_for(name);
    for (int i = 0; i < count; i++)
        suggest_offer(&near, keys[i].path);
    if (near.best)
        return error_set(error, "slosh stability: --axis %.60s: no such key; did you mean '%s'?", name,
                         near.best);
    return error_set(error, "slosh stability: --axis %.60s: no such key; `slosh help keys` lists them", name);
}

/* Returns true if the key can be an axis. */
static bool check_key(const Key *key, const char *name, Error *error)
{
    if (!key)
        return unknown(name, error);
    if (key->type != KEY_NUMBER && key->type != KEY_INTEGER && key->type != KEY_CURVE)
        return error_set(error, "slosh stability: --axis %.60s: is no number; name a key that is one", name);
    if (begins(key->path, "solver.step."))
        return error_set(
            error, "slosh stability: --axis %.60s: the step is what is searched; name another key", name);
    if (key->flags & KEY_IDLE || begins(key->path, "view.") || begins(key->path, "hand."))
        return error_set(
            error, "slosh stability: --axis %.60s changes nothing that is simulated; name another key", name);
    return true;
}

static bool parse_number(const char **text, double *number)
{
    char *end;
    *number = strtod(*text, &end);
    if (end == *text || !isfinite(*number))
        return false;
    *text = end;
    return true;
}

static bool parse_range(const char *text, double *from, double *to, double *points)
{
    if (!parse_number(&text, from) || *text++ != ':' || !parse_number(&text, to))
        return false;
    if (*text == ':') {
        text++;
        if (!parse_number(&text, points))
            return false;
    }
    return !*text;
}

/* Parses "KEY=a:b" or "KEY=a:b:n". Returns false with the reason. */
static bool stable_axis_parse(const char *text, StableAxis *axis, Error *error)
{
    const char *equals = strchr(text, '=');
    double from, to, points = POINTS;
    if (!equals || equals == text || equals - text >= STABLE_KEY)
        return error_set(error,
                         "slosh stability: --axis takes KEY=a:b such as solver.sound_speed=5:50, not '%.60s'",
                         text);
    snprintf(axis->key, sizeof axis->key, "%.*s", (int)(equals - text), text);
    axis->row = scene_key_find(axis->key);
    if (!check_key(axis->row, axis->key, error))
        return false;
    if (!parse_range(equals + 1, &from, &to, &points))
        return error_set(
            error,
            "slosh stability: --axis %.60s takes two numbers a:b, and how many points, a:b:n, not "
            "'%.60s'",
            axis->key, equals + 1);
    if (!(from < to))
        return error_set(error, "slosh stability: --axis %.60s: %g is not less than %g; write it as %g:%g",
                         axis->key, from, to, to, from);
    if (!(points >= 2 && points <= STABLE_POINTS && points == floor(points)))
        return error_set(error, "slosh stability: --axis %.60s takes 2 to %d points, not %g", axis->key,
                         STABLE_POINTS, points);
    fill(axis, from, to, (int)points);
    return axis->count > 1 ||
           error_set(error, "slosh stability: --axis %.60s: %g and %g are one value", axis->key, from, to);
}

static void choose(StableAxis *axis, const char *key, double from, double to)
{
    snprintf(axis->key, sizeof axis->key, "%s", key);
    axis->row = scene_key_find(key);
    fill(axis, from, to, POINTS);
}

static double rounded(double number)
{
    char text[32];
    snprintf(text, sizeof text, "%.1g", number);
    return strtod(text, NULL);
}

/* Returns the first method with sound, or the first method. */
static const char *leading(const char *const methods[], int count)
{
    int m = 0;
    assert(count > 0);
    while (m < count && method_find(methods[m])->incompressible)
        m++;
    return methods[m < count ? m : 0];
}

/* Chooses axes for a command line without --axis; returns their count. First axis: speed of sound, from
   1/4 to 4 times the scene's. Second: viscosity of the first fluid, from where friction limits the step a
   hundredth as much as sound to four times as much, for the first method with sound. Without such a
   method: viscosity alone, compared with the step for pressure; if viscosity has no effect either, the
   spacing. Each axis has eight points. */
static int stable_axes_choose(const Scene *scene, const char *const methods[], int count,
                              StableAxis axes[STABLE_AXES])
{
    static const double QUARTER = 4, LEAST = 0.01;
    WorldDef def = scene->world;
    StableLimits limits;
    int used = 0;
    snprintf(def.method, sizeof def.method, "%s", leading(methods, count));
    def.viscosity_solver = VISCOSITY_EXPLICIT;
    for (int f = 0; f < def.fluid_count; f++) { /* search from zero viscosity */
        def.fluids[f].viscosity = 0;
        def.fluids[f].viscosity_table.rows = 0;
    }
    stable_limits(&def, &limits);
    const double step = stable_guess(&def, &limits), rate = step_friction(&def).laminar;
    const double most =
        rate > 0 && def.fluid_count > 0 ? rounded(def.fluids[0].density * 2 * QUARTER / (rate * step)) : 0;
    if (step_sound(&def) > 0)
        choose(&axes[used++], "solver.sound_speed", def.sound_speed / QUARTER, QUARTER * def.sound_speed);
    if (most > 0)
        choose(&axes[used++], "fluids[0].viscosity", LEAST * most, most);
    if (used == 0)
        choose(&axes[used++], "particles.spacing", def.spacing, 2 * def.spacing);
    return used;
}

static double stiffest(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const MethodKernels kernels = method_kernels(def);
    const double h = def->support * def->spacing;
    Lattice lattice;
    lattice_calibrate(def->dimensions, def->spacing, h, kernels.density, kernels.slope, &lattice);
    return sound_stiffest(&lattice, def->spacing, h, kernels.density, method->carries_density);
}

static double together(double sound, double friction)
{
    const double omega = 2 / sound, gamma = 2 / friction; /* 0 if the limit is infinite */
    if (omega == 0)
        return friction;
    return (sqrt(gamma * gamma + 4 * omega * omega) - gamma) / (omega * omega);
}

/* Greatest kinematic viscosity, m2/s; for fluids without viscosity the artificial viscosity. */
static double viscosity(const WorldDef *def, const StepFriction *friction)
{
    double most = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        const double mu = fluid_viscosity_most(&def->fluids[f]);
        most = fmax(most, mu > 0                     ? mu / def->fluids[f].density
                          : friction->artificial > 0 ? artificial_kinematic(def, friction->alpha)
                                                     : 0);
    }
    return most;
}

void stable_limits(const WorldDef *def, StableLimits *limits)
{
    const StepFriction friction = step_friction(def);
    const double c = step_sound(def), *g = def->gravity, l = 0.5 * def->support * def->spacing,
                 pull = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    limits->sound = c > 0 ? 2 / (c * stiffest(def)) : (double)INFINITY;
    limits->friction = step_viscous(def, &friction);
    limits->lattice = together(limits->sound, limits->friction);
    limits->courant = c > 0 ? 0.4 * l / c : (double)INFINITY;
    limits->force = 0.25 * sqrt(l / pull); /* INFINITY without gravity */
    limits->viscous = 0.125 * l * l / viscosity(def, &friction);
}

static double stable_guess(const WorldDef *def, const StableLimits *limits)
{
    const double h = def->support * def->spacing, *g = def->gravity;
    const double speed = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * greatest_fall(def));
    if (isfinite(limits->sound))
        return limits->lattice;
    return fmin(STEP_PRESSURE_STANDS * h / (speed > 0 ? speed : 1), limits->lattice);
}

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

static bool add_step(int rung, RunSettings *cell, Error *error)
{
    return run_settings_add(cell, error, "solver.step.mode=fixed") &&
           run_settings_add(cell, error, "solver.step.dt=%.17g", stable_step(rung)) &&
           run_settings_add(cell, error, "solver.step.substeps=1") &&
           run_settings_add(cell, error, "solver.step.retries=1");
}

/* Begins with the settings of the command line and of the series, without the axes. */
static bool begin(const StablePlan *plan, const StableSeries *series, RunSettings *cell, Error *error)
{
    *cell = (RunSettings){.all = plan->args->settings};
    cell->all.purpose = SCENE_FOR_CHART;
    return !series || (run_settings_add(cell, error, "solver.method=%s", series->method) &&
                       run_settings_add(cell, error, "solver.backend=%s", series->backend));
}

bool stable_scene(const StablePlan *plan, StableCell cell, const int *rung, Scene *scene, Error *error)
{
    RunSettings settings;
    const StableSeries *series = &plan->series[cell.series];
    bool ok = begin(plan, series, &settings, error);
    for (int a = 0; ok && a < plan->axis_count; a++)
        ok = !series->effect[a] || run_settings_add(&settings, error, "--axis %s=%s", plan->axis[a].key,
                                                    plan->axis[a].text[cell.at[a]]);
    return ok && run_settings_add(&settings, error, "solver.threads=1") &&
           (!rung || add_step(*rung, &settings, error)) &&
           scene_load(plan->scene_name, &settings.all, scene, NULL, error) && world_can(&scene->world, error);
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
        Scene scene;
        RunSettings settings;
        StableSeries *series = &plan->series[plan->series_count];
        snprintf(series->method, NAME_SIZE, "%s", methods[i % m]);
        snprintf(series->backend, NAME_SIZE, "%s", backends[i / m]);
        if (is_there(plan, series))
            return error_set(error, "slosh stability: --sweep has method %s on %s twice; name it once",
                             series->method, series->backend);
        if (!begin(plan, series, &settings, error) ||
            !scene_load(plan->scene_name, &settings.all, &scene, NULL, error))
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
    Scene scene;
    char why[NOTE_SIZE];
    bool any = false;
    const StableAxis *axis = &plan->axis[a];
    for (int s = 0; s < plan->series_count; s++) {
        StableSeries *series = &plan->series[s];
        const StableCell cell = {.series = s};
        series->effect[a] = false;
        if (!stable_scene(plan, cell, NULL, &scene, error))
            return false;
        series->effect[a] = key_has_effect(&scene, axis->key, why);
        any |= series->effect[a];
        if (!series->effect[a])
            fprintf(stderr, "%s changes nothing with method %s: %s\n", axis->key, series->method, why);
    }
    return any || error_set(error,
                            "slosh stability: --axis %s changes nothing: no method of the map reads it; name "
                            "another key",
                            axis->key);
}

/* Checks that the scene can be loaded at both ends of an axis. */
static bool check_ends(const StablePlan *plan, int a, Error *error)
{
    Scene scene;
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
    const StabilityOptions *own = args->own;
    int count = 0;
    while (own->axes[count])
        count++;
    if (count > STABLE_AXES)
        return error_set(error, "slosh stability: a map has %d axes at most; leave out --axis %.60s",
                         STABLE_AXES, own->axes[STABLE_AXES]);
    for (int a = 0; a < count; a++)
        if (!stable_axis_parse(own->axes[a], &plan->axis[a], error))
            return false;
    plan->axis_count = count;
    if (count == 0)
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
                             count > 0 ? "leave --particles out" : "name another --axis");
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
    RunSettings settings;
    const Args *args = plan->args;
    if (!begin(plan, NULL, &settings, error) ||
        !scene_load(plan->scene_name, &settings.all, &plan->scene, &plan->notes, error))
        return false;
    plan->notes.count = plan->notes.lasting; /* the dropped notes are about an unused step */
    plan->time = args_given(args, "--time") ? args->time : usual_time(&plan->scene.world);
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
    return check_sweeps(args, error) && find_scene(plan, error) && find_series(plan, error) &&
           find_axes(plan, error);
}
