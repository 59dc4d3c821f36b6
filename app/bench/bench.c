#include "app/bench/bench.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/input/input.h"
#include "app/run/measure/measure.h"
#include "app/run/session.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WARM_UP_FRAMES = 3, PROGRAM_FRAMES = 3 };

/* Stage times, one row per frame, and each frame's wall time. GL rows come later than CPU rows if their
   clock is a query. */
typedef struct FrameSamples {
    StageTimes *cpu, *gl;
    double *frame_ms;
    int frames, gl_frames;
    uint64_t steps;
    size_t lost;
    double particles;        /* summed over frames */
    double began, simulated; /* s */
    bool sim_on_gpu;
} FrameSamples;

static bool samples_create(FrameSamples *samples, int frames, bool sim_on_gpu, Error *error)
{
    const size_t count = frames > 0 ? (size_t)frames : 1;
    *samples = (FrameSamples){calloc(count, sizeof(StageTimes)), calloc(count, sizeof(StageTimes)),
                              calloc(count, sizeof(double)), .sim_on_gpu = sim_on_gpu};
    return (samples->cpu && samples->gl && samples->frame_ms) ||
           error_set(error, "no memory for the times of %d frames", frames);
}

static void samples_destroy(FrameSamples *samples)
{
    free(samples->cpu);
    free(samples->gl);
    free(samples->frame_ms);
}

/* Sorts `values` and returns the quantile `fraction` (0 to 1). */
static double quantile(double *values, int count, double fraction)
{
    if (count == 0)
        return 0;
    qsort(values, (size_t)count, sizeof *values, compare_numbers);
    const double at = fraction * (count - 1);
    const int low = (int)at;
    const int high = low + 1 < count ? low + 1 : low;
    return values[low] + (values[high] - values[low]) * (at - low);
}

/* True if the stage runs on the GPU. */
static bool on_gpu(const FrameSamples *samples, Stage stage)
{
    return stage_part(stage) == PART_RENDER || (stage_part(stage) == PART_SIM && samples->sim_on_gpu);
}

static const StageTimes *rows_of(const FrameSamples *samples, Stage stage, int *count)
{
    const bool gl = on_gpu(samples, stage);
    *count = gl ? samples->gl_frames : samples->frames;
    return gl ? samples->gl : samples->cpu;
}

static double stage_figure(const FrameSamples *samples, Stage stage, const char *gl_clock, double *work,
                           StageFigure *figure)
{
    int count;
    double sum = 0;
    const StageTimes *rows = rows_of(samples, stage, &count);
    figure->clock = on_gpu(samples, stage) ? gl_clock : "cpu";
    for (int f = 0; f < count; f++) {
        work[f] = rows[f].ms[stage];
        sum += work[f];
        figure->ran |= rows[f].ran[stage];
    }
    figure->median_ms = quantile(work, count, 0.5);
    figure->p95_ms = quantile(work, count, 0.95);
    return sum;
}

static double part_median(const FrameSamples *samples, StagePart part, double *work)
{
    int count = 0;
    memset(work, 0, (size_t)samples->frames * sizeof *work);
    for (int s = 0; s < STAGE_COUNT; s++) {
        if (stage_part((Stage)s) != part)
            continue;
        const StageTimes *rows = rows_of(samples, (Stage)s, &count);
        for (int f = 0; f < count; f++)
            work[f] += rows[f].ms[s];
    }
    return quantile(work, count, 0.5);
}

static bool figures(const FrameSamples *samples, const char *gl_clock, BenchResult *result, Error *error)
{
    double *work = calloc((size_t)samples->frames + 1, sizeof *work), sum[STAGE_COUNT], all = 0, sim = 0,
           wall = 0;
    if (!work)
        return error_set(error, "no memory for the figures of %d frames", samples->frames);
    for (int s = 0; s < STAGE_COUNT; s++) {
        sum[s] = stage_figure(samples, (Stage)s, gl_clock, work, &result->stages[s]);
        all += sum[s];
        sim += stage_part((Stage)s) == PART_SIM ? sum[s] : 0;
    }
    for (int s = 0; s < STAGE_COUNT; s++)
        result->stages[s].share = all > 0 ? sum[s] / all : 0;
    result->sim_ms = part_median(samples, PART_SIM, work);
    result->upload_ms = part_median(samples, PART_UPLOAD, work);
    result->render_ms = part_median(samples, PART_RENDER, work);
    for (int f = 0; f < samples->frames; f++)
        wall += samples->frame_ms[f];
    result->frame_ms = quantile(samples->frame_ms, samples->frames, 0.5);
    result->frames = samples->frames;
    if (sim > 0) /* a method may have no sim stage */
        result->particle_steps_per_second = (double)result->particles * (double)samples->steps / (1e-3 * sim);
    result->real_time_factor = samples->simulated / (1e-3 * wall);
    free(work);
    return true;
}

