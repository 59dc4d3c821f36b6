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
    return strncmp(key, "view.", strlen("view.")) == 0;
}

/* What went wrong with the settings of a panel, unless the message names them already. */
static bool blame(const RenderPlan *plan, int panel, Error *error)
{
    const Error what = *error;
    return *plan->names[panel] && !strstr(what.message, "--compare")
               ? error_set(error, "with %s: %s", plan->names[panel], what.message)
               : false;
}

static bool load(const RenderPlan *plan, int panel, Scene *scene, Notes *notes, Error *error)
{
    const Args *args = plan->args;
    char said[ARGS_SWEEPS_MAX][SWEEP_SAID];
    SceneSettings settings = args->settings;
    for (int i = 0; i < args->sweep_count; i++)
        if (!sweep_set(args->sweeps[i].key, sweeps_value(args->sweeps, args->sweep_count, i, (size_t)panel),
                       "--compare", said[i], &settings, error))
            return false;
    return (scene_load(args->scenes[0], &settings, scene, notes, error) && world_can(&scene->world, error)) ||
           blame(plan, panel, error);
}

/* What holds for all panels once, the rest with the name of its panel. */
static void tell_notes(const RenderPlan *plan, const Notes notes[])
{
    for (int i = 0; i < plan->panel_count; i++)
        for (int k = 0; k < notes[i].count; k++) {
            bool everywhere = true;
            for (int other = 0; other < plan->panel_count; other++)
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

static void name_world(const RenderPlan *plan, int panel, char name[TITLE_SIZE])
{
    const Args *args = plan->args;
    size_t used = 0;
    *name = 0;
    for (int i = 0; i < args->sweep_count && used < TITLE_SIZE; i++)
        if (!of_view(args->sweeps[i].key))
            used += (size_t)snprintf(name + used, TITLE_SIZE - used, "%s%s %s", used ? ", " : "",
                                     args->sweeps[i].key,
                                     sweeps_value(args->sweeps, args->sweep_count, i, (size_t)panel));
}

static void find_worlds(RenderPlan *plan)
{
    for (int i = 0; i < plan->panel_count; i++) {
        int first = 0;
        while (!same_world(plan, first, i))
            first++;
        plan->world_of[i] = first < i ? plan->world_of[first] : plan->world_count;
        if (first < i)
            continue;
        name_world(plan, i, plan->worlds[plan->world_count]);
        plan->panel_of[plan->world_count++] = i;
    }
}

/* Each world for itself fits, as the loader has seen. */
static bool fit_together(const RenderPlan *plan, Error *error)
{
    double particles = 0;
    for (int i = 0; i < plan->world_count; i++) {
        const WorldDef *def = &plan->scenes[plan->panel_of[i]].world;
        particles += (double)flow_capacity(def, seed_count(def, def->spacing));
    }
    return scene_fits_memory(particles) ||
           error_set(error,
                     "the %d settings have %.3g particles together, more than this machine can hold at a "
                     "time; use fewer",
                     plan->world_count, particles);
}

bool render_plan_make(const Args *args, RenderPlan *plan, Error *error)
{
    static Notes notes[PANELS_MAX];
    const size_t panels = sweeps_combinations(args->sweeps, args->sweep_count);
    *plan = (RenderPlan){.args = args, .panel_count = (int)panels};
    if (args->sweep_count && panels != 2 && panels != 4)
        return error_set(error,
                         "slosh render: --compare shows two or four settings side by side, not %zu; name two "
                         "or four values of a key, or two of two keys each",
                         panels);
    for (int i = 0; i < plan->panel_count; i++) {
        sweeps_name(args->sweeps, args->sweep_count, (size_t)i, " ", plan->names[i], TITLE_SIZE);
        if (!load(plan, i, &plan->scenes[i], &notes[i], error))
            return false;
    }
    find_worlds(plan);
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
    memcpy(title->words, plan->names[panel], sizeof title->words);
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
