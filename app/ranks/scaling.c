#include "app/ranks/ranks.h"

#include "app/base/file.h"
#include "app/base/program.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads a sample; `path` must outlive it. Returns false with the reason: no such file, or another
   program's. */
static bool scaling_sample_read(const char *path, ScalingSample *sample, Error *error)
{
    json_error_t wrong;
    CostSample *cost = &sample->run.cost;
    double cores = 0;
    const char *scene = "", *processor = "";
    *sample = (ScalingSample){.path = path, .imbalance = 1};
    json_t *json = json_load_file(path, 0, &wrong);
    if (!json && wrong.line < 1) /* no file: the text has its name */
        return error_set(error, "%s; give files that slosh-dist bench --json wrote", wrong.text);
    if (!json)
        return error_set(error, "%s:%d: %s; give files that slosh-dist bench --json wrote", path, wrong.line,
                         wrong.text);
    const int read = json_unpack_ex(
        json, &wrong, 0, "{s?s, s?s, s?F, s:i, s:i, s:F, s:F, s:{s:F, s:F, s:F, s:F, s:F, s:F, s:F, s:F}}",
        "scene", &scene, "processor", &processor, "imbalance", &sample->imbalance, "ranks", &cost->ranks,
        "dimensions", &sample->dimensions, "particles", &cost->particles, "step", &sample->run.step, "mean",
        "compute", &cost->compute, "exchange", &cost->exchange, "balance", &cost->balance, "wait",
        &cost->wait, "ghosts", &cost->ghosts, "sent", &cost->bytes, "messages", &cost->messages, "cores",
        &cores);
    cost->cores = (int)lround(cores * cost->ranks);
    snprintf(sample->scene, sizeof sample->scene, "%s", scene);
    snprintf(sample->processor, sizeof sample->processor, "%s", processor);
    json_decref(json);
    if (read == 0 && cost->ranks >= 1 && cost->cores >= 1 && cost->particles >= 1 && sample->run.step > 0)
        return true;
    return error_set(error, "%s: %s; give files that slosh-dist bench --json wrote", path,
                     read == 0 ? "has no particles, ranks, processors or time of a step" : wrong.text);
}

/* The model of cost, fitted to files of slosh-dist bench. */

static const double FAR_PARTICLES = 1e9;
enum { FAR_RANKS = 4096 };

/* Reads the files before and after "--beside"; `fitted` gets the count before. */
static int read_samples(int count, char *const paths[], ScalingSample *samples, int *fitted, Error *error)
{
    int read = 0;
    *fitted = -1;
    for (int k = 0; k < count; k++)
        if (strcmp(paths[k], "--beside") == 0 && *fitted < 0)
            *fitted = read;
        else if (!scaling_sample_read(paths[k], &samples[read++], error))
            return -1;
    if (*fitted < 0)
        *fitted = read;
    return read;
}

static bool equal_dimensions(const ScalingSample *samples, int count, Error *error)
{
    for (int k = 1; k < count; k++)
        if (samples[k].dimensions != samples[0].dimensions)
            return error_set(error, "%s has %d dimensions, %s has %d; a model is of one kind of scene",
                             samples[k].path, samples[k].dimensions, samples[0].path, samples[0].dimensions);
    return true;
}

static bool fit(const ScalingSample *samples, int fitted, CostModel *model, Error *error)
{
    CostSample *costs = calloc((size_t)fitted + 1, sizeof *costs);
    if (!costs) {
        error_set(error, "no memory for the samples");
        return false;
    }
    for (int k = 0; k < fitted; k++)
        costs[k] = samples[k].run.cost;
    const bool ok = fitted > 0 ? cost_fit(costs, fitted, samples[0].dimensions, model, error)
                               : error_set(error, "slosh-dist model: no file to fit");
    free(costs);
    return ok;
}

static void print_model(const CostModel *model, int fitted)
{
    printf("the model of cost, fitted to %d run%s in %d dimensions:\n", fitted, plural((size_t)fitted),
           model->dimensions);
    printf("  compute   %.3g us a particle and processor\n", 1e6 * model->compute);
    printf("  surface   %.3g (particles of a rank)^%s ghosts a face\n", model->surface,
           model->dimensions == 2 ? "1/2" : "2/3");
    printf("  exchange  %.3g bytes a ghost, %.3g messages a neighbour; %.3g us a message, ", model->bytes,
           model->messages, 1e6 * model->latency);
    if (isinf(model->bandwidth))
        printf("bytes cost nothing that shows\n");
    else
        printf("%.3g GB/s\n", 1e-9 * model->bandwidth);
    printf("  balance   %.3g ns a particle of a rank; wait %.3g of compute\n\n", 1e9 * model->balance,
           model->wait);
}

