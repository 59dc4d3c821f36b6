#include "app/base/file.h"
#include "app/lab/bench.h"
#include "app/run/session.h"

#include <jansson.h>
#include <string.h>

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
