#include "app/command/render_plan.h"

#include "app/scene/check.h"
#include "app/session/sweep.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"
#include "sim/world/world.h"

#include <string.h>

/* Whether a key is of the view alone: then one world serves all its values. */
static bool of_view(const char *key)
{
    return strncmp(key, "view.", strlen("view.")) == 0 || strncmp(key, "views", strlen("views")) == 0;
}

/* What went wrong with a setting, unless the message names it already. */
static bool blame(const RenderPlan *plan, int setting, Error *error)
{
    const Error what = *error;
    return *plan->names[setting] && !strstr(what.message, "--compare")
               ? error_set(error, "with %s: %s", plan->names[setting], what.message)
               : false;
}

static bool load(const RenderPlan *plan, int setting, Scene *scene, Notes *notes, Error *error)
{
    const Args *args = plan->args;
    char said[ARGS_SWEEPS_MAX][SWEEP_SAID];
    SceneSettings settings = args->settings;
    for (int i = 0; i < args->sweep_count; i++)
        if (!sweep_set(args->sweeps[i].key, sweeps_value(args->sweeps, args->sweep_count, i, (size_t)setting),
                       "--compare", said[i], &settings, error))
            return false;
    return (scene_load(args->scenes[0], &settings, scene, notes, error) && world_can(&scene->world, error)) ||
           blame(plan, setting, error);
}

/* What holds for all settings once, the rest with the name of its setting. */
static void tell_notes(const RenderPlan *plan, const Notes notes[])
{
    for (int i = 0; i < plan->setting_count; i++)
        for (int k = 0; k < notes[i].count; k++) {
            bool everywhere = true;
            for (int other = 0; other < plan->setting_count; other++)
                everywhere &= notes_have(&notes[other], notes[i].line[k]);
            const bool named = everywhere || strstr(notes[i].line[k], "--compare");
            if (!everywhere || i == 0)
                fprintf(stderr, "%s%s%s\n", named ? "" : plan->names[i], named ? "" : ": ", notes[i].line[k]);
        }
}

static bool same_world(const RenderPlan *plan, int a, int b)
{
    const Args *args = plan->args;
    bool same = true;
    for (int i = 0; i < args->sweep_count; i++)
        same &=
            of_view(args->sweeps[i].key) || sweeps_value(args->sweeps, args->sweep_count, i, (size_t)a) ==
                                                sweeps_value(args->sweeps, args->sweep_count, i, (size_t)b);
    return same;
}

static void name_world(const RenderPlan *plan, int setting, char name[TITLE_SIZE])
{
    const Args *args = plan->args;
    size_t used = 0;
    *name = 0;
    for (int i = 0; i < args->sweep_count && used < TITLE_SIZE; i++)
        if (!of_view(args->sweeps[i].key))
            used += (size_t)snprintf(name + used, TITLE_SIZE - used, "%s%s %s", used ? ", " : "",
                                     args->sweeps[i].key,
                                     sweeps_value(args->sweeps, args->sweep_count, i, (size_t)setting));
}

/* The world of each setting. */
static void find_worlds(RenderPlan *plan, int world_of[PANELS_MAX])
{
    for (int i = 0; i < plan->setting_count; i++) {
        int first = 0;
        while (!same_world(plan, first, i))
            first++;
        world_of[i] = first < i ? world_of[first] : plan->world_count;
        if (first < i)
            continue;
        name_world(plan, i, plan->worlds[plan->world_count]);
        plan->first_of[plan->world_count++] = i;
    }
}

/* Settings beside one another, the views of each below one another. */
static bool lay_out(RenderPlan *plan, Error *error)
{
    const int views = scene_view_count(&plan->scenes[0]);
    int world_of[PANELS_MAX] = {0};
    find_worlds(plan, world_of);
    plan->panel_count = plan->setting_count * views;
    for (int i = 1; i < plan->setting_count; i++)
        if (scene_view_count(&plan->scenes[i]) != views)
            return error_set(error, "slosh render: --compare needs as many views with %s as with %s",
                             plan->names[i], plan->names[0]);
    if (plan->panel_count > PANELS_MAX)
        return error_set(error,
                         "slosh render: %d settings with %d views each are %d panels; at most %d have room: "
                         "compare fewer, or leave entries of views out",
                         plan->setting_count, views, plan->panel_count, PANELS_MAX);
    for (int i = 0; i < plan->panel_count; i++) {
        plan->setting_of[i] = i % plan->setting_count;
        plan->world_of[i] = world_of[plan->setting_of[i]];
        plan->views[i] = scene_view(&plan->scenes[plan->setting_of[i]], i / plan->setting_count);
    }
    return true;
}

/* Each world for itself fits, as the loader has seen. */
static bool fit_together(const RenderPlan *plan, Error *error)
{
    double particles = 0;
    for (int i = 0; i < plan->world_count; i++) {
        const WorldDef *def = &plan->scenes[plan->first_of[i]].world;
        particles += (double)flow_capacity(def, seed_count(def, def->spacing));
    }
    return scene_fits_memory(particles) ||
           error_set(error,
                     "the %d settings have %.3g particles together, more than this machine can hold at a "
                     "time; use fewer",
                     plan->world_count, particles);
}

