/* What a step costs on ranks, by a model of few numbers that is fitted to what was measured, and what it says
   of runs that nobody made: a prediction, no measurement.

   A step of n particles on p ranks with c processors at work takes

       compute   a n / c
       exchange  latency * messages + bytes / bandwidth
       balance   b n / p
       wait      w * compute, nothing on one rank

   where a rank has k (n / p)^(2/3) ghosts for each of its faces towards others (surface to volume; ^(1/2) in
   two dimensions), each ghost costs the same bytes a step, and each neighbour the same messages. Faces and
   neighbours are those of a lattice of ranks, cut along its longest side again and again: 1 and 1 for two
   ranks, 2 and 3 for four, near 6 and 26 for many. */
#ifndef SLOSH_COST_H
#define SLOSH_COST_H

#include "sim/base/error.h"

/* A run, as means over ranks and steps. */
typedef struct CostSample {
    double particles;                        /* of all ranks */
    int ranks, cores;                        /* cores: processors at work, of all ranks */
    double compute, exchange, balance, wait; /* s a step */
    double ghosts;                           /* of a rank */
    double bytes, messages;                  /* that a rank sends in a step */
} CostSample;

typedef struct CostModel {
    int dimensions;            /* 2 or 3 */
    double compute;            /* a: s a particle and processor */
    double surface;            /* k */
    double bytes, messages;    /* of a ghost; of a neighbour; a step */
    double latency, bandwidth; /* s a message; bytes/s, infinite where bytes cost nothing that shows */
    double balance, wait;      /* b: s a particle of a rank; w */
} CostModel;

/* At least one sample has more than one rank. Least squares of relative errors; with samples of one size
   alone all of the exchange counts as bytes. False, with what is missing, otherwise. */
bool cost_fit(const CostSample *samples, int count, int dimensions, CostModel *model, Error *error);

/* Any numbers of 1 or more. */
CostSample cost_predict(const CostModel *model, double particles, int ranks, int cores);

/* s */
double cost_step(const CostSample *sample);

#endif