/* The objects of a measurement. */
typedef struct BenchRun {
    World *world;
    DeviceReplay *hand; /* or NULL */
    const WorldDef *def;
    OutcomeHistory history;
    Offscreen offscreen;
    GlTimer *timer;
    bool draws, sim_on_gpu;
} BenchRun;

static bool stand_open(BenchRun *stand, const BenchSetup *setup, Error *error)
{
    *stand = (BenchRun){.world = world_create(&setup->scene->world, error),
                        .def = &setup->scene->world,
                        .draws = setup->draws,
                        .sim_on_gpu = world_on_gpu(&setup->scene->world)};
    if (!stand->world)
        return false;
    if (setup->device &&
        !(stand->hand = device_replay_open(setup->device, setup->mapping, setup->scene, error)))
        return false;
    if (!stand->draws && !stand->sim_on_gpu)
        return true;
    if (stand->draws && !offscreen_open(&stand->offscreen, &setup->scene->view, &setup->scene->world,
                                        stand->world, setup->width, setup->height, error))
        return false;
    if (stand->draws)
        renderer_set_continuous(stand->offscreen.renderer, true); /* as in the window */
    stand->timer = gl_timer_create(setup->clock);
    return stand->timer || error_set(error, "no memory for the clock of the stages");
}

static void stand_close(BenchRun *stand)
{
    gl_timer_destroy(stand->timer);
    offscreen_close(&stand->offscreen);
    device_replay_close(stand->hand);
    world_destroy(stand->world);
}

/* Runs one frame. Times of CPU stages go into `clock`. */
static bool frame(BenchRun *stand, StageClock *clock, Error *error)
{
    *clock = stand->sim_on_gpu ? gl_timer_stage_clock(stand->timer) : (StageClock){0};
    device_replay_apply(stand->hand, stand->world);
    if (!world_step(stand->world, clock, error))
        return false;
    return !stand->draws || offscreen_draw(&stand->offscreen, stand->world, clock, stand->timer, error);
}

static bool advance(BenchRun *stand, double from, Error *error)
{
    WorldInfo info;
    for (world_info(stand->world, &info); info.time < from && !interrupted();
         world_info(stand->world, &info)) {
        device_replay_apply(stand->hand, stand->world);
        if (!world_step(stand->world, NULL, error))
            return false;
    }
    return true;
}

static void add_calls(GlCalls *sum, const GlCalls *before)
{
    const GlCalls more = gl_calls_since(before);
    sum->calls += more.calls;
    sum->dispatches += more.dispatches;
    sum->waits += more.waits;
    sum->readbacks += more.readbacks;
}

/* Runs a frame without a clock, and counts calls of the driver. */
static bool counted_frame(BenchRun *stand, BenchResult *result, Error *error)
{
    WorldInfo before, after;
    world_info(stand->world, &before);
    GlCalls mark = gl_calls();
    device_replay_apply(stand->hand, stand->world);
    if (!world_step(stand->world, NULL, error))
        return false;
    add_calls(&result->sim_calls, &mark);
    world_info(stand->world, &after);
    result->called_substeps += stand->sim_on_gpu ? after.step - before.step : 0;
    if (!stand->draws)
        return true;
    mark = gl_calls();
    result->called_pictures++;
    const bool drawn = offscreen_draw(&stand->offscreen, stand->world, NULL, NULL, error);
    add_calls(&result->picture_calls, &mark);
    return drawn;
}

