#include "app/base/file.h"
#include "app/cli/cli_private.h"
#include "app/run/compare/compare.h"
#include "app/scene/scene.h"
#include "sim/flow/flow.h"
#include "sim/start/start.h"
#include "sim/world.h"

#include <math.h>
#include <string.h>

bool render_options_agree(const Args *args, Error *error)
{
    const RenderOptions *own = options_of_render(args);
    return !own->interpolate || !own->steps ||
           error_set(error,
                     "--interpolate shows what is between steps, and --steps the steps; leave one out");
}

/* True if a key belongs to the view: a single world then serves all values. */
static bool of_view(const char *key)
{
    return strncmp(key, "view.", strlen("view.")) == 0 || strncmp(key, "views", strlen("views")) == 0;
}

/* Adds the setting's name to the error, unless the message has it. */
static bool blame(const RenderPlan *plan, int setting, Error *error)
{
    const Error what = *error;
    return *plan->names[setting] && !strstr(what.message, "--compare")
               ? error_set(error, "with %s: %s", plan->names[setting], what.message)
               : false;
}

/* Loads a setting. `view`: an entry of `views` with settings applied on top; NULL: none. */
static bool load(const RenderPlan *plan, int setting, const ViewDef *view, int entry, Scene *scene,
                 Notes *notes, Error *error)
{
    static const ViewDef none;
    CompareSettings beside;
    const Args *args = plan->args;
    char said[ARGS_SWEEPS_MAX][SWEEP_SAID];
    SceneSettings settings = args->settings;
    for (int i = 0; i < args->sweep_count; i++)
        if (!sweep_set(args->sweeps[i].key, sweeps_value(args->sweeps, args->sweep_count, i, (size_t)setting),
                       "--compare", said[i], &settings, error))
            return false;
    return (compare_settings(&settings, view ? view : &none, entry, &beside, error) &&
            scene_load(args->scenes[0], &beside.settings, scene, notes, error) &&
            world_can(&scene->world, error)) ||
           blame(plan, setting, error);
}

/* Prints notes common to all settings once, the rest with the setting's name. */
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

static bool sets(const char *setting, const char *key)
{
    const size_t length = strlen(key);
    return strncmp(setting, key, length) == 0 && setting[length] == '=';
}

/* True if the view overrides the key. */
static bool has_own(const ViewDef *view, const char *key)
{
    for (const char *line = text_or_empty(view->set); *line; line += strcspn(line, "\n"), line += *line != 0)
        if (sets(line, key))
            return true;
    return false;
}

/* True if a world of the view is the same with two settings. */
static bool same_world(const RenderPlan *plan, const ViewDef *view, int a, int b)
{
    const Args *args = plan->args;
    bool same = true;
    for (int i = 0; i < args->sweep_count; i++)
        same &= of_view(args->sweeps[i].key) || has_own(view, args->sweeps[i].key) ||
                sweeps_value(args->sweeps, args->sweep_count, i, (size_t)a) ==
                    sweeps_value(args->sweeps, args->sweep_count, i, (size_t)b);
    return same;
}

static void append(char name[TITLE_SIZE], const char *words)
{
    const size_t used = strlen(name);
    if (*words)
        snprintf(name + used, TITLE_SIZE - used, "%s%s", used ? ", " : "", words);
}

/* Makes a panel's name: the setting without keys overridden by the view, then the view's settings.
   `of_views`: include keys of the view. */
static void name_panel(const RenderPlan *plan, int panel, bool of_views, char name[TITLE_SIZE])
{
    const Args *args = plan->args;
    char words[TITLE_SIZE];
    *name = 0;
    for (int i = 0; i < args->sweep_count; i++) {
        const char *key = args->sweeps[i].key;
        if ((of_view(key) && !of_views) || has_own(plan->views[panel], key) || strcmp(key, "view.time") == 0)
            continue;
        snprintf(words, sizeof words, "%s %s", sweep_typed(&args->sweeps[i]),
                 sweeps_value(args->sweeps, args->sweep_count, i, (size_t)plan->setting_of[panel]));
        append(name, words);
    }
    compare_name(plan->views[panel], words);
    append(name, words);
}

void render_plan_name(const RenderPlan *plan, int panel, char name[TITLE_SIZE])
{
    name_panel(plan, panel, true, name);
}