static void print_cost(const char *what, const CostSample *of, double step)
{
    printf("  %-24.24s %5d %5d %11.5g %11.4g %11.4g %11.4g %11.4g %11.4g %9.4g\n", what, of->ranks, of->cores,
           of->particles, 1e3 * step, 1e3 * of->compute, 1e3 * of->exchange, 1e3 * of->balance,
           1e3 * of->wait, of->ghosts);
}

static void print_head(void)
{
    printf("  %-24s %5s %5s %11s %11s %11s %11s %11s %11s %9s\n", "", "ranks", "cores", "particles",
           "step ms", "compute", "exchange", "balance", "wait", "ghosts");
}

static void print_beside(const CostModel *model, const ScalingSample *sample, bool fitted)
{
    const CostSample said =
        cost_predict(model, sample->run.cost.particles, sample->run.cost.ranks, sample->run.cost.cores);
    const double step = cost_step(&said);
    printf(" %s%s\n", sample->path, fitted ? "" : ", which the fit has not seen");
    print_cost("measured", &sample->run.cost, sample->run.step);
    print_cost("the model", &said, step);
    if (sample->run.step > 0)
        printf("  the model's step is %+.0f %% off\n", 100 * (step / sample->run.step - 1));
}

int dist_model(int count, char *const paths[])
{
    Error error = {{0}};
    CostModel model = {.dimensions = 3};
    int fitted, code = 0;
    ScalingSample *samples = calloc((size_t)count, sizeof *samples);
    const int read = samples ? read_samples(count, paths, samples, &fitted, &error) : -1;
    if (!samples)
        error_set(&error, "no memory for the samples");
    if (read < 0 || !equal_dimensions(samples, read, &error) || !fit(samples, fitted, &model, &error)) {
        fprintf(stderr, "%s\n", error.message);
        code = EXIT_USAGE;
    } else {
        const CostSample far = cost_predict(&model, FAR_PARTICLES, FAR_RANKS, FAR_RANKS);
        print_model(&model, fitted);
        print_head();
        for (int k = 0; k < read; k++)
            print_beside(&model, &samples[k], k < fitted);
        printf(
            " a PREDICTION, which nobody measured: machines as those of these runs, one processor a rank\n");
        print_cost("predicted", &far, cost_step(&far));
    }
    free(samples);
    return code;
}

enum { PANEL = 460, HEIGHT = 420, BAR = 64, MARGINS = 200 }; /* px */

static int kind_count(const ScalingPicture *picture, ScalingKind kind)
{
    int count = 0;
    for (int s = 0; s < picture->count; s++)
        count += picture->series[s].kind == kind;
    return count;
}

/* True if the series has bars: strong series, or weak series if there is no strong series, as both share
   runs. */
static bool has_bars(const ScalingPicture *picture, const ScalingSeries *series)
{
    return series->kind == SCALING_STRONG || kind_count(picture, SCALING_STRONG) == 0;
}

static int bar_count(const ScalingPicture *picture)
{
    int bars = 0;
    for (int s = 0; s < picture->count; s++)
        if (has_bars(picture, &picture->series[s]))
            bars += picture->series[s].count + 1;
    return bars;
}

/* Draws compute, exchange, balance and wait in ms, mean over ranks; a gap after each series. */
static void draw_bars(const ScalingPicture *picture, Plot *plot)
{
    static const char *const titles[] = {"compute", "exchange", "balance", "wait", NULL};
    static const int colours[] = {1, 2, 3, 10};
    plot_bars(plot, titles, colours, (size_t)bar_count(picture));
    for (int s = 0; s < picture->count; s++) {
        const ScalingSeries *series = &picture->series[s];
        if (!has_bars(picture, series))
            continue;
        for (int k = 0; k < series->count; k++) {
            const CostSample *of = &picture->runs[series->run[k]].cost;
            char name[64];
            snprintf(name, sizeof name, "%d\\n%.3g k", of->ranks, 1e-3 * of->particles);
            plot_bar(plot,
                     (double[]){1e3 * of->compute, 1e3 * of->exchange, 1e3 * of->balance, 1e3 * of->wait},
                     name);
        }
        plot_bar(plot, (double[4]){0}, " ");
    }
    plot_draw(plot, NULL);
}

