/* Flows between two plates, starting at rest: Poiseuille flow, driven by a force, and Couette flow, driven
   by the upper plate. */
#include "app/bench/cases/case_list.h"

#include <math.h>

enum { ERROR, TERMS = 200 };

static const double FROM = 0.1; /* s: before, the velocity has a jump at a plate */

/* u = a y (H - y) / (2 nu) minus its sine series; each term decays at its own rate. */
static double poiseuille(const WorldDef *def, double y, double t)
{
    const double nu = def->fluids[0].viscosity / def->fluids[0].density, height = def->box_size[1],
                 a = def->gravity[0];
    double u = a * y * (height - y) / (2 * nu);
    for (int n = 1; n < TERMS; n += 2) {
        const double k = n * M_PI / height;
        u -= 4 * a / (nu * k * k * k * height) * sin(k * y) * exp(-nu * k * k * t);
    }
    return u;
}

static double couette(const WorldDef *def, double y, double t)
{
    const double nu = def->fluids[0].viscosity / def->fluids[0].density, height = def->box_size[1],
                 speed = def->lid[0];
    double u = speed * y / height;
    for (int n = 1; n < TERMS; n++) {
        const double k = n * M_PI / height;
        u += 2 * speed / (n * M_PI) * (n % 2 ? -1 : 1) * sin(k * y) * exp(-nu * k * k * t);
    }
    return u;
}

typedef double (*Profile)(const WorldDef *def, double y, double t);

static double greatest(const WorldDef *def)
{
    const double nu = def->fluids[0].viscosity / def->fluids[0].density, height = def->box_size[1];
    return fmax(fabs(def->lid[0]), fabs(def->gravity[0]) * height * height / (8 * nu));
}

/* rms over the particles of the error of the velocity along the plates. */
static void sample(CaseRun *run, Profile profile)
{
    double sum2 = 0;
    if (run->info.time < FROM)
        return;
    for (size_t i = 0; i < run->cloud.count; i++) {
        const double right = profile(run->def, run->cloud.position[4 * i + 1], run->info.time);
        sum2 += pow(run->cloud.velocity[4 * i] - right, 2) / (double)run->cloud.count;
    }
    curve_add(&run->column[ERROR], run->info.time, sqrt(sum2));
}

static void sample_poiseuille(CaseRun *run)
{
    sample(run, poiseuille);
}

static void sample_couette(CaseRun *run)
{
    sample(run, couette);
}

static bool judge(CaseRun *run, Profile profile)
{
    const double height = run->def->box_size[1];
    double worst = 0;
    for (size_t i = 0; i < run->column[ERROR].count; i++)
        worst = figure_worse(worst, run->column[ERROR].at[i][1]);
    run->figures[0] = figure_scaled(worst, 0, greatest(run->def));
    for (size_t i = 0; i < run->cloud.count; i++)
        curve_add(&run->found[0], run->cloud.position[4 * i + 1], run->cloud.velocity[4 * i]);
    for (int i = 0; i <= 100; i++)
        curve_add(&run->expected[0], height * i / 100, profile(run->def, height * i / 100, run->info.time));
    return true;
}

static bool judge_poiseuille(CaseRun *run, Error *error)
{
    (void)error;
    return judge(run, poiseuille);
}

static bool judge_couette(CaseRun *run, Error *error)
{
    (void)error;
    return judge(run, couette);
}

#define COMMON                                                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "mueller", .coarse = {0.03}},                                                       \
                {.name = "dfsph",                                                                            \
                 .set = {"solver.negative_pressure=false"},                                                  \
                 .why = {"what its solver leaves: 0.63 % with solver.tolerance 1e-4"}},                      \
                {.name = "pbf",                                                                              \
                 .left_out = "a step of 1/60 s stands a tenth of 100 Pa s, so that another fluid flows"}},   \
    .spacing = {0.05, 0.02, 0.01}, .time = 2, .every = 0.05,                                                 \
    .metrics = {{"rms velocity, worst", "m/s", .tolerance = 0.01, .coarse = 0.02}},                          \
    .plot = {                                                                                                \
        .x = "height, m", .y = "velocity, m/s", .found = {"particles"}, .expected = {"exact"}, .dots = true}

const Case case_poiseuille = {
    .name = "poiseuille",
    .help = "Poiseuille's flow from rest",
    .scene = "scenes/cases/poiseuille.yaml",
    COMMON,
    .sample = sample_poiseuille,
    .judge = judge_poiseuille,
};

const Case case_couette = {
    .name = "couette",
    .help = "Couette's flow from rest",
    .scene = "scenes/cases/couette.yaml",
    COMMON,
    .sample = sample_couette,
    .judge = judge_couette,
};
