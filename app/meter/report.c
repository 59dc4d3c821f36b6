#include "app/meter/report.h"

#include "app/base/file.h"
#include "app/lab/bench.h"
#include "app/run/session.h"
#include "sim/world/world.h"

static json_t *vector(const double *v, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, json_real(v[i]));
    return array;
}

static json_t *scene_json(const PlayFigures *f)
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
    json_t *json = *f->renderer ? scene_json(f) : json_pack("{s:s}", "scene", f->scene);
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

bool play_write_json(const PlayFigures *figures, const char *path, Error *error)
{
    return write_and_free(figures_json(figures), path, error);
}

bool play_write_json_array(const PlayFigures *figures, size_t count, const char *path, Error *error)
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

void play_print(const PlayFigures *f, FILE *file)
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
