#include "app/lab/scaling.h"

#include <math.h>
#include <stdbool.h>

typedef struct RankLattice {
    double faces, neighbours; /* means over ranks */
} RankLattice;

/* Places prime factors of the ranks, greatest first, along the side with the fewest ranks. */
static RankLattice lattice(int ranks, int dimensions)
{
    const int sides = dimensions == 2 ? 2 : 3;
    int along[3] = {1, 1, 1}, prime = ranks;
    RankLattice result = {0, 1};
    while (ranks > 1) {
        while (prime > 2 && ranks % prime != 0)
            prime--;
        for (int i = 2; i * i <= prime; i++)
            if (prime % i == 0) {
                prime /= i;
                i = 1;
            }
        int least = 0;
        for (int d = 1; d < sides; d++)
            if (along[d] < along[least])
                least = d;
        along[least] *= prime;
        ranks /= prime;
        prime = ranks;
    }
    for (int d = 0; d < sides; d++) {
        result.faces += 2 - 2.0 / along[d];
        result.neighbours *= 3 - 2.0 / along[d];
    }
    result.neighbours -= 1;
    return result;
}

static double surface(double particles, int ranks, int dimensions)
{
    return pow(particles / ranks, 1 - 1.0 / dimensions);
}

/* Minimises the squares of (exchange - latency messages - slowness bytes) / exchange, with latency and
   slowness at least 0. */
static void fit_exchange(const CostSample *samples, int count, CostModel *model)
{
    double mm = 0, mb = 0, bb = 0, m = 0, b = 0;
    for (int i = 0; i < count; i++) {
        if (samples[i].ranks < 2 || !(samples[i].exchange > 0))
            continue;
        const double messages = samples[i].messages / samples[i].exchange;
        const double bytes = samples[i].bytes / samples[i].exchange;
        mm += messages * messages;
        mb += messages * bytes;
        bb += bytes * bytes;
        m += messages;
        b += bytes;
    }
    const double determinant = mm * bb - mb * mb;
    const bool separable = determinant > 1e-9 * mm * bb;
    double latency = separable ? (m * bb - b * mb) / determinant : 0;
    double slowness = separable ? (b * mm - m * mb) / determinant : bb > 0 ? b / bb : 0;
    if (latency < 0) {
        latency = 0;
        slowness = b / bb;
    } else if (slowness < 0) {
        slowness = 0;
        latency = m / mm;
    }
    model->latency = latency;
    model->bandwidth = 1 / slowness;
}

bool cost_fit(const CostSample *samples, int count, int dimensions, CostModel *model, Error *error)
{
    int shared = 0;
    *model = (CostModel){.dimensions = dimensions};
    for (int i = 0; i < count; i++) {
        const CostSample *of = &samples[i];
        if (!(of->particles >= 1 && of->ranks >= 1 && of->cores >= 1))
            return error_set(error, "a sample without particles, ranks or processors says nothing");
        model->compute += of->compute * of->cores / of->particles / count;
        if (of->ranks < 2)
            continue;
        const RankLattice ranks = lattice(of->ranks, dimensions);
        shared++;
        model->surface += of->ghosts / ranks.faces / surface(of->particles, of->ranks, dimensions);
        model->bytes += of->ghosts > 0 ? of->bytes / of->ghosts : 0;
        model->messages += of->messages / ranks.neighbours;
        model->balance += of->balance * of->ranks / of->particles;
        model->wait += of->compute > 0 ? of->wait / of->compute : 0;
    }
    if (!shared)
        return error_set(error, "no sample has more than one rank: nothing tells what an exchange costs");
    model->surface /= shared;
    model->bytes /= shared;
    model->messages /= shared;
    model->balance /= shared;
    model->wait /= shared;
    fit_exchange(samples, count, model);
    return true;
}

CostSample cost_predict(const CostModel *model, double particles, int ranks, int cores)
{
    const RankLattice all = lattice(ranks, model->dimensions);
    CostSample step = {.particles = particles, .ranks = ranks, .cores = cores};
    step.compute = model->compute * particles / cores;
    step.ghosts = model->surface * all.faces * surface(particles, ranks, model->dimensions);
    step.bytes = model->bytes * step.ghosts;
    step.messages = model->messages * all.neighbours;
    step.exchange = model->latency * step.messages + step.bytes / model->bandwidth;
    step.balance = ranks > 1 ? model->balance * particles / ranks : 0;
    step.wait = ranks > 1 ? model->wait * step.compute : 0;
    return step;
}

double cost_step(const CostSample *sample)
{
    return sample->compute + sample->exchange + sample->balance + sample->wait;
}

const char *const scaling_names[SCALING_KINDS] = {"strong", "weak"};

/* Greatest relative difference of size from the first run of a series. */
static const double alike[SCALING_KINDS] = {0.02, 0.15};

/* Returns the size shared by the runs of a series. */
static double size_of(const ScalingRun *run, ScalingKind kind)
{
    return kind == SCALING_STRONG ? run->cost.particles : run->cost.particles / run->cost.ranks;
}

/* Adds a run if its ranks are new to the series, or if the run is faster than the present run with these
   ranks. */
static void take(const ScalingRun *runs, ScalingSeries *series, int run)
{
    int at = 0;
    const CostSample *cost = &runs[run].cost;
    while (at < series->count && runs[series->run[at]].cost.ranks < cost->ranks)
        at++;
    if (at < series->count && runs[series->run[at]].cost.ranks == cost->ranks) {
        if (runs[run].step / cost->particles <
            runs[series->run[at]].step / runs[series->run[at]].cost.particles)
            series->run[at] = run;
        return;
    }
    if (series->count == SCALING_RUNS)
        return;
    for (int k = series->count++; k > at; k--)
        series->run[k] = series->run[k - 1];
    series->run[at] = run;
}

/* Returns the least size above `above`; infinite if there is none. */
static double next_size(const ScalingRun *runs, int count, ScalingKind kind, double above)
{
    double least = (double)INFINITY;
    for (int k = 0; k < count; k++)
        if (size_of(&runs[k], kind) > above && size_of(&runs[k], kind) < least)
            least = size_of(&runs[k], kind);
    return least;
}

int scaling_series_find(const ScalingRun *runs, int count, ScalingSeries series[SCALING_SERIES_MAX])
{
    int found = 0;
    for (ScalingKind kind = SCALING_STRONG; kind < SCALING_KINDS; kind++) {
        double size = 0;
        while (found < SCALING_SERIES_MAX && isfinite(size = next_size(runs, count, kind, size))) {
            const double most = size * (1 + alike[kind]);
            ScalingSeries *one = &series[found];
            *one = (ScalingSeries){.kind = kind};
            for (int k = 0; k < count; k++)
                if (size_of(&runs[k], kind) >= size && size_of(&runs[k], kind) <= most)
                    take(runs, one, k);
            found += one->count > 1;
            size = most;
        }
    }
    return found;
}

static double rate(const ScalingRun *run)
{
    return run->cost.particles / run->step;
}

double scaling_speedup(const ScalingRun *runs, const ScalingSeries *series, int k)
{
    return rate(&runs[series->run[k]]) / rate(&runs[series->run[0]]);
}

double scaling_efficiency(const ScalingRun *runs, const ScalingSeries *series, int k)
{
    return scaling_speedup(runs, series, k) * runs[series->run[0]].cost.cores /
           runs[series->run[k]].cost.cores;
}
