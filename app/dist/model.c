/* The model of cost, fitted to files of slosh-dist bench. */
#include "app/base/program.h"
#include "app/dist/cmd.h"
#include "app/dist/sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double FAR_PARTICLES = 1e9;
enum { FAR_RANKS = 4096 };

/* Reads the files before and after "--beside"; `fitted` gets the count before. */
static int read_samples(int count, char *const paths[], Sample *samples, int *fitted, Error *error)
{
    int read = 0;
    *fitted = -1;
    for (int k = 0; k < count; k++)
        if (strcmp(paths[k], "--beside") == 0 && *fitted < 0)
            *fitted = read;
        else if (!sample_read(paths[k], &samples[read++], error))
            return -1;
    if (*fitted < 0)
        *fitted = read;
    return read;
}

static bool one_kind(const Sample *samples, int count, Error *error)
{
    for (int k = 1; k < count; k++)
        if (samples[k].dimensions != samples[0].dimensions)
            return error_set(error, "%s has %d dimensions, %s has %d; a model is of one kind of scene",
                             samples[k].path, samples[k].dimensions, samples[0].path, samples[0].dimensions);
    return true;
}

static bool fit(const Sample *samples, int fitted, CostModel *model, Error *error)
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

static void print_beside(const CostModel *model, const Sample *sample, bool fitted)
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
    Sample *samples = calloc((size_t)count, sizeof *samples);
    const int read = samples ? read_samples(count, paths, samples, &fitted, &error) : -1;
    if (!samples)
        error_set(&error, "no memory for the samples");
    if (read < 0 || !one_kind(samples, read, &error) || !fit(samples, fitted, &model, &error)) {
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