/* Draws speed-up, or efficiency in percent, over ranks. */
static void draw_curves(const ScalingPicture *picture, ScalingKind kind, Plot *plot)
{
    const bool strong = kind == SCALING_STRONG;
    if (strong)
        plot_function(plot, "nothing lost", "x with lines dt 2 lc '#8795a3'");
    for (int s = 0; s < picture->count; s++) {
        const ScalingSeries *series = &picture->series[s];
        const CostSample *first = &picture->runs[series->run[0]].cost;
        char title[64];
        if (series->kind != kind)
            continue;
        snprintf(title, sizeof title, "%.3g k%s", 1e-3 * first->particles / (strong ? 1 : first->ranks),
                 strong ? "" : " a rank");
        plot_series(plot, title, "with linespoints lw 2 pt 7 lt %d", s + 1);
        for (int k = 0; k < series->count; k++)
            plot_point(plot, picture->runs[series->run[k]].cost.ranks,
                       strong ? scaling_speedup(picture->runs, series, k)
                              : 100 * scaling_efficiency(picture->runs, series, k));
    }
    plot_draw(plot, NULL);
}

/* Places the next panel of the width, and writes its title and axes. */
static void place(Plot *plot, int *left, int width, const char *title, const char *x, const char *y)
{
    fprintf(plot_commands(plot), "set origin %.4f,0\nset size %.4f,0.93\n", (double)*left / plot->width,
            (double)width / plot->width);
    plot_set(plot, "title", title, "");
    plot_set(plot, "xlabel", x, "");
    plot_set(plot, "ylabel", y, "");
    *left += width;
}

static void draw_panels(const ScalingPicture *picture, int bars_width, Plot *plot)
{
    int left = 0;
    fputs("set bmargin 5\nset key inside left top noenhanced\n", plot_commands(plot));
    if (kind_count(picture, SCALING_STRONG) > 0) {
        place(plot, &left, PANEL, "strong scaling: the same particles", "ranks", "speed-up");
        fputs("set logscale xy 2\n", plot->gnuplot);
        draw_curves(picture, SCALING_STRONG, plot);
    }
    if (kind_count(picture, SCALING_WEAK) > 0) {
        place(plot, &left, PANEL, "weak scaling: as many particles a rank", "ranks", "efficiency, %");
        fputs("set logscale x 2\nset key inside left bottom noenhanced\nset yrange [0:*]\n", plot->gnuplot);
        draw_curves(picture, SCALING_WEAK, plot);
    }
    place(plot, &left, bars_width, "what a step is made of, mean of the ranks", "ranks, particles",
          "time of a step, ms");
    fputs("set key inside left top noenhanced\nset xlabel offset 0,-1\n", plot->gnuplot);
    draw_bars(picture, plot);
}

/* Draws FILE.svg or FILE.png. */
static bool scaling_draw(const ScalingPicture *picture, const char *path, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    char title[512];
    const int bars = MARGINS + BAR * bar_count(picture), bars_width = bars > PANEL ? bars : PANEL;
    int width = bars_width;
    for (ScalingKind kind = SCALING_STRONG; kind < SCALING_KINDS; kind++)
        width += kind_count(picture, kind) > 0 ? PANEL : 0;
    if (!plot_begin(&plot, path, width, HEIGHT, error))
        return false;
    snprintf(title, sizeof title, "%s, %s", picture->sample[0].scene, picture->sample[0].processor);
    plot_set(&plot, "multiplot title", title, " noenhanced");
    draw_panels(picture, bars_width, &plot);
    return plot_end(&plot, error);
}

/* Strong and weak scaling from runs of slosh-dist bench: a table, JSON and a chart. */

typedef struct Scaling {
    const char *output, *json; /* files, or NULL */
    int read;
    ScalingSample *sample;
    ScalingRun *runs; /* of the samples */
    int count;
    ScalingSeries series[SCALING_SERIES_MAX];
} Scaling;

