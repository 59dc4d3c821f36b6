/* The lid-driven cavity: velocities on its centre lines, against Ghia, Ghia and Shin 1982. */
#include "app/bench/cases/case.h"
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>
#include <stdio.h>

static const char PUBLISHED[] = "scenes/reference/ghia-1982.csv";

/* The flow is steady after this fraction of the time; the mean over later samples removes the particles'
   noise. */
static const double STEADY = 0.75;

/* Position of the k-th published point along a line: x for v, y for u. */
static double along_of(const Reference *published, int line, int k)
{
    return reference_number(published, k, line ? "x" : "y");
}

/* Adds the velocities across both lines at the published points, state after state, to columns 0 and 1. */
static void sample(CaseRun *run)
{
    Reference published;
    Error none;
    const double side = run->def->box_size[0];
    if (run->info.time < STEADY * run->of->time || !reference_load(PUBLISHED, &published, &none))
        return;
    for (int line = 0; line < 2; line++)
        for (int k = 0; k < published.rows; k++) {
            const double along = along_of(&published, line, k);
            const double at[2] = {line ? (along - 0.5) * side : 0, line ? 0.5 * side : along * side};
            double v[2] = {(double)NAN, (double)NAN};
            metric_velocity(&run->cloud, at, v);
            curve_add(&run->column[line], along, v[line]);
        }
}

/* Mean of every `rows`-th value from index k on. */
static double mean_of(const Curve *column, int rows, int k)
{
    double sum = 0;
    int count = 0;
    for (size_t i = (size_t)k; i < column->count; i += (size_t)rows, count++)
        sum += column->at[i][1];
    return sum / count;
}

/* Error: the greatest difference over the published points of both lines, over the lid's speed. The plot
   shows u over y and v over x together. */
static bool judge(CaseRun *run, Error *error)
{
    Reference published;
    const WorldDef *def = run->def;
    const double side = def->box_size[0], lid = def->lid[0];
    const double reynolds = lid * side * def->fluids[0].density / def->fluids[0].viscosity;
    double worst = 0;
    if (!reference_load(PUBLISHED, &published, error))
        return false;
    for (int line = 0; line < 2; line++) {
        char column[32];
        snprintf(column, sizeof column, "%s%.0f", line ? "v" : "u", reynolds);
        if (!*reference_text(&published, 0, column))
            return error_set(error, "%s: has no column %s; the Reynolds number is 100, 400 or 1000",
                             published.path, column);
        for (int k = 0; k < published.rows; k++) {
            const double along = along_of(&published, line, k);
            const double right = reference_number(&published, k, column);
            const double found = mean_of(&run->column[line], published.rows, k) / lid;
            if (isnan(right))
                continue;
            worst = figure_worse(worst, fabs(found - right));
            curve_add(&run->found[line], along, found);
            curve_add(&run->expected[line], along, right);
        }
    }
    run->figures[0] = figure_scaled(worst, 0, 1);
    return true;
}

#define COMMON                                                                                               \
    .scene = "scenes/cases/cavity.yaml",                                                                     \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "mueller",                                                                          \
                 .left_out = "shifting is wcsph's alone, and saddle points line its particles up"},          \
                {.name = "dfsph",                                                                            \
                 .left_out = "shifting is wcsph's alone, and saddle points line its particles up"},          \
                {.name = "pbf",                                                                              \
                 .left_out = "shifting is wcsph's alone, and saddle points line its particles up"}},         \
    .plot = {.x = "place on the line, of the side",                                                          \
             .y = "velocity across it, of the lid's",                                                        \
             .found = {"u", "v"},                                                                            \
             .expected = {"u, Ghia 1982", "v, Ghia 1982"},                                                   \
             .points = true},                                                                                \
    .every = 0.5, .sample = sample, .judge = judge

const Case case_cavity = {
    .name = "cavity",
    .help = "lid-driven cavity, Re 100, Ghia 1982",
    .spacing = {0.05, 0.02, 0.01},
    .time = 20,
    .metrics = {{"centre lines", "of the lid", .tolerance = 0.04, .coarse = 0.06}},
    COMMON,
};

const Case case_cavity_400 = {
    .name = "cavity_400",
    .help = "lid-driven cavity, Re 400, Ghia 1982",
    .only_full = true,
    .setting = "fluids[0].viscosity=2.5",
    .spacing = {0.05, 0.02, 0.01},
    .time = 40,
    .metrics = {{"centre lines", "of the lid", .tolerance = 0.08, .coarse = 0.2}},
    COMMON,
};

const Case case_cavity_1000 = {
    .name = "cavity_1000",
    .help = "lid-driven cavity, Re 1000, Ghia 1982",
    .only_full = true,
    .setting = "fluids[0].viscosity=1",
    .spacing = {0.05, 0.02, 0.01},
    .time = 60,
    .metrics = {{"centre lines", "of the lid", .tolerance = 0.08, .coarse = 0.35}},
    COMMON,
};
