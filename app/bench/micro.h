/* Times each part of a substep alone, and compares with the limits of the machine. See sim/step/method.h
   for the counting. */
#ifndef APP_BENCH_MICRO_H
#define APP_BENCH_MICRO_H

#include "app/scene/scene.h"
#include "sim/step/method.h"

#include <stdio.h>

/* Lower bounds of a part's time: copying its bytes through memory, or from a cache; its operations as
   fused multiply-adds. */
typedef enum MicroLimit { MICRO_MEMORY, MICRO_CACHE, MICRO_FLOPS, MICRO_LIMIT_COUNT } MicroLimit;

typedef struct MicroFigure {
    const char *name;
    bool pairs;
    PairCost pair;
    double bytes_per_particle, bytes_per_pair; /* through memory; and from a cache, with a list entry */
    double ms;                                 /* least of all rounds */
    double particle_steps_per_second, pairs_per_second, bytes_per_second, flops_per_second;
    double flops_share; /* of the fused ceiling */
    MicroLimit limit;   /* the binding limit */
    double share;       /* of the limit: lower bound of the time over measured time */
} MicroFigure;

typedef struct MicroResult {
    char scene[1024], method[NAME_SIZE];
    char swept[256];
    char left_out[512]; /* why there are no figures; "" on success */
    int threads, rounds;
    size_t particles;
    double neighbours_mean;
    double time;     /* simulated time of the state, s */
    double asked;    /* s: `time` is less if the wall time limit came first */
    double least_ms; /* least wall time: making the world and the fewest rounds */
    int count;
    MicroFigure figures[MICRO_PARTS_MAX];
} MicroResult;

typedef struct MicroSetup {
    const Scene *scene;
    int rounds;     /* 0: as many as needed for a good figure */
    double seconds; /* limit of wall time */
    double from;    /* s: simulated time of a second state; 0: none */
} MicroSetup;

/* Measures the state at the start and the second state: *count results. Measures `ceilings` if not yet
   done. */
bool micro_measure(const MicroSetup *setup, Ceilings *ceilings, MicroResult results[2], int *count,
                   Error *error);

void micro_print_ceilings(const Ceilings *ceilings, int threads, FILE *file);
void micro_print(const MicroResult *result, FILE *file);

/* Writes an array of all results, each with the ceilings. A left out result has "left_out" in place of
   figures. */
bool micro_write_json(const MicroResult *results, size_t count, const Ceilings *ceilings, const char *path,
                      Error *error);

#endif