/* The same twice would be a panel twice, or one that shows another value than its name says. */
static bool check_sweeps(const Args *args, Error *error)
{
    for (int i = 0; i < args->sweep_count; i++) {
        const Sweep *sweep = &args->sweeps[i];
        for (int k = 0; k < i; k++)
            if (strcmp(sweep->key, args->sweeps[k].key) == 0)
                return error_set(error, "--compare %s stands twice; name all its values in one", sweep->key);
        for (int a = 0; a < sweep->count; a++)
            for (int b = 0; b < a; b++)
                if (strcmp(sweep->values[a], sweep->values[b]) == 0)
                    return error_set(error, "--compare %s has the value %s twice", sweep->key,
                                     sweep->values[a]);
    }
    return true;
}

static bool sets(const char *setting, const char *key)
{
    const size_t length = strlen(key);
    return strncmp(setting, key, length) == 0 && setting[length] == '=';
}

/* What the command line sets besides, where each panel has its own. */
static void tell_idle(const Args *args)
{
    const SceneSettings *settings = &args->settings;
    for (int i = 0; i < args->sweep_count; i++) {
        const char *key = args->sweeps[i].key;
        if (strcmp(key, "particles") == 0 && settings->particles > 0)
            fprintf(stderr, "--particles %zu has no effect: --compare %s decides\n", settings->particles,
                    key);
        for (int k = 0; k < settings->count; k++)
            if (sets(settings->set[k], key))
                fprintf(stderr, "%s%s has no effect: --compare %s decides\n",
                        settings->said[k] ? "" : "--set ",
                        settings->said[k] ? settings->said[k] : settings->set[k], key);
    }
}

bool render_plan_make(const Args *args, RenderPlan *plan, Error *error)
{
    static Notes notes[PANELS_MAX];
    const size_t settings = sweeps_combinations(args->sweeps, args->sweep_count);
    *plan = (RenderPlan){.args = args, .setting_count = (int)settings};
    if (args->sweep_count && settings != 2 && settings != 4)
        return error_set(error,
                         "slosh render: --compare shows two or four settings side by side, not %zu; name two "
                         "or four values of a key, or two of two keys each",
                         settings);
    if (!check_sweeps(args, error))
        return false;
    for (int i = 0; i < plan->setting_count; i++) {
        sweeps_name(args->sweeps, args->sweep_count, (size_t)i, " ", plan->names[i], TITLE_SIZE);
        if (!load(plan, i, &plan->scenes[i], &notes[i], error))
            return false;
    }
    if (!lay_out(plan, error))
        return false;
    tell_idle(args);
    tell_notes(plan, notes);
    return fit_together(plan, error);
}

/* What panels may differ in besides their names. */
typedef struct Figure {
    const char *key; /* that says it; "": none does */
    void (*text)(const Session *session, char out[64]);
} Figure;

static void count_text(const Session *session, char out[64])
{
    snprintf(out, 64, "%zu particle%s", session->info.count, plural(session->info.count));
}

static void spacing_text(const Session *session, char out[64])
{
    snprintf(out, 64, "spacing %.3g mm", 1e3 * session->info.spacing);
}

static void method_text(const Session *session, char out[64])
{
    snprintf(out, 64, "method %s", session->scene.world.method);
}

static void step_text(const Session *session, char out[64])
{
    const WorldDef *def = &session->scene.world;
    if (def->step_mode == STEP_FIXED)
        snprintf(out, 64, "steps of %.3g ms", 1e3 * def->dt / def->substeps);
    else
        snprintf(out, 64, "steps by cfl");
}

static const Figure figures[] = {
    {"", count_text}, {"particles.spacing", spacing_text}, {"solver.method", method_text}, {"", step_text}};

static bool is_compared(const RenderPlan *plan, const char *key)
{
    bool compared = false;
    for (int i = 0; i < plan->args->sweep_count; i++)
        compared |= strcmp(plan->args->sweeps[i].key, key) == 0;
    return compared;
}

void render_plan_title(const RenderPlan *plan, const Session sessions[], int panel, Title *title)
{
    size_t used = 0;
    memcpy(title->words, plan->names[plan->setting_of[panel]], sizeof title->words);
    *title->figures = 0;
    for (size_t f = 0; f < sizeof figures / sizeof *figures; f++) {
        char own[64], other[64];
        bool differs = false;
        figures[f].text(&sessions[plan->world_of[panel]], own);
        for (int w = 0; w < plan->world_count; w++) {
            figures[f].text(&sessions[w], other);
            differs |= strcmp(own, other) != 0;
        }
        if (differs && !is_compared(plan, figures[f].key) && used < TITLE_SIZE)
            used += (size_t)snprintf(title->figures + used, TITLE_SIZE - used, "%s%s", used ? ", " : "", own);
    }
}