/* The first frame makes buffers and programs; calls are counted in the next frames. */
static bool warm_up(BenchRun *stand, BenchResult *result, Error *error)
{
    StageClock clock;
    StageTimes unused;
    bool ok = frame(stand, &clock, error);
    gl_timer_frame(stand->timer, &unused);
    for (int f = 1; ok && f < WARM_UP_FRAMES; f++)
        ok = stand->timer ? counted_frame(stand, result, error) : frame(stand, &clock, error);
    while (gl_timer_drain(stand->timer, &unused))
        continue;
    return ok;
}

/* Some more frames, for the time of each program. */
static bool measure_programs(BenchRun *stand, BenchResult *result, Error *error)
{
    bool ok = true;
    if (strcmp(gl_timer_clock_name(stand->timer), "gl") != 0)
        return true;
    gl_timer_warm_up(stand->timer);
    gl_programs_begin();
    for (int f = 0; ok && f < PROGRAM_FRAMES; f++) {
        device_replay_apply(stand->hand, stand->world);
        ok = world_step(stand->world, NULL, error) &&
             (!stand->draws || offscreen_draw(&stand->offscreen, stand->world, NULL, NULL, error));
    }
    result->program_count = (int)gl_programs_end(result->programs, BENCH_PROGRAMS);
    for (int k = 0; k < result->program_count; k++) {
        result->programs[k].ms /= PROGRAM_FRAMES;
        result->programs[k].before_ms /= PROGRAM_FRAMES;
    }
    return ok;
}

static bool look(BenchRun *stand, Error *error)
{
    return outcome_sample(&stand->history, stand->def, stand->hand != NULL, stand->world) ||
           error_set(error, "no memory to look at the particles; use a larger spacing");
}

static bool measure(BenchRun *stand, const BenchSetup *setup, Progress *progress, double done, double part,
                    FrameSamples *samples, Error *error)
{
    const int frames = setup->frames;
    WorldInfo first, before, last;
    if (!look(stand, error))
        return false;
    world_info(stand->world, &first);
    world_solved_restart(stand->world);
    gl_timer_warm_up(stand->timer);
    while (samples->frames < frames && !interrupted()) {
        StageClock clock;
        if (!advance(stand, first.time + setup->seconds * (samples->frames + 0.5) / frames, error))
            return false;
        world_info(stand->world, &before);
        const double began = wall_ms();
        if (!frame(stand, &clock, error))
            return false;
        samples->gl_frames += gl_timer_frame(stand->timer, &samples->gl[samples->gl_frames]);
        const double now = wall_ms();
        samples->cpu[samples->frames] = clock.frame;
        samples->frame_ms[samples->frames++] = now - began;
        progress_update(progress, done + part * samples->frames / frames);
        world_info(stand->world, &last);
        samples->lost = last.lost > samples->lost ? last.lost : samples->lost;
        samples->particles += (double)last.count;
        samples->steps += last.step - before.step;
        samples->simulated += last.time - before.time;
    }
    if (!world_is_valid(stand->world) &&
        !world_substep(stand->world, NULL, error)) /* goes back, or gives up */
        return false;
    world_info(stand->world, &last);
    samples->lost = last.lost > samples->lost ? last.lost : samples->lost;
    samples->began = first.time;
    while (samples->gl_frames < samples->frames &&
           gl_timer_drain(stand->timer, &samples->gl[samples->gl_frames]))
        samples->gl_frames++;
    return samples->frames > 0 ? look(stand, error) : error_set(error, "stopped before a frame was measured");
}

/* Fills in the scene's names. */
static void name(const BenchSetup *setup, BenchResult *result)
{
    const WorldDef *def = &setup->scene->world;
    *result = (BenchResult){.width = setup->width, .height = setup->height};
    snprintf(result->swept, sizeof result->swept, "%s", setup->swept ? setup->swept : "");
    snprintf(result->scene, sizeof result->scene, "%s", setup->scene->path);
    snprintf(result->backend, sizeof result->backend, "%s", def->backend);
    snprintf(result->method, sizeof result->method, "%s", def->method);
    snprintf(result->view, sizeof result->view, "%s", setup->draws ? setup->scene->view.kind : "none");
    if (setup->context)
        snprintf(result->renderer, sizeof result->renderer, "%s", headless_renderer(setup->context));
}

