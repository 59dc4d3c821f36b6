#include "app/run/session.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/files/forces_log.h"
#include "app/files/snapshot.h"
#include "app/run/measure/measure.h"
#include "app/scene/scene.h"
#include "sim/flow/flow.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void solve_figures_json(json_t *object, const SolveFigures *solved)
{
    if (!object || solved->steps == 0)
        return;
    if (solved->rubs) {
        json_object_set_new(object, "viscosity_iterations_mean",
                            json_real(solved->viscosity_iterations_mean));
        json_object_set_new(object, "viscosity_residual_mean", json_real(solved->viscosity_residual_mean));
    }
    if (!solved->projects)
        return;
    json_object_set_new(object, "iterations_mean", json_real(solved->iterations_mean));
    json_object_set_new(object, "iterations_p95", json_real(solved->iterations_p95));
    json_object_set_new(object, "density_error_mean", json_real(solved->density_error_mean));
    json_object_set_new(object, "density_error_max", json_real(solved->density_error_max));
}

const char *solve_figures_text(const SolveFigures *solved, char words[SOLVE_FIGURES_WORDS])
{
    int used = 0;
    words[0] = '\0';
    if (solved->steps > 0 && solved->projects)
        used = snprintf(words, SOLVE_FIGURES_WORDS,
                        "%.3g iterations a step (p95 %.0f), density error %.3g %% mean, %.3g %% max",
                        solved->iterations_mean, solved->iterations_p95, 100 * solved->density_error_mean,
                        100 * solved->density_error_max);
    if (solved->steps > 0 && solved->rubs)
        snprintf(words + used, SOLVE_FIGURES_WORDS - (size_t)used,
                 "%sviscosity %.3g iterations a step, %.2g left", used > 0 ? "; " : "",
                 solved->viscosity_iterations_mean, solved->viscosity_residual_mean);
    return words;
}

json_t *step_limits_json(const uint64_t limited[STEP_LIMIT_COUNT])
{
    json_t *limits = json_object();
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (limited[i])
            json_object_set_new(limits, step_limit_name((StepLimit)i), json_integer((json_int_t)limited[i]));
    return limits;
}

const char *step_limits_text(const uint64_t limited[STEP_LIMIT_COUNT], char words[STEP_LIMITS_WORDS])
{
    uint64_t steps = 0;
    size_t used = 0;
    words[0] = '\0';
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        steps += limited[i];
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (limited[i])
            used +=
                (size_t)snprintf(words + used, STEP_LIMITS_WORDS - used, "%s%s %.3g %%", used ? " " : "",
                                 step_limit_name((StepLimit)i), 100.0 * (double)limited[i] / (double)steps);
    return words;
}

/* Times are sums and products of decimal fractions: a state early by this fraction of a frame is on time. */
static const double ROUNDING = 1e-6;

/* Resumes a run from its file: the world starts from the file, as tables may be gone. */
static int start_again(Session *session, const Args *args, Error *error)
{
    SnapshotFirst first = {.position = NULL};
    if (!snapshot_first(args->output, &first, error))
        return EXIT_USAGE;
    session->run.scene.world.initial = &first.initial;
    const int code = session_start(session, args->gpu, false, error);
    session->run.scene.world.initial = NULL;
    snapshot_first_free(&first);
    return code;
}

static bool take_hand(Session *session, const Args *args, Error *error)
{
    if (args->device)
        session->hand = device_replay_open(args->device, args->mapping, &session->run.scene, error);
    session->run.watch.closed = !session->hand;
    return !args->device || session->hand;
}

int session_open(Session *session, const Args *args, bool resume, Error *error)
{
    Notes notes;
    SceneSettings settings = args->settings;
    *session = (Session){.began_ms = wall_ms()};
    settings.goes_on = resume && access(args->output, F_OK) == 0;
    if (!scene_load(args->scenes[0], &settings, &session->run.scene, &notes, error))
        return EXIT_USAGE;
    notes_print(&notes, stderr);
    if (!take_hand(session, args, error))
        return EXIT_USAGE;
    return settings.goes_on && scene_has_tables(&session->run.scene)
               ? start_again(session, args, error)
               : session_start(session, args->gpu, false, error);
}

int session_open_scene(Session *session, const Args *args, const Scene *scene, const char *name,
                       Headless *context, Error *error)
{
    *session =
        (Session){.began_ms = wall_ms(), .run = {.scene = *scene}, .context = context, .borrows = context};
    snprintf(session->prefix, sizeof session->prefix, "%s%s", name, *name ? ": " : "");
    return take_hand(session, args, error) ? session_start(session, args->gpu, true, error) : EXIT_USAGE;
}