/* Returns the first earlier panel with the same states; the panel itself if there is none. */
static int first_alike(const RenderPlan *plan, int panel)
{
    for (int i = 0; i < panel; i++)
        if (compare_is_same(plan->views[i], plan->views[panel]) &&
            (plan->views[panel]->file ||
             same_world(plan, plan->views[i], plan->setting_of[i], plan->setting_of[panel])))
            return i;
    return panel;
}

static bool add_file(RenderPlan *plan, int panel, Notes *notes, Error *error)
{
    plan->file_of[panel] = plan->file_count;
    if (!compare_open_file(plan->scenes[0].path, plan->views[panel], panel / plan->setting_count,
                           &plan->files[plan->file_count], notes, error))
        return false;
    plan->file_count++;
    return true;
}

static bool add_world(RenderPlan *plan, int panel, Notes *notes, Error *error)
{
    const ViewDef *view = plan->views[panel];
    const int setting = plan->setting_of[panel], world = plan->world_count++;
    plan->world_of[panel] = world;
    plan->scene_of[world] = &plan->scenes[setting];
    name_panel(plan, panel, false, plan->worlds[world]);
    if (!compare_is_other(view))
        return true;
    plan->scene_of[world] = &plan->own[panel];
    return load(plan, setting, view, panel / plan->setting_count, &plan->own[panel], notes, error);
}

/* Shares the states of an earlier panel. Fails if attributes read only by this panel are missing. */
static bool share(RenderPlan *plan, int panel, int first, Error *error)
{
    const ViewDef *view = plan->views[panel];
    const int world = plan->world_of[first], file = plan->file_of[first];
    plan->world_of[panel] = world;
    plan->file_of[panel] = file;
    if (file >= 0)
        return recorded_has(&plan->files[file], view, error);
    if (!scene_view_reads_acceleration(view))
        return true;
    WorldDef *def = &plan->scene_of[world]->world;
    def->acceleration = true;
    return world_can(def, error) || blame(plan, plan->setting_of[panel], error);
}

static int find_leader(const RenderPlan *plan, int panel)
{
    for (int i = 0; i < plan->panel_count; i++)
        if (plan->setting_of[i] == plan->setting_of[panel] && !compare_is_other(plan->views[i]))
            return plan->world_of[i];
    return -1;
}

/* Finds the states of all panels; new notes go into `notes`. */
static bool find_states(RenderPlan *plan, Notes notes[PANELS_MAX], Error *error)
{
    for (int i = 0; i < plan->panel_count; i++) {
        const int first = first_alike(plan, i);
        plan->world_of[i] = plan->file_of[i] = -1;
        notes[i].count = 0;
        if (first < i ? !share(plan, i, first, error)
                      : !(plan->views[i]->file ? add_file : add_world)(plan, i, &notes[i], error))
            return false;
    }
    for (int i = 0; i < plan->panel_count; i++)
        plan->leader_of[i] = find_leader(plan, i);
    return true;
}

/* Arranges settings side by side, the views of each in a column. */
static bool lay_out(RenderPlan *plan, Error *error)
{
    const int views = scene_view_count(&plan->scenes[0]);
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
        plan->views[i] = scene_view(&plan->scenes[plan->setting_of[i]], i / plan->setting_count);
    }
    return true;
}

/* Checks the memory for all worlds together; the loader has checked each alone. */
static bool fit_together(const RenderPlan *plan, Error *error)
{
    double particles = 0;
    for (int i = 0; i < plan->world_count; i++) {
        const WorldDef *def = &plan->scene_of[i]->world;
        particles += (double)flow_capacity(def, seed_count(def, def->spacing));
    }
    return scene_fits_memory(particles) ||
           error_set(error,
                     "the %d settings have %.3g particles together, more than this machine can hold at a "
                     "time; use fewer",
                     plan->world_count, particles);
}

/* Rejects repeated keys and values: they would give equal panels, or panels with wrong names. */
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

/* Reports settings of the command line overridden by --compare. */
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