/* Fills in the world's counts and step at the start or end. */
static void describe(const BenchRun *stand, BenchResult *result)
{
    WorldInfo info;
    WorldSums sums;
    world_info(stand->world, &info);
    world_sums(stand->world, &sums);
    result->threads = info.threads;
    result->simd = info.simd;
    result->particles = info.count;
    result->troubles = info.trouble.count;
    result->unlisted = info.unlisted;
    result->neighbours_mean = sums.neighbours_mean;
    result->dt = stand->def->step_mode == STEP_CFL ? info.dt : stand->def->dt;
    result->dt_substep = info.dt;
    result->bytes_per_particle = (double)info.state_bytes / (double)info.capacity;
    result->solved = info.solved;
}

/* Fills in all figures of the measured frames. */
static bool conclude(BenchRun *stand, const FrameSamples *samples, BenchResult *result, Error *error)
{
    describe(stand, result);
    result->particles = (size_t)lround(samples->particles / samples->frames);
    result->substeps = (int)lround((double)samples->steps / samples->frames);
    result->lost = samples->lost;
    result->time = samples->began;
    return figures(samples, gl_timer_clock_name(stand->timer), result, error) &&
           (!stand->draws || offscreen_count(&stand->offscreen, stand->world, &result->counts, error));
}

/* Fills in the outcome, and the reason of a failure. */
static void judge(BenchRun *stand, bool ok, const Error *error, BenchResult *result)
{
    if (stand->world)
        outcome_end(&stand->history, stand->world);
    if (ok || stand->history.trouble.ended)
        outcome_judge(&stand->history, &result->outcome);
    else
        outcome_not_run(error->message, &result->outcome);
    if (!ok)
        result->failure = *error;
}

bool bench_measure(const BenchSetup *setup, Progress *progress, double done, double part, BenchResult *result)
{
    BenchRun stand;
    FrameSamples samples = {0};
    Error error = {{0}};
    name(setup, result);
    bool ok = stand_open(&stand, setup, &error) &&
              samples_create(&samples, setup->frames, stand.sim_on_gpu, &error);
    if (stand.world)
        describe(&stand, result);
    ok = ok && advance(&stand, setup->from, &error) && warm_up(&stand, result, &error) &&
         measure(&stand, setup, progress, done, part, &samples, &error) &&
         measure_programs(&stand, result, &error) && conclude(&stand, &samples, result, &error);
    judge(&stand, ok, &error, result);
    samples_destroy(&samples);
    stand_close(&stand);
    return ok;
}

const char bench_compiler[] = SLOSH_COMPILER, bench_options[] = SLOSH_OPTIONS;

const char *bench_processor(void)
{
    static char name[128];
    char line[256];
    FILE *file = *name ? NULL : fopen("/proc/cpuinfo", "r");
    while (file && !*name && fgets(line, sizeof line, file))
        if (strncmp(line, "model name", strlen("model name")) == 0 && strstr(line, ": "))
            snprintf(name, sizeof name, "%.*s", (int)strcspn(strstr(line, ": ") + 2, "\n"),
                     strstr(line, ": ") + 2);
    if (file)
        fclose(file);
    return name;
}

static void print_calls(const char *of, const GlCalls *calls, uint64_t times, FILE *file)
{
    const double each = 1 / (double)times;
    if (times > 0)
        fprintf(file,
                "  a %s: %.0f calls of the driver, %.1f dispatches, %.1f waits, %.1f of them to read back\n",
                of, (double)calls->calls * each, (double)calls->dispatches * each,
                (double)calls->waits * each, (double)calls->readbacks * each);
}

/* The programs with the greatest times. */
static void print_programs(const BenchResult *r, FILE *file)
{
    enum { SHOWN = 6 };
    double waits = 0;
    for (int k = 0; k < r->program_count; k++)
        waits += r->programs[k].before_ms;
    for (int k = 0; k < r->program_count && k < SHOWN; k++)
        fprintf(file, "%s%s %.3g", k == 0 ? "  ms a frame by program: " : ", ", r->programs[k].name,
                r->programs[k].ms);
    if (r->program_count > 0)
        fprintf(file, "; between programs %.3g\n", waits);
}

