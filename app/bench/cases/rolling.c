/* A rolling tank: the surface height at the tank's side and the fluid's centre of mass, compared with
   linear theory.
   after: O. M. Faltinsen, A. N. Timokha, "Sloshing", 2009, chapter 5. In the tank's frame the surface is a
   sum of modes beta_m cos(k_m (x + l / 2)), k_m = m pi / l, sigma_m^2 = g k_m tanh(k_m d). Each mode is
   driven by the tank's angle, which tilts gravity, and by the angular acceleration, through the
   Stokes-Joukowski potential of a fluid under a lid. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { SIDE, CENTRE, MODES = 99 };

typedef struct Roll {
    double angle, omega;         /* rad, rad/s */
    double length, depth, pivot; /* m; pivot: above the floor */
    double gravity;
    double start; /* s */
} Roll;

static Roll roll_of(const WorldDef *def)
{
    const Fill *fill = &def->fluids[0].fills[0];
    const Motion *motion = &def->motions[0];
    return (Roll){.angle = motion->angle_deg * M_PI / 180,
                  .omega = 2 * M_PI * motion->frequency,
                  .length = fill->max[0] - fill->min[0],
                  .depth = fill->max[1] - fill->min[1],
                  .pivot = 0.5 * def->box_size[1],
                  .gravity = -def->gravity[1],
                  .start = motion->start};
}

/* beta of mode m (odd), for an angle starting as sin: b'' + sigma^2 b = -K (g theta + S theta''),
   including the impulse of the start in theta''. `along` gets the mode's part of x. */
static double mode_at(const Roll *r, int m, double t, double *along)
{
    const double k = m * M_PI / r->length, tank = tanh(k * r->depth), sigma = sqrt(r->gravity * k * tank);
    *along = -4 / (r->length * k * k);
    const double strength = k * tank * *along,
                 lever = 2 * tanh(0.5 * k * r->depth) / k - (r->depth - r->pivot);
    const double forced =
        strength * (sigma * sigma * lever - r->gravity) * r->angle / (sigma * sigma - r->omega * r->omega);
    return forced * (sin(r->omega * t) - r->omega / sigma * sin(sigma * t)) -
           strength * lever * r->angle * sin(r->omega * t);
}

/* Linear theory of the height at the side x = l / 2, over the depth, and of the centre of mass. */
static void theory(const Roll *r, double t, double *side, double *centre)
{
    *side = *centre = 0;
    for (int m = 1; m <= MODES; m += 2) {
        double along;
        const double beta = mode_at(r, m, t, &along);
        *side -= beta;
        *centre += beta * along / (2 * r->depth);
    }
}

static void sample(CaseRun *run)
{
    double centre[3];
    metric_centre(&run->cloud, -INFINITY, INFINITY, centre);
    curve_add(&run->column[SIDE], run->info.time, (double)run->probe[0]);
    curve_add(&run->column[CENTRE], run->info.time, centre[0]);
}

/* Root mean square of the error, over the root mean square of the theory. */
static CaseFigure miss_of(const Curve *found, const Curve *expected)
{
    double off = 0, all = 0;
    for (size_t i = 0; i < found->count; i++) {
        off += pow(found->at[i][1] - expected->at[i][1], 2);
        all += pow(expected->at[i][1], 2);
    }
    return figure_scaled(sqrt(off / all), 0, 1);
}

/* Mean while the tank is at rest: gauge and fluid height have offsets of a fraction of a spacing. */
static double at_rest(const Curve *curve, double start)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < curve->count; i++)
        if (curve->at[i][0] > 0.5 * start && curve->at[i][0] < start) {
            sum += curve->at[i][1];
            count++;
        }
    return sum / count;
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const Roll r = roll_of(run->def);
    for (int what = SIDE; what <= CENTRE; what++) {
        const double rest = at_rest(&run->column[what], r.start);
        for (size_t i = 0; i < run->column[what].count; i++) {
            const double *at = run->column[what].at[i];
            double now[2];
            theory(&r, fmax(at[0] - r.start, 0), &now[SIDE], &now[CENTRE]);
            curve_add(&run->found[what], at[0], at[1] - rest);
            curve_add(&run->expected[what], at[0], now[what]);
        }
        run->figures[what] = miss_of(&run->found[what], &run->expected[what]);
    }
    return true;
}

const Case case_rolling = {
    .name = "rolling",
    .help = "a tank that rolls off its resonance: its surface by linear theory",
    .scene = "scenes/cases/rolling.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "dfsph", .tolerance = {0.09, 0.04}, .coarse = {0.12, 0.04}},
                {.name = "mueller", .tolerance = {0.37, 0.32}, .coarse = {0.52, 0.4}},
                {.name = "pbf", .tolerance = {0.18, 0.11}, .coarse = {0.31, 0.22}}},
    .spacing = {0.5 / 15, 0.5 / 30, 0.5 / 45},
    .time = 5,
    .every = 0.02,
    .metrics = {{"surface at the side", "", .tolerance = 0.075, .coarse = 0.09},
                {"centre of mass", "", .tolerance = 0.06, .coarse = 0.06}},
    .plot = {.x = "time, s",
             .y = "surface at the side, centre of mass, m",
             .found = {"surface", "centre"},
             .expected = {"linear theory", "its centre"}},
    .sample = sample,
    .judge = judge,
};
