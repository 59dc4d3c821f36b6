#include "app/fit/fit_axes.h"

#include "app/scene/keys.h"
#include "app/scene/scene.h"
#include "sim/world/method.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Times the scene's spacing. The finest stays well above the reference's 0.5. */
static const double spacings[] = {4, 3, 2.5, 2, 1.75, 1.5, 1.25, 1, 0.75};

/* Times the scene's step. */
static const double steps[] = {0.25, 0.5, 0.7, 1, 1.4, 2, 2.8, 4};

/* 2.1: as many neighbours as methods for play have; 2.6, 3, 3.5: supports of the measurements in three and
   in two dimensions. */
static const char *const supports[] = {NULL, "2.1", "2.6", "3", "3.5"};

/* Terms of a method, and kernels: they change error and cost, but not the flow. */
static const struct {
    const char *path, *value[4]; /* the first: NULL, the scene's own */
    bool inviscid;               /* only for scenes with inviscid fluid */
} terms[FIT_TERMS] = {
    {"solver.kernel", {NULL, "wendland_c2", "cubic"}, false},
    {"solver.delta_sph", {NULL, "0", "0.1"}, false},
    {"solver.shifting", {NULL, "0", "0.2"}, false},
    {"solver.corrected_gradient", {NULL, "false", "true"}, false},
    {"solver.artificial_viscosity", {NULL, "0", "0.02"}, true},
};

enum { SPACINGS = sizeof spacings / sizeof *spacings, STEPS = sizeof steps / sizeof *steps };

__attribute__((format(printf, 2, 3))) static void add(FitJob *job, const char *format, ...)
{
    va_list arguments;
    char *text = job->text[job->job.set_count];
    const int said = snprintf(text, sizeof job->text[0], "--sweep ");
    va_start(arguments, format);
    vsnprintf(text + said, sizeof job->text[0] - (size_t)said, format, arguments);
    va_end(arguments);
    job->job.set[job->job.set_count++] = text;
}

/* Starts a job with the scene's own spacing and step. */
static void start_job(const FitAxes *axes, const char *method, const char *preset, FitJob *job)
{
    *job = (FitJob){.job = {.role = CHART_POINT,
                            .method = method,
                            .backend = axes->scene->world.backend,
                            .coarsening = 1,
                            .step_unnamed = true}};
    if (preset)
        add(job, "solver.preset=%s", preset);
}

static bool load(const FitAxes *axes, const FitJob *job, Scene *scene, ChartRow *row)
{
    Error none;
    return chart_prepare(&axes->subject, &job->job, scene, row, NULL, &none);
}

/* True if equal as texts or as numbers: "0.1" equals "0.10". */
static bool same_value(const char *a, const char *b)
{
    char *end_a, *end_b;
    const double x = strtod(a, &end_a), y = strtod(b, &end_b);
    return strcmp(a, b) == 0 || (end_a != a && end_b != b && !*end_a && !*end_b && x == y);
}

/* True if the scene has the value already. */
static bool is_own(const Scene *scene, const char *path, const char *value)
{
    char now[128];
    key_value_text(scene_key_find(path), scene, now, sizeof now);
    return same_value(now, value);
}

/* Adds steps `factor` times as long as the steps of `scene`, loaded without this setting. Substeps per
   frame are whole numbers; with a single substep the frame itself gets longer. */
static void add_step(FitJob *job, const Scene *scene, double factor)
{
    const WorldDef *def = &scene->world;
    if (factor == 1)
        return;
    if (def->step_mode == STEP_CFL) {
        add(job, "solver.step.number=%.4g", def->cfl_number * factor);
        if (method_find(def->method)->incompressible) /* max_dt bounds the step of a slow fluid */
            add(job, "solver.step.max_dt=%.4g", def->max_dt * factor);
        return;
    }
    const double wanted = def->substeps / factor;
    const int substeps = wanted > 1 ? (int)lround(wanted) : 1;
    add(job, "solver.step.substeps=%d", substeps);
    if (wanted < 1)
        add(job, "solver.step.dt=%.4g", def->dt / wanted);
}

bool fit_axes_job(const FitAxes *axes, const FitPoint *point, FitJob *job)
{
    static Scene scene;
    static ChartRow row;
    const int *at = point->at, method = at[FIT_METHOD];
    start_job(axes, axes->method[method], axes->preset[at[FIT_PRESET]], job);
    if (!load(axes, job, &scene, &row))
        return true; /* chart_prepare reports the reason */
    if (at[FIT_SUPPORT] > 0) {
        if (is_own(&scene, "particles.support", supports[at[FIT_SUPPORT]]))
            return false;
        add(job, "particles.support=%s", supports[at[FIT_SUPPORT]]);
    }
    for (int t = 0; t < FIT_TERMS; t++) {
        const char *value = terms[t].value[at[FIT_TERM + t]];
        if (!value)
            continue;
        if (!axes->effect[method][t] || is_own(&scene, terms[t].path, value))
            return false;
        add(job, "%s=%s", terms[t].path, value);
    }
    add_step(job, &scene, steps[at[FIT_STEP]]);
    job->job.coarsening = spacings[at[FIT_SPACING]];
    return true;
}