/* Prints notes on panels beside the scene, unless also noted for the scene. */
static void tell_own(const RenderPlan *plan, const Notes notes[], const Notes own[])
{
    for (int i = 0; i < plan->panel_count; i++)
        for (int k = 0; k < own[i].count; k++) {
            char words[COMPARE_NAME_SIZE];
            compare_name(plan->views[i], words);
            if (plan->file_of[i] >= 0) /* the note names the file */
                fprintf(stderr, "%s\n", own[i].line[k]);
            else if (!notes_have(&notes[plan->setting_of[i]], own[i].line[k]))
                fprintf(stderr, "%s: %s\n", words, own[i].line[k]);
        }
}

bool render_plan_make(const Args *args, RenderPlan *plan, Error *error)
{
    Notes notes[PANELS_MAX] = {{0}}, own[PANELS_MAX] = {{0}};
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
        if (!load(plan, i, NULL, 0, &plan->scenes[i], &notes[i], error))
            return false;
    }
    if (!lay_out(plan, error) || !find_states(plan, own, error))
        return false;
    tell_idle(args);
    tell_notes(plan, notes);
    tell_own(plan, notes, own);
    return fit_together(plan, error);
}

void render_plan_close(RenderPlan *plan)
{
    for (int i = 0; i < plan->file_count; i++)
        recorded_close(&plan->files[i]);
}

static Summary summary_of(const Session sessions[], const RenderFigures *figures, int world)
{
    return (Summary){.command = "render",
                     .product = "pictures",
                     .products = figures->pictures,
                     .renderer = headless_renderer(sessions[0].context),
                     .late = figures->late,
                     .step_seconds = figures->step_seconds[world],
                     .stopped = figures->stopped};
}

static void tell_alike(const RenderPlan *plan, int one, int other)
{
    const int a = plan->setting_of[one], b = plan->setting_of[other];
    if (a != b)
        fprintf(stderr, "%s and %s are the same in every picture: it makes no difference here\n",
                plan->names[a], plan->names[b]);
    else
        fprintf(stderr, "%s%sviews[%d] and views[%d] are the same in every picture\n", plan->names[a],
                *plan->names[a] ? ": " : "", one / plan->setting_count, other / plan->setting_count);
}

/* True if two settings reach neither panel: the views override all keys. */
static bool one_name(const RenderPlan *plan, int a, int b)
{
    char names[2][TITLE_SIZE];
    render_plan_name(plan, a, names[0]);
    render_plan_name(plan, b, names[1]);
    return plan->setting_of[a] != plan->setting_of[b] && strcmp(names[0], names[1]) == 0;
}

/* Reports equal panels, which could be taken for a mistake. */
static void tell_same(const RenderPlan *plan, const RenderFigures *figures)
{
    for (int a = 0; a < plan->panel_count; a++)
        for (int b = 0; b < a; b++)
            if (!figures->differ[a][b] && !one_name(plan, a, b))
                tell_alike(plan, b, a);
}

/* True if panels of several worlds share one automatic range. */
static bool shares_range(const RenderPlan *plan, int panel)
{
    bool shares = false;
    const ViewDef *own = plan->views[panel];
    for (int i = 0; i < plan->panel_count; i++) {
        const ViewDef *view = plan->views[i];
        shares |= plan->world_of[i] != plan->world_of[panel] && view->range_auto &&
                  view_color_by(view) == view_color_by(own);
    }
    return shares && own->range_auto && view_color_by(own) != SCALAR_FLUID;
}

static void tell_range(const RenderPlan *plan)
{
    bool shares = false;
    for (int i = 0; i < plan->panel_count; i++)
        shares |= shares_range(plan, i);
    if (shares)
        fprintf(stderr, "view.range auto: one range for all panels of a scalar, of all their particles in "
                        "each picture\n");
}

/* Reports time differences between panels with fixed steps of different lengths. */
static void tell_apart(const RenderPlan *plan, const RenderFigures *figures)
{
    if (!figures->stopped && figures->apart > 1e-6 * plan->scenes[0].world.dt)
        fprintf(stderr,
                "panels show their first states at or after a picture's time, up to %.3g s apart; "
                "%s shows all at that very time\n",
                figures->apart,
                options_of_render(plan->args)->steps ? "leaving --steps out" : "--interpolate");
}

static void tell_world(const Session *session, double step_seconds, const Args *args)
{
    const WorldInfo *info = &session->run.info;
    fprintf(stderr, "%s%zu particle%s, %.3g s simulated in %.3g s of steps (%.3g times real time)\n",
            session->prefix, info->count, plural(info->count), info->time, step_seconds,
            info->time / fmax(step_seconds, 1e-6));
    session_report_steps(session, args);
}

