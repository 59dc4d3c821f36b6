#include "app/metric/compression.h"

#include <math.h>

/* Bins of a constant ratio, so that a percentile has a constant relative accuracy. */
static const double LEAST = 1e-6, BINS_AN_OCTAVE = 64;

static int bin_of(double pressed)
{
    const double bin = pressed > LEAST ? BINS_AN_OCTAVE * log2(pressed / LEAST) : 0;
    return (int)fmin(bin, COMPRESSION_BINS - 1);
}

void compression_add(CompressionTally *tally, const Cloud *cloud, const WorldDef *def)
{
    for (size_t i = 0; i < cloud->count; i++) {
        const double rest = def->fluids[cloud->fluid[i]].density;
        const double change = (double)cloud->density[i] / rest - 1, pressed = fmax(change, 0);
        tally->sum += pressed;
        tally->most = fmax(tally->most, pressed);
        tally->thinned = fmax(tally->thinned, -change);
        tally->bins[bin_of(pressed)]++;
    }
    tally->particles += cloud->count;
    tally->states++;
}

/* Returns the upper end of the percentile's bin. */
static double percentile(const CompressionTally *tally, double fraction)
{
    const double below = fraction * (double)tally->particles;
    double count = 0;
    for (int b = 0; b < COMPRESSION_BINS; b++) {
        count += (double)tally->bins[b];
        if (count >= below)
            return fmin(b == 0 ? 0 : LEAST * exp2((b + 1) / BINS_AN_OCTAVE), tally->most);
    }
    return tally->most;
}

CompressionFigures compression_figures(const CompressionTally *tally)
{
    if (tally->particles == 0)
        return (CompressionFigures){0};
    return (CompressionFigures){tally->sum / (double)tally->particles, percentile(tally, 0.999), tally->most,
                                1 - tally->thinned};
}
