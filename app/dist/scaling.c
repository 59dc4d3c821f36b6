/* Strong and weak scaling from runs of slosh-dist bench: a table, JSON and a chart. */
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/dist/cmd.h"
#include "app/dist/sample.h"
#include "app/dist/scaling_chart.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Scaling {
    const char *output, *json; /* files, or NULL */
    int read;
    Sample *sample;
    SeriesRun *runs; /* of the samples */
    int count;
    Series series[SERIES_MOST];
} Scaling;

static bool take_option(Scaling *scaling, const char *word, const char *value, Error *error)
{
    const char **file = strcmp(word, "-o") == 0 ? &scaling->output : &scaling->json;
    if (!value)
        return error_set(error, "slosh-dist scaling: %s needs a file", word);
    *file = value;
    return file == &scaling->json || chart_name(value, error);
}

static bool read_all(Scaling *scaling, int count, char *const words[], Error *error)
{
    for (int k = 0; k < count; k++) {
        const char *word = words[k];
        if (strcmp(word, "-o") == 0 || strcmp(word, "--json") == 0) {
            if (!take_option(scaling, word, words[++k], error))
                return false;
        } else if (word[0] == '-') {
            return error_set(error, "slosh-dist scaling: it has no %s; it takes -o and --json", word);
        } else if (!sample_read(word, &scaling->sample[scaling->read], error)) {
            return false;
        } else {
            scaling->runs[scaling->read] = scaling->sample[scaling->read].run;
            scaling->read++;
        }
    }
    return true;
}

/* Checks that all runs have one scene and one kind of processor. */
static bool one_kind(const Scaling *scaling, Error *error)
{
    const Sample *first = &scaling->sample[0];
    for (int k = 1; k < scaling->read; k++) {
        const Sample *other = &scaling->sample[k];
        if (strcmp(first->scene, other->scene) != 0)
            return error_set(error, "%s is of %s, %s of %s; give runs of one scene", first->path,
                             first->scene, other->path, other->scene);
        if (strcmp(first->processor, other->processor) != 0)
            return error_set(error, "%s is of '%s', %s of '%s'; give runs of one kind of processor",
                             first->path, first->processor, other->path, other->processor);
    }
    return true;
}

static void print_series(const Scaling *scaling, const Series *series)
{
    const SeriesRun *first = &scaling->runs[series->run[0]];
    if (series->kind == SERIES_STRONG)
        printf("strong scaling, %.0f particles\n", first->cost.particles);
    else
        printf("weak scaling, about %.0f particles a rank\n", first->cost.particles / first->cost.ranks);
    printf("  %5s %5s %11s %9s %8s %10s %9s %9s %9s %9s %9s\n", "ranks", "cores", "particles", "step ms",
           "speed-up", "efficiency", "compute", "exchange", "balance", "wait", "imbalance");
    for (int k = 0; k < series->count; k++) {
        const Sample *of = &scaling->sample[series->run[k]];
        const CostSample *cost = &of->run.cost;
        printf("  %5d %5d %11.0f %9.3f %8.2f %9.0f%% %9.3f %9.3f %9.3f %9.3f %9.3f\n", cost->ranks,
               cost->cores, cost->particles, 1e3 * of->run.step, series_speedup(scaling->runs, series, k),
               100 * series_efficiency(scaling->runs, series, k), 1e3 * cost->compute, 1e3 * cost->exchange,
               1e3 * cost->balance, 1e3 * cost->wait, of->imbalance);
    }
}

static void print(const Scaling *scaling)
{
    printf("%s, on %s\n", scaling->sample[0].scene,
           *scaling->sample[0].processor ? scaling->sample[0].processor : "a processor that is not named");
    for (int k = 0; k < scaling->count; k++)
        print_series(scaling, &scaling->series[k]);
}

static json_t *run_json(const Scaling *scaling, const Series *series, int k)
{
    const Sample *of = &scaling->sample[series->run[k]];
    const CostSample *cost = &of->run.cost;
    return json_pack("{s:s, s:i, s:i, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "file", of->path,
                     "ranks", cost->ranks, "cores", cost->cores, "particles", cost->particles, "step",
                     of->run.step, "speedup", series_speedup(scaling->runs, series, k), "efficiency",
                     series_efficiency(scaling->runs, series, k), "compute", cost->compute, "exchange",
                     cost->exchange, "balance", cost->balance, "wait", cost->wait, "imbalance",
                     of->imbalance);
}

static bool write_json(const Scaling *scaling, Error *error)
{
    json_t *all = json_array();
    for (int s = 0; s < scaling->count; s++) {
        json_t *runs = json_array();
        for (int k = 0; k < scaling->series[s].count; k++)
            json_array_append_new(runs, run_json(scaling, &scaling->series[s], k));
        json_array_append_new(
            all, json_pack("{s:s, s:o}", "scaling", series_names[scaling->series[s].kind], "runs", runs));
    }
    json_t *json = json_pack("{s:s, s:s, s:o}", "scene", scaling->sample[0].scene, "processor",
                             scaling->sample[0].processor, "series", all);
    const bool ok = json_file_write(json, scaling->json, error);
    json_decref(json);
    return ok;
}

static int scale(Scaling *scaling, int count, char *const words[], Error *error)
{
    if (!read_all(scaling, count, words, error) || !one_kind(scaling, error))
        return EXIT_USAGE;
    scaling->count = series_find(scaling->runs, scaling->read, scaling->series);
    if (scaling->count == 0) {
        error_set(error, "slosh-dist scaling: no two runs have the same particles, or as many a rank, on "
                         "different numbers of ranks");
        return EXIT_USAGE;
    }
    if (!scaling->json || strcmp(scaling->json, "-") != 0)
        print(scaling);
    const ScalingPicture picture = {scaling->sample, scaling->runs, scaling->series, scaling->count};
    if ((scaling->json && !write_json(scaling, error)) ||
        (scaling->output && !scaling_draw(&picture, scaling->output, error)))
        return EXIT_FAILED;
    return 0;
}

int dist_scaling(int count, char *const words[])
{
    static Scaling scaling;
    Error error = {{0}};
    int code = EXIT_FAILED;
    scaling.sample = calloc((size_t)count + 1, sizeof *scaling.sample);
    scaling.runs = calloc((size_t)count + 1, sizeof *scaling.runs);
    if (!scaling.sample || !scaling.runs)
        error_set(&error, "slosh-dist scaling: no memory for %d runs", count);
    else
        code = scale(&scaling, count, words, &error);
    if (code != 0)
        fprintf(stderr, "%s\n", error.message);
    free(scaling.sample);
    free(scaling.runs);
    return code;
}
