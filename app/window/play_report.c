#include "app/base/file.h"
#include "app/bench/bench.h"
#include "app/run/session.h"
#include "app/scene/scene.h"
#include "app/window/play.h"
#include "app/window/play_private.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static json_t *vector(const double *v, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, json_real(v[i]));
    return array;
}

static json_t *figures_scene_json(const PlayFigures *f)
{
    json_t *json = json_pack("{s:s, s:s, s:s, s:s, s:i, s:s, s:[i, i], s:I, s:f, s:i}", "scene", f->scene,
                             "backend", f->backend, "method", f->method, "view", f->view, "threads",
                             f->threads, "renderer", f->renderer, "size", f->width, f->height, "particles",
                             (json_int_t)f->particles, "dt", f->dt, "substeps", f->substeps);
    json_t *times =
        json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:I}", "real_time_factor",
                  f->real_time_factor, "pictures_per_second", f->pictures_per_second, "frame_ms", f->frame_ms,
                  "sim_ms", f->sim_ms, "render_ms", f->render_ms, "panel_ms", f->panel_ms, "events_ms",
                  f->events_ms, "first_picture_ms", f->first_picture_ms, "latency_median_ms",
                  f->latency_median_ms, "latency_p95_ms", f->latency_p95_ms, "cpus_busy", f->cpus_busy,
                  "wall_seconds", f->wall_s, "latency_events", (json_int_t)f->latency_events);
    json_t *devices = json_pack("{s:I, s:f, s:f}", "device_reports", (json_int_t)f->device_reports,
                                "report_median_ms", f->report_median_ms, "report_p99_ms", f->report_p99_ms);
    json_t *state =
        json_pack("{s:i, s:i, s:I, s:f, s:f, s:I, s:I, s:s, s:s, s:f, s:f, s:s, s:s, s:s}", "views", f->views,
                  "chosen_view", f->chosen_view, "steps", (json_int_t)f->step, "time", f->time,
                  "simulated_seconds", f->simulated_s, "pictures", (json_int_t)f->pictures, "scenes_opened",
                  (json_int_t)f->scenes_opened, "color_by", f->color_by, "colormap", f->colormap, "speed",
                  f->speed, "display_scale", f->display_scale, "processor", bench_processor(), "compiler",
                  bench_compiler, "options", bench_options);
    json_t *hands = json_pack(
        "{s:b, s:b, s:b, s:b, s:b, s:b, s:b, s:b, s:o, s:o, s:o, s:o, s:i}", "at_rest", f->at_rest,
        "finer_to_come", f->finer_to_come, "paused", f->paused, "fullscreen", f->fullscreen, "camera_auto",
        f->camera_auto, "panel", f->panel, "help", f->help, "scenes", f->scenes, "box_position",
        vector(f->box_position, 3), "box_orientation", vector(f->box_orientation, 4), "camera_from",
        vector(f->camera_from, 3), "camera_to", vector(f->camera_to, 3), "gl_errors", f->gl_errors);
    if (json)
        json_object_update(json, times), json_object_update(json, state), json_object_update(json, hands),
            json_object_update(json, devices);
    solve_figures_json(json, &f->solved);
    if (json) {
        json_object_set_new(json, "session", json_string(f->script));
        json_object_set_new(json, "box_size", vector(f->box_size, 3));
        json_object_set_new(json, "video_pictures", json_integer((json_int_t)f->video_pictures));
        json_object_set_new(json, "times", vector(f->times, f->views));
        json_object_set_new(json, "limits", step_limits_json(f->limited));
        json_object_set_new(json, "view_settings", json_loads(f->view_settings, 0, NULL));
        json_object_set_new(json, "readout", json_loads(f->readout, 0, NULL));
    }
    const bool whole = json && times && state && hands && devices;
    json_decref(times);
    json_decref(state);
    json_decref(hands);
    json_decref(devices);
    if (whole)
        return json;
    json_decref(json);
    return NULL;
}

/* Removes keys of the solver, for a recorded run. */
static void leave_out_solver(json_t *json)
{
    static const char *const keys[] = {"backend", "method", "threads", "dt", "substeps", "sim_ms", "limits"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        json_object_del(json, keys[i]);
}

static json_t *figures_json(const PlayFigures *f)
{
    json_t *json = *f->renderer ? figures_scene_json(f) : json_pack("{s:s}", "scene", f->scene);
    if (json && f->recorded)
        leave_out_solver(json);
    if (json && *f->failure.message)
        json_object_set_new(json, "error", json_string(f->failure.message));
    return json;
}

static bool write_and_free(json_t *json, const char *path, Error *error)
{
    const bool written = json_file_write(json, path, error);
    json_decref(json);
    return written;
}

bool play_figures_write_json(const PlayFigures *figures, const char *path, Error *error)
{
    return write_and_free(figures_json(figures), path, error);
}

bool play_figures_write_json_array(const PlayFigures *figures, size_t count, const char *path, Error *error)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, figures_json(&figures[i]));
    return write_and_free(array, path, error);
}

