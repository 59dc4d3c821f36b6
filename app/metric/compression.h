/* How far the particles of some states are pressed above their rest density: what the methods, whatever
   they hold, can be compared by. */
#ifndef SLOSH_COMPRESSION_H
#define SLOSH_COMPRESSION_H

#include "app/metric/cloud.h"

enum { COMPRESSION_BINS = 1280 };

/* Zero-initialise it. */
typedef struct CompressionTally {
    uint64_t states, particles; /* of all states */
    double sum, most;
    double thinned; /* the most by which one's density is below that at rest, over it */
    uint64_t bins[COMPRESSION_BINS];
} CompressionTally;

/* Fractions of the rest density, of all particles of all states; what is thinner than at rest counts as 0,
   but in `least`: the least density. */
typedef struct CompressionFigures {
    double mean, p999, most, least; /* p999: 99.9 % of them are no higher; to 1 % of itself */
} CompressionFigures;

void compression_add(CompressionTally *tally, const Cloud *cloud, const WorldDef *def);
CompressionFigures compression_figures(const CompressionTally *tally);

#endif
