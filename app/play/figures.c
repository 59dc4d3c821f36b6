#include "app/play/figures.h"

#include "app/scene/keys.h"
#include "sim/base/scalar.h"
#include "sim/base/stage.h"
#include "sim/gl/debug.h"
#include "sim/world/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int threads_of(const WorldDef *def)
{
    if (world_on_gpu(def))
        return 0;
    const int threads = *world_threads(def);
    return threads ? threads : world_processors();
}

static void add_model(const Model *model, PlayFigures *figures)
{
    const WorldDef *def = &model->open.scene.world;
    const SimulatorStatus *status = &model->status;
    figures->recorded = !model->open.source->simulates;
    snprintf(figures->script, sizeof figures->script, "%s", script_name(status->script));
    figures->threads = threads_of(def);
    figures->substeps = def->substeps;
    figures->dt =
        def->step_mode == STEP_CFL && status->frames > 0 ? status->time / (double)status->frames : def->dt;
    figures->particles = status->particles;
    figures->scenes_opened = model->scenes_opened;
    figures->step = status->step;
    figures->solved = status->solved;
    memcpy(figures->limited, status->limited, sizeof figures->limited);
    figures->time = status->time;
    figures->simulated_s = model->simulated_s + status->simulated_s;
    figures->sim_ms = status->frames ? status->solved_ms / (double)status->frames : 0;
    figures->speed = model->speed;
    figures->paused = model->paused;
    memcpy(figures->box_size, model->particles.box_size, sizeof figures->box_size);
    memcpy(figures->box_position, status->hand.position, sizeof figures->box_position);
    memcpy(figures->box_orientation, status->hand.orientation, sizeof figures->box_orientation);
    snprintf(figures->scene, sizeof figures->scene, "%s", model->open.scene.path);
    snprintf(figures->backend, sizeof figures->backend, "%s", def->backend);
    snprintf(figures->method, sizeof figures->method, "%s", def->method);
}

static void add_view(const ViewDef *view, PlayFigures *figures)
{
    figures->camera_auto = view->camera_auto;
    memcpy(figures->camera_from, view->camera.from, sizeof figures->camera_from);
    memcpy(figures->camera_to, view->camera.to, sizeof figures->camera_to);
    snprintf(figures->view, sizeof figures->view, "%s", view->kind);
    snprintf(figures->color_by, sizeof figures->color_by, "%s", scalar_name(view_color_by(view)));
    snprintf(figures->colormap, sizeof figures->colormap, "%s", view_colormap(view));
}

/* Writes JSON as text; writes `none` if the text does not fit. */
static void write_json(json_t *json, const char *none, char *text, size_t size)
{
    const size_t length = json_dumpb(json, text, size - 1, JSON_COMPACT);
    if (length == 0 || length >= size)
        snprintf(text, size, "%s", none);
    json_decref(json);
}

static void add_readout(const Readout *readout, PlayFigures *figures)
{
    static const char *const words[] = {[VIEW_PROBE_OFF] = "off",
                                        [VIEW_PROBE_EMPTY] = "empty",
                                        [VIEW_PROBE_NAN] = "nan",
                                        [VIEW_PROBE_VALUE] = "value"};
    json_t *all = json_array();
    const ViewProbes *found = &readout->found;
    for (int i = 0; i < found->count; i++) {
        const ViewProbe *probe = &found->probe[i];
        json_array_append_new(all,
                              json_pack("{s:s, s:s, s:s, s:f, s:[f,f,f], s:I, s:b}", "what",
                                        words[probe->what], "name", probe->name, "unit", probe->unit, "value",
                                        probe->what == VIEW_PROBE_VALUE ? probe->value : 0, "at",
                                        probe->at[0], probe->at[1], probe->at[2], "id", (json_int_t)probe->id,
                                        "pinned", i < found->count - found->mouse));
    }
    write_json(all, "[]", figures->readout, sizeof figures->readout);
}

/* Adds the keys of the shown view, as changed by panel, keys and handles. */
static void add_view_settings(const Scene *scene, PlayFigures *figures)
{
    char path[NAME_SIZE + 8];
    const char *key;
    json_t *value, *all = scene_json(scene), *own = json_object();
    snprintf(path, sizeof path, "view.%s.", scene->view.kind);
    json_object_foreach(all, key, value)
    {
        if (strncmp(key, path, strlen(path)) == 0)
            json_object_set(own, key, value);
    }
    write_json(own, "{}", figures->view_settings, sizeof figures->view_settings);
    json_decref(all);
}

static void add_meter(const PlayMeter *meter, PlayFigures *figures)
{
    figures->pictures = meter->pictures;
    figures->first_picture_ms = meter->first_ms;
    figures->render_ms = meter_drawn_mean(meter);
    figures->panel_ms = meter_panel_mean(meter);
    figures->events_ms = meter_events_mean(meter);
    figures->latency_median_ms = meter_latency(meter, 0.5);
    figures->latency_p95_ms = meter_latency(meter, 0.95);
    figures->latency_events = meter->latencies;
}

/* Adds the rates since the first picture. */
static void add_rates(const PlayMeter *meter, PlayFigures *figures)
{
    const double wall = 1e-3 * (wall_ms() - meter->began_ms);
    if (meter->began_ms <= 0)
        return;
    figures->wall_s = wall;
    figures->real_time_factor = figures->simulated_s / wall;
    figures->pictures_per_second = (double)(meter->pictures - 1) / wall;
    figures->frame_ms = 1000 / fmax(figures->pictures_per_second, 1e-3);
    figures->cpus_busy = 1e-3 * (meter_cpu_ms() - meter->began_cpu_ms) / wall;
}

void figures_of(const Play *play, PlayFigures *figures)
{
    *figures = (PlayFigures){.width = play->picture.width,
                             .height = play->picture.height,
                             .device_reports = box_control_reports(play->control),
                             .report_median_ms = box_control_latency(play->control, 0.5),
                             .report_p99_ms = box_control_latency(play->control, 0.99),
                             .display_scale = window_scale(play->window),
                             .fullscreen = window_is_fullscreen(play->window),
                             .panel = play->overlay.panel,
                             .help = play->overlay.help,
                             .scenes = play->overlay.scenes,
                             .gl_errors = gl_debug_errors()};
    snprintf(figures->renderer, sizeof figures->renderer, "%s", window_renderer(play->window));
    add_model(&play->model, figures);
    add_view(&play->model.open.scene.view, figures);
    add_view_settings(&play->model.open.scene, figures);
    add_readout(&play->readout, figures);
    figures->at_rest = play->model.status.rests && !model_fresh(&play->model) && !play->files.shoot &&
                       picture_rests(&play->picture);
    figures->finer_to_come = play->picture.finer;
    figures->video_pictures = play->files.pictures;
    figures->views = scene_view_count(&play->model.open.scene);
    for (int i = 0; i < figures->views; i++)
        figures->times[i] =
            model_state(&play->model, views_def(&play->views, &play->model.open.scene, i))->time;
    figures->chosen_view = views_panel(&play->views, &play->model.open.scene);
    add_meter(&play->meter, figures);
    add_rates(&play->meter, figures);
}