/* Returns the first applicable limit. */
static const char *what_limits(const PlayFigures *f)
{
    if (f->sim_ms > 950 * f->dt)
        return "the solver: a frame of it takes longer than the time that it simulates";
    if (f->cpus_busy > 0.93 * world_processors())
        return "the processors: solver and rendering keep all of them busy";
    if (f->render_ms > 0.93 * f->frame_ms)
        return "the rendering: a picture takes as long as the time between two";
    return "nothing: pictures come as fast as states, or as the display shows them";
}

void play_figures_print(const PlayFigures *f, FILE *file)
{
    char threads[32] = "", words[SOLVE_FIGURES_WORDS], bounds[STEP_LIMITS_WORDS];
    if (f->threads > 0)
        snprintf(threads, sizeof threads, "%d thread%s, ", f->threads, plural((size_t)f->threads));
    fprintf(file, "%s: %zu particle%s, %s on %s, %slive for %.1f s\n", f->scene, f->particles,
            plural(f->particles), f->method, f->backend, threads, f->wall_s);
    fprintf(file, "view %s, %d x %d, on %s\n", f->view, f->width, f->height, f->renderer);
    fprintf(file, "  real-time factor      %8.3f\n", f->real_time_factor);
    fprintf(file, "  pictures a second     %8.1f\n", f->pictures_per_second);
    fprintf(file, "  solver, a frame       %8.2f ms of %.4g\n", f->sim_ms, 1e3 * f->dt);
    if (!f->limited[STEP_LIMIT_DT])
        fprintf(file, "  steps bounded by      %s\n", step_limits_text(f->limited, bounds));
    if (f->solved.steps > 0)
        fprintf(file, "  %s\n", solve_figures_text(&f->solved, words));
    fprintf(file, "  rendering, a picture  %8.2f ms, of these the panel %.2f (CPU), events %.2f (CPU)\n",
            f->render_ms, f->panel_ms, f->events_ms);
    fprintf(file, "  start to picture      %8.0f ms\n", f->first_picture_ms);
    fprintf(file,
            "  event to picture      %8.1f ms median, %.1f p95 of %zu; two pictures and a frame are %.1f\n",
            f->latency_median_ms, f->latency_p95_ms, f->latency_events, 2 * f->frame_ms + 1e3 * f->dt);
    fprintf(file, "  processors busy       %8.2f of %d\n", f->cpus_busy, world_processors());
    fprintf(file, "  limited by %s\n\n", what_limits(f));
}

static int threads_of(const WorldDef *def)
{
    if (world_on_gpu(def))
        return 0;
    const int threads = *world_threads(def);
    return threads ? threads : world_processors();
}

static void add_model(const PlayModel *model, PlayFigures *figures)
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
    const ViewProbeAnswers *found = &readout->found;
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

static void add_meter(const FrameTimes *frame_times, PlayFigures *figures)
{
    figures->pictures = frame_times->pictures;
    figures->first_picture_ms = frame_times->first_ms;
    figures->render_ms = frame_times_drawn_mean(frame_times);
    figures->panel_ms = frame_times_panel_mean(frame_times);
    figures->events_ms = frame_times_events_mean(frame_times);
    figures->latency_median_ms = frame_times_latency(frame_times, 0.5);
    figures->latency_p95_ms = frame_times_latency(frame_times, 0.95);
    figures->latency_events = frame_times->latencies;
}

/* Adds the rates since the first picture. */
static void add_rates(const FrameTimes *frame_times, PlayFigures *figures)
{
    const double wall = 1e-3 * (wall_ms() - frame_times->began_ms);
    if (frame_times->began_ms <= 0)
        return;
    figures->wall_s = wall;
    figures->real_time_factor = figures->simulated_s / wall;
    figures->pictures_per_second = (double)(frame_times->pictures - 1) / wall;
    figures->frame_ms = 1000 / fmax(figures->pictures_per_second, 1e-3);
    figures->cpus_busy = 1e-3 * (process_cpu_ms() - frame_times->began_cpu_ms) / wall;
}

void play_figures_fill(const Play *play, PlayFigures *figures)
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
    figures->at_rest = play->model.status.rests && !model_has_new_state(&play->model) &&
                       !play->capture.screenshot && picture_at_rest(&play->picture);
    figures->finer_to_come = play->picture.finer || draw_rests(play);
    figures->video_pictures = play->capture.pictures;
    figures->views = scene_view_count(&play->model.open.scene);
    for (int i = 0; i < figures->views; i++)
        figures->times[i] =
            model_state(&play->model, views_def(&play->views, &play->model.open.scene, i))->time;
    figures->chosen_view = views_panel(&play->views, &play->model.open.scene);
    add_meter(&play->frame_times, figures);
    add_rates(&play->frame_times, figures);
}