int session_start(Session *session, int gpu, bool draws, Error *error)
{
    const bool on_gpu = world_on_gpu(&session->run.scene.world);
    if (!world_can(&session->run.scene.world, error))
        return EXIT_USAGE;
    if ((on_gpu || draws) && !session->context) {
        session->context = headless_create(gpu, error);
        if (!session->context)
            return EXIT_FAILED;
        renderer_tell(headless_renderer(session->context));
    }
    if (run_begin(&session->run, &session->run.scene.world, error))
        return 0;
    return on_gpu ? EXIT_FAILED : EXIT_USAGE;
}

void session_close(Session *session)
{
    run_close_probes(&session->run);
    world_destroy(session->run.world);
    if (!session->borrows)
        headless_destroy(session->context);
    device_replay_close(session->hand);
    session->hand = NULL;
    session->run.world = NULL;
    session->context = NULL;
}

bool session_reached(const Session *session, double time)
{
    return session->run.info.time >= time - ROUNDING * session->run.scene.world.dt &&
           world_is_valid(session->run.world);
}

/* True if products of a scene with dt = 0.0166667 for 1/60 fall out of step within the span. With too long
   frames, the right frames are on time until late by a whole frame. With too short frames, the right frame
   comes early, and the next frame is taken. */
static bool falls_out(double interval, double dt, double frames, double span)
{
    const double early = span / interval * (interval / dt - frames); /* of the last product, in frames */
    return early > ROUNDING || early < ROUNDING - 1;
}

/* Rounds up to six digits. */
static double rounded_up(double value)
{
    const double unit = pow(10, floor(log10(value)) - 5);
    return ceil(value / unit * (1 - 1e-12)) * unit;
}

void session_warn_uneven(const Session *session, const char *what, double interval, double span)
{
    const double dt = session->run.scene.world.dt, frames = fmax(1, round(interval / dt));
    if (run_is_first(&session->run) && session->run.scene.world.step_mode == STEP_FIXED &&
        falls_out(interval, dt, frames, span))
        fprintf(stderr,
                "%s%s are at uneven times: a frame of %.4g s does not divide the %.4g s between them; "
                "--set solver.step.dt=%.6g, --set solver.step.mode=cfl%s makes them even\n",
                session->prefix, what, dt, interval, rounded_up(interval / frames),
                strcmp(what, "pictures") == 0 ? " or leaving --steps out" : "");
}

/* Prints a message of the run. */
static void tell(void *user, const char *words)
{
    const Session *session = user;
    if (run_is_first(&session->run))
        fprintf(stderr, "%s%s\n", session->prefix, words);
}

bool session_interrupted(const Session *session)
{
    Error none = {{0}};
    return !run_agree(&session->run, !interrupted(), &none);
}

bool session_substep(Session *session, Error *error)
{
    device_replay_apply(session->hand, session->run.world);
    return run_substep(&session->run, NULL, tell, session, error);
}

bool session_step(Session *session, Error *error)
{
    bool stepped = true;
    do
        stepped = session_substep(session, error);
    while (stepped && session->run.info.within_frame);
    return stepped;
}

static double wall_seconds(const Session *session)
{
    return fmax((wall_ms() - session->began_ms) / 1000, 1e-6);
}

/* Warns of very thin fluid, which no picture or outcome shows. Methods with carried density bend densities
   below half the rest density to stay above 0. Separating drops come to a third of rest density; a density of
   a quarter would be 0. */
static void report_thinnest(const Session *session, double least)
{
    const WorldDef *def = &session->run.scene.world;
    const Method *method = method_find(def->method);
    if (method && method->carries_density && least < 0.3)
        fprintf(
            stderr,
            "fluid flies apart: densities below half of that at rest are held above 0 by %s (the thinnest "
            "particle has %.3g %%)\n",
            def->method, 100 * least);
}

void session_report(const Session *session, const Args *args, const Summary *summary)
{
    const WorldInfo *info = &session->run.info;
    const double wall = wall_seconds(session);
    if (!run_is_first(&session->run))
        return;
    if (summary->stopped)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", info->time, args->output);
    if (!args->quiet)
        fprintf(stderr, "%zu particle%s, %.3g s simulated in %.3g s (%.3g times real time): %s, %zu %.*s\n",
                info->count, plural(info->count), info->time, wall, info->time / wall, args->output,
                summary->products, (int)strlen(summary->product) - (summary->products == 1),
                summary->product);
    if (!args->quiet && session->run.scene.world.drain_count > 0 && info->drained == 0)
        fprintf(stderr, "the drains took nothing: no fluid came to them\n");
    session_report_steps(session, args);
    if (!args->quiet && summary->compression)
        fprintf(stderr, "snapshots are pressed by %.3g %% in the mean, %.3g %% at the 99.9th percentile\n",
                100 * summary->compression->mean, 100 * summary->compression->p999);
    if (!args->quiet && summary->compression)
        report_thinnest(session, summary->compression->least);
}