static void print_parts(const BenchResult *r, FILE *file)
{
    char words[SOLVE_FIGURES_WORDS], text[OUTCOME_TEXT];
    if (r->outcome.kind != OUTCOME_HOLDS)
        fprintf(file, "  %s\n", outcome_text(&r->outcome, text));
    if (r->troubles > 0)
        fprintf(
            file,
            "  the sentinel went back %u time%s and halved the step: the figures are those of more steps\n",
            r->troubles, plural(r->troubles));
    if (r->lost > 0)
        fprintf(file, "  %zu particle%s found no place in the grid\n", r->lost, plural(r->lost));
    if (r->unlisted > 0)
        fprintf(file, "  without lists of neighbours: %.3g GB are more than the driver allows\n",
                1e-9 * (double)r->unlisted);
    if (r->solved.steps > 0)
        fprintf(file, "  %s\n", solve_figures_text(&r->solved, words));
    print_calls("substep", &r->sim_calls, r->called_substeps, file);
    print_calls("picture", &r->picture_calls, r->called_pictures, file);
    print_programs(r, file);
    fprintf(file, "  sim %.3f ms, upload %.3f ms, render %.3f ms, frame %.3f ms\n", r->sim_ms, r->upload_ms,
            r->render_ms, r->frame_ms);
    fprintf(file, "  %.3g million particle-steps/s, real-time factor %.2f, %.0f bytes a particle\n\n",
            r->particle_steps_per_second * 1e-6, r->real_time_factor, r->bytes_per_particle);
}

static void print_failed(const BenchResult *r, FILE *file)
{
    char text[OUTCOME_TEXT];
    fprintf(file, "%s: %s on %s%s%s: %s\n\n", r->scene, r->method, r->backend, r->swept[0] ? ", " : "",
            r->swept, outcome_text(&r->outcome, text));
}

void bench_print(const BenchResult *r, FILE *file)
{
    if (*r->failure.message) {
        print_failed(r, file);
        return;
    }
    char threads[48] = "";
    if (r->threads > 0)
        snprintf(threads, sizeof threads, "%d thread%s, %s, ", r->threads, plural((size_t)r->threads),
                 r->simd);
    fprintf(file, "%s: %zu particle%s, %.1f neighbours, %s on %s, %s%d x %g s\n", r->scene, r->particles,
            plural(r->particles), r->neighbours_mean, r->method, r->backend, threads, r->substeps,
            r->dt_substep);
    if (r->renderer[0])
        fprintf(file, "view %s, %d x %d, on %s\n", r->view, r->width, r->height, r->renderer);
    if (r->swept[0])
        fprintf(file, "%s\n", r->swept);
    if (r->counts.counted)
        fprintf(file, "  coverage %.1f %% of the picture\n", 100 * r->counts.coverage);
    fprintf(file, "  %-12s %-7s %-7s %10s %10s %7s%s\n", "stage", "part", "clock", "median ms", "p95 ms",
            "share", r->counts.counted ? "  fragments a covered pixel" : "");
    for (int s = 0; s < STAGE_COUNT; s++) {
        const StageFigure *figure = &r->stages[s];
        if (!figure->ran)
            continue;
        fprintf(file, "  %-12s %-7s %-7s %10.3f %10.3f %6.1f%%", stage_name((Stage)s),
                part_name(stage_part((Stage)s)), figure->clock, figure->median_ms, figure->p95_ms,
                100 * figure->share);
        if (r->counts.fragments[s] > 0)
            fprintf(file, " %10.1f", r->counts.fragments[s]);
        fputc('\n', file);
    }
    print_parts(r, file);
}

static json_t *stages_json(const BenchResult *r)
{
    json_t *stages = json_array();
    for (int s = 0; s < STAGE_COUNT; s++) {
        const StageFigure *figure = &r->stages[s];
        if (!figure->ran)
            continue;
        json_t *stage = json_pack("{s:s, s:s, s:s, s:f, s:f, s:f}", "name", stage_name((Stage)s), "part",
                                  part_name(stage_part((Stage)s)), "clock", figure->clock, "median_ms",
                                  figure->median_ms, "p95_ms", figure->p95_ms, "share", figure->share);
        if (r->counts.fragments[s] > 0)
            json_object_set_new(stage, "fragments", json_real(r->counts.fragments[s]));
        json_array_append_new(stages, stage);
    }
    return stages;
}

