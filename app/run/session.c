#include "app/run/session.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/files/forces_log.h"
#include "app/files/snapshot.h"
#include "app/run/measure/probe.h"
#include "app/scene/scene_files.h"
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
    session->scene.world.initial = &first.initial;
    const int code = session_start(session, args->gpu, false, error);
    session->scene.world.initial = NULL;
    snapshot_first_free(&first);
    return code;
}

int session_open(Session *session, const Args *args, Error *error)
{
    Notes notes;
    SceneSettings settings = args->settings;
    *session = (Session){.began_ms = wall_ms()};
    settings.goes_on = args->resume && access(args->output, F_OK) == 0;
    session->watch.resumed = settings.goes_on;
    if (!scene_load(args->scenes[0], &settings, &session->scene, &notes, error))
        return EXIT_USAGE;
    notes_print(&notes, stderr);
    if (args->device &&
        !(session->hand = device_replay_open(args->device, args->mapping, &session->scene, error)))
        return EXIT_USAGE;
    session->watch.closed = !session->hand;
    return settings.goes_on && scene_has_tables(&session->scene)
               ? start_again(session, args, error)
               : session_start(session, args->gpu, false, error);
}

int session_open_scene(Session *session, const Args *args, const Scene *scene, const char *name,
                       Headless *context, Error *error)
{
    *session = (Session){.began_ms = wall_ms(), .scene = *scene, .context = context, .borrows = context};
    snprintf(session->prefix, sizeof session->prefix, "%s%s", name, *name ? ": " : "");
    if (args->device &&
        !(session->hand = device_replay_open(args->device, args->mapping, &session->scene, error)))
        return EXIT_USAGE;
    session->watch.closed = !session->hand;
    return session_start(session, args->gpu, true, error);
}

int session_start(Session *session, int gpu, bool draws, Error *error)
{
    const bool on_gpu = world_on_gpu(&session->scene.world);
    if (!world_can(&session->scene.world, error))
        return EXIT_USAGE;
    if ((on_gpu || draws) && !session->context) {
        session->context = headless_create(gpu, error);
        if (!session->context)
            return EXIT_FAILED;
        fprintf(stderr, "renderer: %s\n", headless_renderer(session->context));
    }
    session->world = world_create(&session->scene.world, error);
    if (!session->world)
        return on_gpu ? EXIT_FAILED : EXIT_USAGE;
    world_info(session->world, &session->info);
    return 0;
}

void session_close(Session *session)
{
    world_destroy(session->world);
    if (!session->borrows)
        headless_destroy(session->context);
    device_replay_close(session->hand);
    session->hand = NULL;
    session->world = NULL;
    session->context = NULL;
}

bool session_reached(const Session *session, double time)
{
    return session->info.time >= time - ROUNDING * session->scene.world.dt && world_is_valid(session->world);
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
    const double dt = session->scene.world.dt, frames = fmax(1, round(interval / dt));
    if (session->scene.world.step_mode == STEP_FIXED && falls_out(interval, dt, frames, span))
        fprintf(stderr,
                "%s%s are at uneven times: a frame of %.4g s does not divide the %.4g s between them; "
                "--set solver.step.dt=%.6g, --set solver.step.mode=cfl%s makes them even\n",
                session->prefix, what, dt, interval, rounded_up(interval / frames),
                strcmp(what, "pictures") == 0 ? " or --interpolate" : "");
}

static void tell(const Session *session, const char *words)
{
    fprintf(stderr, "%s%s\n", session->prefix, words);
}

/* After a step: updates the info, and reports troubles of the step. */
static void look(Session *session)
{
    char words[256];
    world_info(session->world, &session->info);
    if (session_trouble_is_new(&session->reported_trouble, &session->info.trouble))
        tell(session, session_trouble_text(&session->info.trouble, words));
    if (session->info.full && !session->reported_full)
        tell(session, session_full_text(&session->info, words));
    session->reported_full |= session->info.full;
    if (session->info.barred & ~session->reported_blocked)
        tell(session, session_blocked_text(&session->info, &session->reported_blocked, words));
    if (session->info.lost && !session->reported_lost)
        tell(session, session_lost_text(&session->info, words));
    session->reported_lost |= session->info.lost > 0;
    if (session->info.unlisted && !session->reported_unlisted)
        tell(session, session_unlisted_text(&session->info, words));
    session->reported_unlisted |= session->info.unlisted > 0;
}

const char *session_lost_text(const WorldInfo *info, char words[256])
{
    snprintf(words, 256,
             "t = %.4g s: %zu of %zu particles %s no place in the grid, and no neighbour sees %s; "
             "solver.grid_layers 0 has room for a fluid at rest",
             info->time, info->lost, info->count, info->lost == 1 ? "finds" : "find",
             info->lost == 1 ? "it" : "them");
    return words;
}

const char *session_full_text(const WorldInfo *info, char words[256])
{
    snprintf(
        words, 256,
        "t = %.4g s: there %s %zu particle%s, as many as particles.most allows: no more come until some drain",
        info->time, info->count == 1 ? "is" : "are", info->count, plural(info->count));
    return words;
}