static void report_several(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures)
{
    const Args *args = plan->args;
    const Session *first = &sessions[0];
    if (figures->stopped)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", first->run.info.time, args->output);
    for (int i = 0; !args->quiet && i < plan->world_count; i++)
        tell_world(&sessions[i], figures->step_seconds[i], args);
    if (!args->quiet)
        tell_range(plan);
    tell_apart(plan, figures);
    tell_same(plan, figures);
    if (!args->quiet)
        fprintf(stderr, "%d panels, %.3g s simulated in %.3g s: %s, %zu picture%s\n", plan->panel_count,
                first->run.info.time, 1e-3 * (wall_ms() - first->began_ms), args->output, figures->pictures,
                plural(figures->pictures));
}

void render_report_kept(const Args *args, size_t frames)
{
    if (frames > 0)
        fprintf(stderr, "%s: the %zu picture%s before that %s whole and kept\n", args->output, frames,
                plural(frames), frames == 1 ? "is" : "are");
}

void render_report(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures)
{
    const Summary summary = summary_of(sessions, figures, 0);
    if (plan->panel_count > 1)
        report_several(plan, sessions, figures);
    else
        session_report(&sessions[0], plan->args, &summary);
}

/* Adds the source of the panel's states. */
static void add_source(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures,
                       int panel, json_t *json)
{
    const int world = plan->world_of[panel];
    if (world < 0) {
        json_object_set_new(json, "file", json_string(plan->files[plan->file_of[panel]].path));
        return;
    }
    const Summary summary = summary_of(sessions, figures, world);
    json_object_set_new(json, "world", json_integer(world));
    json_object_set_new(json, "run", session_json(&sessions[world], plan->args, &summary));
}

static json_t *panel_json(const RenderPlan *plan, const Session sessions[],
                          const PanelPictures *panel_pictures, const RenderFigures *figures, int panel)
{
    const ViewDef *view = plan->views[panel];
    const PanelRect *at = &panels_rects(panel_pictures->panels)[panel];
    char name[TITLE_SIZE];
    double range[2];
    render_plan_name(plan, panel, name);
    panels_range(panel_pictures->panels, panel, range);
    json_t *json =
        json_pack("{s:s, s:[i,i,i,i], s:s, s:s, s:f}", "setting", name, "place", at->x, at->y, at->width,
                  at->height, "view", view->kind, "scalar", scalar_name(view_color_by(view)), "time",
                  panel_pictures->sources[panel_pictures->source_of[panel]].state.time);
    add_source(plan, sessions, figures, panel, json);
    if (json && view_color_by(view) != SCALAR_FLUID)
        json_object_set_new(json, "range", json_pack("[f,f]", range[0], range[1]));
    return json;
}

static json_t *several_json(const RenderPlan *plan, const Session sessions[],
                            const PanelPictures *panel_pictures, const RenderFigures *figures)
{
    const Args *args = plan->args;
    json_t *panels = json_array();
    for (int i = 0; i < plan->panel_count; i++)
        json_array_append_new(panels, panel_json(plan, sessions, panel_pictures, figures, i));
    return json_pack("{s:s, s:s, s:s, s:I, s:f, s:f, s:f, s:b, s:s, s:o}", "command", "render", "scene",
                     plan->scenes[0].path, "output", args->output, "pictures", (json_int_t)figures->pictures,
                     "picture_late_seconds", figures->late, "simulated_seconds", sessions[0].run.info.time,
                     "wall_seconds", 1e-3 * (wall_ms() - sessions[0].began_ms), "stopped", figures->stopped,
                     "renderer", headless_renderer(sessions[0].context), "panels", panels);
}

bool render_write_json(const RenderPlan *plan, const Session sessions[], const PanelPictures *panel_pictures,
                       const RenderFigures *figures, Error *error)
{
    const Args *args = plan->args;
    const Summary summary = summary_of(sessions, figures, 0);
    if (!args->json)
        return true;
    if (plan->panel_count == 1)
        return session_write_json(&sessions[0], args, &summary, error);
    json_t *json = several_json(plan, sessions, panel_pictures, figures);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}