static bool take_option(Scaling *scaling, const char *word, const char *value, Error *error)
{
    const char **file = strcmp(word, "-o") == 0 ? &scaling->output : &scaling->json;
    if (!value)
        return error_set(error, "slosh-dist scaling: %s needs a file", word);
    *file = value;
    return file == &scaling->json || plot_check_name(value, error);
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
        } else if (!scaling_sample_read(word, &scaling->sample[scaling->read], error)) {
            return false;
        } else {
            scaling->runs[scaling->read] = scaling->sample[scaling->read].run;
            scaling->read++;
        }
    }
    return true;
}

/* Checks that all runs have one scene and one kind of processor. */
static bool equal_scenes(const Scaling *scaling, Error *error)
{
    const ScalingSample *first = &scaling->sample[0];
    for (int k = 1; k < scaling->read; k++) {
        const ScalingSample *other = &scaling->sample[k];
        if (strcmp(first->scene, other->scene) != 0)
            return error_set(error, "%s is of %s, %s of %s; give runs of one scene", first->path,
                             first->scene, other->path, other->scene);
        if (strcmp(first->processor, other->processor) != 0)
            return error_set(error, "%s is of '%s', %s of '%s'; give runs of one kind of processor",
                             first->path, first->processor, other->path, other->processor);
    }
    return true;
}

static void print_series(const Scaling *scaling, const ScalingSeries *series)
{
    const ScalingRun *first = &scaling->runs[series->run[0]];
    if (series->kind == SCALING_STRONG)
        printf("strong scaling, %.0f particles\n", first->cost.particles);
    else
        printf("weak scaling, about %.0f particles a rank\n", first->cost.particles / first->cost.ranks);
    printf("  %5s %5s %11s %9s %8s %10s %9s %9s %9s %9s %9s\n", "ranks", "cores", "particles", "step ms",
           "speed-up", "efficiency", "compute", "exchange", "balance", "wait", "imbalance");
    for (int k = 0; k < series->count; k++) {
        const ScalingSample *of = &scaling->sample[series->run[k]];
        const CostSample *cost = &of->run.cost;
        printf("  %5d %5d %11.0f %9.3f %8.2f %9.0f%% %9.3f %9.3f %9.3f %9.3f %9.3f\n", cost->ranks,
               cost->cores, cost->particles, 1e3 * of->run.step, scaling_speedup(scaling->runs, series, k),
               100 * scaling_efficiency(scaling->runs, series, k), 1e3 * cost->compute, 1e3 * cost->exchange,
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

static json_t *run_json(const Scaling *scaling, const ScalingSeries *series, int k)
{
    const ScalingSample *of = &scaling->sample[series->run[k]];
    const CostSample *cost = &of->run.cost;
    return json_pack("{s:s, s:i, s:i, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "file", of->path,
                     "ranks", cost->ranks, "cores", cost->cores, "particles", cost->particles, "step",
                     of->run.step, "speedup", scaling_speedup(scaling->runs, series, k), "efficiency",
                     scaling_efficiency(scaling->runs, series, k), "compute", cost->compute, "exchange",
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
            all, json_pack("{s:s, s:o}", "scaling", scaling_names[scaling->series[s].kind], "runs", runs));
    }
    json_t *json = json_pack("{s:s, s:s, s:o}", "scene", scaling->sample[0].scene, "processor",
                             scaling->sample[0].processor, "series", all);
    const bool ok = json_file_write(json, scaling->json, error);
    json_decref(json);
    return ok;
}

static int scale(Scaling *scaling, int count, char *const words[], Error *error)
{
    if (!read_all(scaling, count, words, error) || !equal_scenes(scaling, error))
        return EXIT_USAGE;
    scaling->count = scaling_series_find(scaling->runs, scaling->read, scaling->series);
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
    ScalingSample *sample = calloc((size_t)count + 1, sizeof *sample);
    ScalingRun *runs = calloc((size_t)count + 1, sizeof *runs);
    Scaling scaling = {.sample = sample, .runs = runs};
    Error error = {{0}};
    int code = EXIT_FAILED;
    if (!sample || !runs)
        error_set(&error, "slosh-dist scaling: no memory for %d runs", count);
    else
        code = scale(&scaling, count, words, &error);
    if (code != 0)
        fprintf(stderr, "%s\n", error.message);
    free(sample);
    free(runs);
    return code;
}
