#include "app/film/render_report.h"

#include "app/base/file.h"
#include "sim/base/stage.h"

#include <math.h>
#include <string.h>

static Summary summary_of(const Session sessions[], const RenderFigures *figures, int world)
{
    return (Summary){.command = "render",
                     .product = "pictures",
                     .products = figures->pictures,
                     .renderer = headless_renderer(sessions[0].context),
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
                "--interpolate shows all at that very time\n",
                figures->apart);
}

static void tell_world(const Session *session, double step_seconds, const Args *args)
{
    const WorldInfo *info = &session->info;
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
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", first->info.time, args->output);
    for (int i = 0; !args->quiet && i < plan->world_count; i++)
        tell_world(&sessions[i], figures->step_seconds[i], args);
    if (!args->quiet)
        tell_range(plan);
    tell_apart(plan, figures);
    tell_same(plan, figures);
    if (!args->quiet)
        fprintf(stderr, "%d panels, %.3g s simulated in %.3g s: %s, %zu picture%s\n", plan->panel_count,
                first->info.time, 1e-3 * (wall_ms() - first->began_ms), args->output, figures->pictures,
                plural(figures->pictures));
}

void render_tell_staying(const Args *args, size_t frames)
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
    const PanelPlace *at = &panels_places(panel_pictures->panels)[panel];
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
    return json_pack("{s:s, s:s, s:s, s:I, s:f, s:f, s:b, s:s, s:o}", "command", "render", "scene",
                     plan->scenes[0].path, "output", args->output, "pictures", (json_int_t)figures->pictures,
                     "simulated_seconds", sessions[0].info.time, "wall_seconds",
                     1e-3 * (wall_ms() - sessions[0].began_ms), "stopped", figures->stopped, "renderer",
                     headless_renderer(sessions[0].context), "panels", panels);
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