static json_t *calls_json(const GlCalls *calls, uint64_t times)
{
    const double each = 1 / (double)times;
    return times == 0 ? json_null()
                      : json_pack("{s:f, s:f, s:f, s:f}", "calls", (double)calls->calls * each, "dispatches",
                                  (double)calls->dispatches * each, "waits", (double)calls->waits * each,
                                  "readbacks", (double)calls->readbacks * each);
}

/* Per frame: all dispatches and draws of the program. */
static json_t *programs_json(const BenchResult *r)
{
    json_t *all = r->program_count > 0 ? json_array() : json_null();
    for (int k = 0; k < r->program_count; k++)
        json_array_append_new(all, json_pack("{s:s, s:f, s:f, s:f}", "name", r->programs[k].name, "runs",
                                             (double)r->programs[k].runs / PROGRAM_FRAMES, "ms",
                                             r->programs[k].ms, "before_ms", r->programs[k].before_ms));
    return all;
}

static json_t *failed_case_json(const BenchResult *r)
{
    json_t *json = json_pack("{s:s, s:s, s:s, s:s, s:s}", "scene", r->scene, "backend", r->backend, "method",
                             r->method, "view", r->view, "error", r->failure.message);
    outcome_json(json, &r->outcome);
    if (json && r->swept[0])
        json_object_set_new(json, "swept", json_string(r->swept));
    return json;
}

static json_t *result_json(const BenchResult *r)
{
    if (*r->failure.message)
        return failed_case_json(r);
    json_t *json =
        json_pack("{s:s, s:s, s:s, s:s, s:i, s:s?, s:s?, s:[i, i], s:s, s:s, s:s}", "scene", r->scene,
                  "backend", r->backend, "method", r->method, "view", r->view, "threads", r->threads, "simd",
                  r->simd, "renderer", r->renderer[0] ? r->renderer : NULL, "size", r->width, r->height,
                  "processor", bench_processor(), "compiler", bench_compiler, "options", bench_options);
    json_t *more =
        json_pack("{s:I, s:i, s:I, s:f, s:f, s:f, s:f, s:i, s:i, s:o}", "particles", (json_int_t)r->particles,
                  "troubles", (int)r->troubles, "lost", (json_int_t)r->lost, "time", r->time,
                  "neighbours_mean", r->neighbours_mean, "dt", r->dt, "dt_substep", r->dt_substep, "substeps",
                  r->substeps, "frames", r->frames, "stages", stages_json(r));
    json_t *sums = json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "sim_ms", r->sim_ms, "upload_ms",
                             r->upload_ms, "render_ms", r->render_ms, "frame_ms", r->frame_ms,
                             "particle_steps_per_second", r->particle_steps_per_second, "real_time_factor",
                             r->real_time_factor, "bytes_per_particle", r->bytes_per_particle);
    const bool ok =
        json && more && sums && json_object_update(json, more) == 0 && json_object_update(json, sums) == 0;
    json_decref(more);
    json_decref(sums);
    outcome_json(ok ? json : NULL, &r->outcome);
    if (ok)
        solve_figures_json(json, &r->solved);
    if (ok && (r->called_substeps > 0 || r->called_pictures > 0))
        json_object_set_new(
            json, "gl",
            json_pack("{s:o, s:o, s:o}", "substep", calls_json(&r->sim_calls, r->called_substeps), "picture",
                      calls_json(&r->picture_calls, r->called_pictures), "programs", programs_json(r)));
    if (ok && r->counts.counted)
        json_object_set_new(json, "coverage", json_real(r->counts.coverage));
    if (ok && r->swept[0])
        json_object_set_new(json, "swept", json_string(r->swept));
    if (ok)
        return json;
    json_decref(json);
    return NULL;
}

bool bench_write_json(const BenchResult *results, size_t count, const char *path, Error *error)
{
    json_t *all = json_array();
    bool ok = true;
    for (size_t i = 0; i < count; i++)
        ok &= json_array_append_new(all, result_json(&results[i])) == 0;
    const bool written = json_file_write(ok ? all : NULL, path, error);
    json_decref(all);
    return written;
}