void session_report_steps(const Session *session, const Args *args)
{
    const WorldInfo *info = &session->run.info;
    char words[SOLVE_FIGURES_WORDS], bounds[STEP_LIMITS_WORDS];
    if (info->trouble.count > 0)
        fprintf(stderr, "%sthe step was halved %u time%s in all after trouble\n", session->prefix,
                info->trouble.count, plural(info->trouble.count));
    if (!args->quiet && session->run.scene.world.step_mode == STEP_CFL)
        fprintf(stderr, "%ssteps bounded by %s\n", session->prefix, step_limits_text(info->limited, bounds));
    if (!args->quiet && info->solved.steps > 0)
        fprintf(stderr, "%s%s\n", session->prefix, solve_figures_text(&info->solved, words));
}

static json_t *compression_json(const CompressionFigures *pressed)
{
    return json_pack("{s:f, s:f, s:f, s:f}", "mean", pressed->mean, "p999", pressed->p999, "max",
                     pressed->most, "least", pressed->least);
}

json_t *session_json(const Session *session, const Args *args, const Summary *summary)
{
    const WorldInfo *info = &session->run.info;
    const WorldDef *def = &session->run.scene.world;
    const double wall = wall_seconds(session);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:s, s:i, s:I, s:f, s:f, s:i, s:I, s:I, s:f, s:f, s:f, s:b}", "command",
        summary->command, "scene", session->run.scene.path, "output", args->output, "backend", def->backend,
        "method", def->method, "threads", info->threads, "particles", (json_int_t)info->count, "spacing",
        info->spacing, "dt", def->dt, "substeps", def->substeps, "steps", (json_int_t)info->step,
        summary->product, (json_int_t)summary->products, "simulated_seconds", info->time, "wall_seconds",
        wall, "real_time_factor", info->time / wall, "stopped", summary->stopped);
    if (json) {
        json_object_set_new(json, "limits", step_limits_json(info->limited));
        json_object_set_new(json, "troubles", json_integer(info->trouble.count));
        json_object_set_new(json, "lost", json_integer((json_int_t)info->lost));
        json_object_set_new(json, "emitted", json_integer((json_int_t)info->emitted));
        json_object_set_new(json, "drained", json_integer((json_int_t)info->drained));
        solve_figures_json(json, &info->solved);
    }
    Outcome outcome;
    if (fluid_watch_outcome(&session->run.watch, &info->trouble, &outcome))
        outcome_json(json, &outcome);
    if (json && summary->step_seconds > 0)
        json_object_set_new(json, "step_seconds", json_real(summary->step_seconds));
    if (json && summary->compression)
        json_object_set_new(json, "compression", compression_json(summary->compression));
    if (json && summary->forces)
        json_object_set_new(json, "forces", forces_log_json(summary->forces));
    if (json && summary->probes)
        json_object_set_new(json, "probes", probe_table_json(summary->probes));
    if (json && summary->renderer) {
        json_object_set_new(json, "renderer", json_string(summary->renderer));
        json_object_set_new(json, "picture_late_seconds", json_real(summary->late));
    }
    if (json && session->run.ranks)
        json_object_set_new(json, "ranks", json_integer(session->run.ranks->size));
    return json;
}

bool session_write_json(const Session *session, const Args *args, const Summary *summary, Error *error)
{
    bool written = true;
    if (args->json && run_is_first(&session->run)) {
        json_t *json = session_json(session, args, summary);
        written = json_file_write(json, args->json, error);
        json_decref(json);
    }
    return run_agree(&session->run, written, error);
}

int session_fail(const Session *session, const Args *args, const Summary *summary, const Error *error)
{
    if (!run_is_first(&session->run))
        return EXIT_FAILED;
    fprintf(stderr, "%s\n", error->message);
    json_t *json = session->run.world ? session_json(session, args, summary) : NULL;
    if (json)
        json_object_set_new(json, "error", json_string(error->message));
    else /* no world, or non-finite numbers */
        json = failure_json(summary->command, "scene", args->scenes[0], args->output, error);
    failure_json_write(json, args->json);
    return EXIT_FAILED;
}
