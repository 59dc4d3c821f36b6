#include "app/base/file.h"
#include "app/lab/points_bench.h"

#include <jansson.h>

static double number(const Reference *published, int row, const char *column)
{
    return reference_number(published, row, column);
}

static void print_sampling(const PointsFigures *figures, const Reference *published, FILE *file)
{
    fprintf(file, "%-26s %-10s %12s %12s %12s\n", "sampling", "sampler", "points", "ms", "points/s");
    for (int row = 0; row < published->rows; row++) {
        char name[64];
        const double points = number(published, row, "points"), seconds = number(published, row, "seconds");
        snprintf(name, sizeof name, "%s, published", reference_text(published, row, "figure"));
        fprintf(file, "%-26s %-10s %12.3g %12.4g %12.3g  %s\n", name, "walk", points, 1e3 * seconds,
                points / seconds, reference_text(published, row, "fields"));
    }
    for (int i = 0; i < figures->count; i++) {
        const PointsRate *rate = &figures->rates[i];
        fprintf(file, "%-26s %-10s %12.3g %12.4g %12.3g\n", rate->field, rate->sampler, rate->points,
                rate->ms, 1e3 * rate->points / rate->ms);
    }
}

/* The paper's step 2 is the stage blend, step 3 the stage shade; the remaining stages, such as edges and
   background, belong to neither. */
static void print_rendering(const PointsFigures *figures, const Reference *published, FILE *file)
{
    const BenchResult *r = &figures->rendering;
    const double points = points_shown(r), project = r->stages[STAGE_BLEND].median_ms,
                 average = r->stages[STAGE_SHADE].median_ms;
    fprintf(file, "\n%-26s %12s %12s %12s %12s %12s\n", "rendering", "points", "project, ms", "average, ms",
            "points/s", "pictures/s");
    for (int row = 0; row < published->rows; row++) {
        char name[64];
        const double shown = number(published, row, "points"), rate = number(published, row, "fps");
        snprintf(name, sizeof name, "%s, published", reference_text(published, row, "figure"));
        fprintf(file, "%-26s %12.3g %12s %12s %12.3g %12.2f\n", name, shown, "", "", shown * rate, rate);
    }
    fprintf(file, "%-26s %12.3g %12.4g %12.4g %12.3g %12.2f\n\n", "a torus, a sphere, a wave", points,
            project, average, 1e3 * points / (project + average), 1e3 / (project + average));
}

void points_print(const PointsFigures *figures, const Reference *published, FILE *file)
{
    const BenchResult *r = &figures->rendering;
    fprintf(file, "published: %s\n", published->notes);
    fprintf(file, "here: %s; %s with %d thread%s; %d x %d; %s\n\n", r->renderer, bench_processor(),
            figures->threads, plural((size_t)figures->threads), r->width, r->height, r->scene);
    print_sampling(figures, published, file);
    print_rendering(figures, published, file);
}

bool points_write_json(const PointsFigures *figures, const char *path, Error *error)
{
    const BenchResult *r = &figures->rendering;
    json_t *sampling = json_array();
    for (int i = 0; i < figures->count; i++) {
        const PointsRate *rate = &figures->rates[i];
        json_array_append_new(sampling, json_pack("{s:s, s:s, s:f, s:f}", "field", rate->field, "sampler",
                                                  rate->sampler, "points", rate->points, "ms", rate->ms));
    }
    json_t *rendering =
        json_pack("{s:s, s:s, s:[i, i], s:f, s:f, s:f}", "scene", r->scene, "renderer", r->renderer, "size",
                  r->width, r->height, "points", points_shown(r), "project_ms",
                  r->stages[STAGE_BLEND].median_ms, "average_ms", r->stages[STAGE_SHADE].median_ms);
    json_t *json = json_pack("{s:s, s:i, s:o, s:o}", "processor", bench_processor(), "threads",
                             figures->threads, "sampling", sampling, "rendering", rendering);
    const bool ok = json_file_write(json, path, error);
    json_decref(json);
    return ok;
}