const char *session_blocked_text(const WorldInfo *info, uint64_t *told, char words[256])
{
    char names[160] = "", name[GATE_NAME_SIZE];
    for (int k = 0; k < EMITTERS_MAX; k++)
        if (info->barred & ~*told & 1ULL << k) {
            gate_name(k, name);
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "", name);
        }
    snprintf(
        words, 256,
        "t = %.4g s: %s: no particle of the last %d layers found room; something stands in the way, or the "
        "place is full",
        info->time, names, BLOCKED_LAYERS);
    *told |= info->barred;
    return words;
}

bool session_trouble_is_new(TroubleReports *told, const WorldTrouble *trouble)
{
    unsigned *halvings = &told->halvings[trouble->what];
    const unsigned bit = 1u << trouble->tries;
    const bool is_new = trouble->count != told->count && !(*halvings & bit);
    if (trouble->count != told->count)
        *halvings |= bit;
    told->count = trouble->count;
    return is_new;
}

const char *session_trouble_text(const WorldTrouble *trouble, char words[256])
{
    char what[160];
    world_trouble_words(trouble, what);
    snprintf(words, 256, "t = %.4g s: %s; back to %.4g s with 1/%d of the step (%d of %d)", trouble->time,
             what, trouble->back_to, 1 << trouble->tries, trouble->tries, trouble->retries);
    return words;
}

const char *session_unlisted_text(const WorldInfo *info, char words[256])
{
    snprintf(words, 256,
             "lists of neighbours would take %.3g GB, more than the driver or its memory allows: each pass "
             "searches anew, and steps take up to twice as long; fewer particles or a smaller "
             "particles.support need less",
             1e-9 * (double)info->unlisted);
    return words;
}

bool session_substep(Session *session, Error *error)
{
    device_replay_apply(session->hand, session->world);
    char words[FLUID_WATCH_WORDS];
    const bool stepped = world_substep(session->world, NULL, error);
    look(session);
    if (stepped && fluid_watch(&session->watch, &session->scene.world, session->world, words))
        tell(session, words);
    return stepped;
}

bool session_step(Session *session, Error *error)
{
    bool stepped = true;
    do
        stepped = session_substep(session, error);
    while (stepped && session->info.within_frame);
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
    const WorldDef *def = &session->scene.world;
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
    const WorldInfo *info = &session->info;
    const double wall = wall_seconds(session);
    if (summary->stopped)
        fprintf(stderr, "stopped at t = %.4g s; %s is whole\n", info->time, args->output);
    if (!args->quiet)
        fprintf(stderr, "%zu particle%s, %.3g s simulated in %.3g s (%.3g times real time): %s, %zu %.*s\n",
                info->count, plural(info->count), info->time, wall, info->time / wall, args->output,
                summary->products, (int)strlen(summary->product) - (summary->products == 1),
                summary->product);
    if (!args->quiet && session->scene.world.drain_count > 0 && info->drained == 0)
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
    const WorldInfo *info = &session->info;
    char words[SOLVE_FIGURES_WORDS], bounds[STEP_LIMITS_WORDS];
    if (info->trouble.count > 0)
        fprintf(stderr, "%sthe step was halved %u time%s in all after trouble\n", session->prefix,
                info->trouble.count, plural(info->trouble.count));
    if (!args->quiet && session->scene.world.step_mode == STEP_CFL)
        fprintf(stderr, "%ssteps bounded by %s\n", session->prefix, step_limits_text(info->limited, bounds));
    if (!args->quiet && info->solved.steps > 0)
        tell(session, solve_figures_text(&info->solved, words));
}

static json_t *compression_json(const CompressionFigures *pressed)
{
    return json_pack("{s:f, s:f, s:f, s:f}", "mean", pressed->mean, "p999", pressed->p999, "max",
                     pressed->most, "least", pressed->least);
}

json_t *session_json(const Session *session, const Args *args, const Summary *summary)
{
    const WorldInfo *info = &session->info;
    const WorldDef *def = &session->scene.world;
    const double wall = wall_seconds(session);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:s, s:i, s:I, s:f, s:f, s:i, s:I, s:I, s:f, s:f, s:f, s:b}", "command",
        summary->command, "scene", session->scene.path, "output", args->output, "backend", def->backend,
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
    if (fluid_watch_outcome(&session->watch, &info->trouble, &outcome))
        outcome_json(json, &outcome);
    if (json && summary->step_seconds > 0)
        json_object_set_new(json, "step_seconds", json_real(summary->step_seconds));
    if (json && summary->compression)
        json_object_set_new(json, "compression", compression_json(summary->compression));
    if (json && summary->forces)
        json_object_set_new(json, "forces", forces_log_json(summary->forces));
    if (json && summary->probes)
        json_object_set_new(json, "probes", probe_table_json(summary->probes));
    if (json && summary->renderer)
        json_object_set_new(json, "renderer", json_string(summary->renderer));
    return json;
}

bool session_write_json(const Session *session, const Args *args, const Summary *summary, Error *error)
{
    if (!args->json)
        return true;
    json_t *json = session_json(session, args, summary);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

int session_fail(const Session *session, const Args *args, const Summary *summary, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    json_t *json = session->world ? session_json(session, args, summary) : NULL;
    if (json)
        json_object_set_new(json, "error", json_string(error->message));
    else /* no world, or non-finite numbers */
        json = failure_json(summary->command, "scene", args->scenes[0], args->output, error);
    failure_json_write(json, args->json);
    return EXIT_FAILED;
}