double fit_axes_work(const FitAxes *axes, const FitPoint *point)
{
    const WorldDef *def = &axes->scene->world;
    const char *support = supports[point->at[FIT_SUPPORT]];
    const double reach = support ? strtod(support, NULL) : def->support;
    return pow(spacings[point->at[FIT_SPACING]], -def->dimensions - 1) / steps[point->at[FIT_STEP]] *
           pow(reach, def->dimensions);
}

/* ---- values of the axes ---- */

static bool is_named(const Scene *scene, const char *method)
{
    return strcmp(scene->world.method, method) == 0;
}

/* Finds the methods able to run the scene, the scene's own first. */
static void find_methods(FitAxes *axes, Notes *notes)
{
    static Scene scene;
    static ChartRow row;
    const char *all[FIT_METHODS];
    int count = 0, *found = &axes->axis[FIT_METHOD].values;
    const Case *of = axes->subject.of;
    const char *only = chart_set_value(axes->subject.settings, "solver.method");
    if (only)
        all[count++] = only;
    for (const CaseMethod *at = of ? of->methods : NULL; !only && at && at->name && count < FIT_METHODS; at++)
        if (at->left_out)
            notes_add(notes, "left out: %s with %s, %s", of->name, at->name, at->left_out);
        else
            all[count++] = at->name;
    for (int i = 0; !only && !of && i < FIT_METHODS && world_methods()[i].name; i++)
        all[count++] = world_methods()[i].name;
    for (int own = 1; own >= 0; own--)
        for (int i = 0; i < count; i++) {
            FitJob job;
            Error why;
            if (is_named(axes->scene, all[i]) != own)
                continue;
            start_job(axes, all[i], NULL, &job);
            if (chart_prepare(&axes->subject, &job.job, &scene, &row, NULL, &why))
                axes->method[(*found)++] = all[i];
            else
                notes_add(notes, "left out: %s: %.300s", all[i], why.message);
        }
}

/* Finds the presets: the scene's own, and presets with other settings. The first preset of the list sets
   almost nothing. */
static void find_presets(FitAxes *axes)
{
    int *found = &axes->axis[FIT_PRESET].values;
    axes->preset[(*found)++] = NULL;
    if (chart_set_value(axes->subject.settings, "solver.preset"))
        return;
    for (const SolverPreset *preset = solver_preset_list; preset->name && *found < FIT_PRESETS; preset++)
        if (strcmp(preset->name, axes->scene->preset) != 0)
            axes->preset[(*found)++] = preset->name;
}

static bool has_inviscid(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        if (fluid_viscosity_most(&def->fluids[f]) == 0)
            return true;
    return false;
}

/* Finds the terms read by each method. */
static void find_effects(FitAxes *axes)
{
    static Scene scene;
    static ChartRow row;
    static Notes notes;
    for (int m = 0; m < axes->axis[FIT_METHOD].values; m++) {
        FitJob job;
        start_job(axes, axes->method[m], NULL, &job);
        const bool read = load(axes, &job, &scene, &row);
        scene.purpose = SCENE_FOR_CHART;
        for (int t = 0; t < FIT_TERMS; t++) {
            notes.count = 0;
            scene_advise_key(&scene, terms[t].path, &notes);
            axes->effect[m][t] =
                read && notes.count == 0 && (!terms[t].inviscid || has_inviscid(&scene.world));
        }
    }
}

static int place_of(const double list[], int count, double wanted)
{
    for (int i = 0; i < count; i++)
        if (list[i] == wanted)
            return i;
    return 0;
}

void fit_axes_make(const ChartSubject *subject, const Scene *scene, FitAxes *axes, Notes *notes)
{
    *axes = (FitAxes){.subject = *subject, .scene = scene, .axes = FIT_TERM + FIT_TERMS};
    _Static_assert(FIT_TERM + FIT_TERMS <= FIT_AXES && (int)SPACINGS <= (int)FIT_VALUES, "room for all");
    axes->axis[FIT_METHOD].kind = axes->axis[FIT_PRESET].kind = FIT_LINE;
    axes->axis[FIT_SPACING] = (FitAxis){FIT_LADDER, SPACINGS, place_of(spacings, SPACINGS, 1)};
    axes->axis[FIT_STEP] = (FitAxis){FIT_ORDERED, STEPS, place_of(steps, STEPS, 1)};
    axes->axis[FIT_SUPPORT] = (FitAxis){FIT_FREE, sizeof supports / sizeof *supports, 0};
    if (chart_set_value(axes->subject.settings, "particles.support"))
        axes->axis[FIT_SUPPORT].values = 1;
    for (int t = 0; t < FIT_TERMS; t++) {
        FitAxis *axis = &axes->axis[FIT_TERM + t];
        *axis = (FitAxis){FIT_FREE, 1, 0};
        while (!chart_set_value(axes->subject.settings, terms[t].path) && terms[t].value[axis->values])
            axis->values++;
    }
    find_methods(axes, notes);
    find_presets(axes);
    find_effects(axes);
}
