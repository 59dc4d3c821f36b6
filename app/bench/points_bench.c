#include "app/bench/bench.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "sim/base/base.h"
#include "sim/points/points.h"
#include "sim/world.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 64, ALONG = 20 };

static const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, origin[3] = {0, 0, 0};

/* Times one sampler. A first, small sampling is not measured: memory and threads exist after it. */
static bool time_sampler(const char *name, const LevelField *field, double level, SurfaceSampler sampler,
                         double density, PointsFigures *figures, Error *error)
{
    SurfacePoints points = {0};
    SurfaceResult result;
    SurfaceRequest request = {
        .field = field, .level = level, .density = density / 50, .sets = 1, .seed = 1, .sampler = sampler};
    bool ok = !interrupted() && surface_sample(&request, &points, &result, error);
    points.count = 0;
    request.density = density;
    const double began = wall_ms();
    ok = ok && surface_sample(&request, &points, &result, error);
    if (ok)
        figures->rates[figures->count++] =
            (PointsRate){name, surface_sampler_name(sampler), (double)points.count, wall_ms() - began};
    surface_points_free(&points);
    return ok;
}

/* Times both samplers; `area`: approximate area of the surface, m2. */
static bool time_field(const char *name, const LevelField *field, double level, double area, double points,
                       PointsFigures *figures, Error *error)
{
    return time_sampler(name, field, level, SURFACE_WALK, points / area, figures, error) &&
           time_sampler(name, field, level, SURFACE_TRIANGLES, points / area, figures, error);
}

static bool time_formulas(double points, PointsFigures *figures, Error *error)
{
    const LevelField sphere = level_sphere(origin, 0.5), torus = level_torus(origin, 0.35, 0.12),
                     gyroid = level_gyroid(low, high, 0.5), wave = level_wave(low, high, 0, 0.1, 0.5);
    return time_field("sphere", &sphere, 0, M_PI, points, figures, error) &&
           time_field("torus", &torus, 0, 4 * M_PI * M_PI * 0.35 * 0.12, points, figures, error) &&
           time_field("gyroid", &gyroid, 0, 6.2, points, figures, error) &&
           time_field("wave", &wave, 0, 1.5, points, figures, error);
}

/* Fills a grid with values of a gyroid. */
static void fill_volume(float *value, double cell)
{
    const LevelField gyroid = level_gyroid(low, high, 0.5);
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        const int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        double place[3];
        LevelSample s;
        for (int k = 0; k < 3; k++)
            place[k] = low[k] + cell * at[k];
        level_at(&gyroid, place, &s);
        value[i] = s.value;
    }
}

static bool time_volumes(double points, PointsFigures *figures, Error *error)
{
    float *value = malloc(sizeof(float) * SIDE * SIDE * SIDE);
    const double cell = 1.0 / (SIDE - 1);
    const VolumeData volume = {{SIDE, SIDE, SIDE}, {low[0], low[1], low[2]}, {cell, cell, cell}, value};
    bool ok = true;
    if (!value)
        return error_set(error, "no memory for a volume of %d^3 values", SIDE);
    fill_volume(value, cell);
    for (VolumeInterpolation way = 0; ok && way < VOLUME_INTERPOLATIONS; way++) {
        LevelField field;
        ok = level_volume(&volume, way, &field, error) &&
             time_field(volume_interpolation_name(way), &field, 0, 6.2, points, figures, error);
    }
    free(value);
    return ok;
}

/* Fills a ball with particles on a lattice; returns their count. */
static size_t fill_ball(float *position)
{
    size_t count = 0;
    for (int i = 0; i < ALONG * ALONG * ALONG; i++) {
        const int at[3] = {i % ALONG, i / ALONG % ALONG, i / ALONG / ALONG};
        float *p = position + 4 * count, square = 0;
        for (int k = 0; k < 3; k++) {
            p[k] = 0.05F * (float)at[k] - 0.5F;
            square += p[k] * p[k];
        }
        p[3] = 1.25e-4F; /* m3 */
        count += square < 0.2F;
    }
    return count;
}

static bool time_particles(double points, PointsFigures *figures, Error *error)
{
    float *position = malloc(sizeof(float) * 4 * (ALONG * ALONG * ALONG + 1));
    FieldParticles all = {.position = position, .support = 0.105};
    if (!position)
        return error_set(error, "no memory for particles");
    all.count = fill_ball(position);
    SphField *own = sph_field_create(&all, error);
    bool ok = own != NULL;
    if (ok) {
        const LevelField field = level_sph(own);
        ok = time_field("particles", &field, 0.5, 2.5, points, figures, error);
    }
    sph_field_destroy(own);
    free(position);
    return ok;
}

bool points_sampling(double points, PointsFigures *figures, Error *error)
{
    figures->threads = parallel_processors();
    figures->count = 0;
    return (time_formulas(points, figures, error) && time_volumes(points, figures, error) &&
            time_particles(0.1 * points, figures, error)) ||
           (interrupted() && error_set(error, "stopped before all surfaces were sampled"));
}

double points_shown(const BenchResult *result)
{
    return result->counts.fragments[STAGE_BLEND] * result->counts.coverage * result->width * result->height;
}

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
