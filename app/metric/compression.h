/* Compression of particles above their rest density over several states: a comparison for all methods. */
#ifndef SLOSH_COMPRESSION_H
#define SLOSH_COMPRESSION_H

#include "app/metric/cloud.h"

enum { COMPRESSION_BINS = 1280 };

/* Zero-initialise before use. */
typedef struct CompressionTally {
    uint64_t states, particles; /* of all states */
    double sum, most;
    double thinned; /* greatest relative deficit of density below rest density */
    uint64_t bins[COMPRESSION_BINS];
} CompressionTally;

/* Fractions of the rest density, over all particles of all states. Densities below rest count as 0, except
   in `least`, the least density. */
typedef struct CompressionFigures {
    double mean, p999, most, least; /* p999: 99.9 % of particles are at or below p999; accurate to 1 % */
} CompressionFigures;

void compression_add(CompressionTally *tally, const Cloud *cloud, const WorldDef *def);
CompressionFigures compression_figures(const CompressionTally *tally);

#endif
