/* The parts of a substep, each alone, beside the limits of the machine: see sim/world/micro.h for what is
   counted. */
#ifndef SLOSH_LAB_MICRO_H
#define SLOSH_LAB_MICRO_H

#include "app/scene/scene.h"
#include "sim/world/micro.h"

#include <stdio.h>

/* What a part takes at least: its bytes by a copy of as many, or from a cache; its operations, fused. */
typedef enum MicroLimit { MICRO_MEMORY, MICRO_CACHE, MICRO_FLOPS, MICRO_LIMIT_COUNT } MicroLimit;

typedef struct MicroFigure {
    const char *name;
    bool pairs;
    PairCost pair;
    double bytes_per_particle, bytes_per_pair; /* through memory; and from a cache, with a list's entry */
    double ms;                                 /* the least of all rounds */
    double particle_steps_per_second, pairs_per_second, bytes_per_second, flops_per_second;
    double flops_share; /* of the fused ceiling */
    MicroLimit limit;   /* the one that binds */
    double share;       /* of it: what the part takes at least over what it took */
} MicroFigure;

typedef struct MicroResult {
    char scene[1024], method[NAME_SIZE];
    char swept[256];
    char left_out[512]; /* why there are no figures; "": there are */
    int threads, rounds;
    size_t particles;
    double neighbours_mean;
    double time;     /* of the state, s */
    double asked;    /* s: `time` is less where the limit came first */
    double least_ms; /* the making of the world and the fewest rounds */
    int count;
    MicroFigure figures[MICRO_PARTS_MAX];
} MicroResult;

typedef struct MicroSetup {
    const Scene *scene;
    int rounds;     /* 0: as many as a good figure needs */
    double seconds; /* of wall time at most */
    double from;    /* s: a second state, simulated up to there; 0: none */
} MicroSetup;

/* The state at the start, and the second one: *count results. `ceilings` are measured where they are not yet.
 */
bool micro_measure(const MicroSetup *setup, Ceilings *ceilings, MicroResult results[2], int *count,
                   Error *error);

/* The greatest rate of copies of at least as many bytes, bytes/s; of the largest where none is. */
double micro_copy(const Ceilings *ceilings, double bytes);

const char *micro_limit_name(MicroLimit limit);

void micro_print_ceilings(const Ceilings *ceilings, int threads, FILE *file);
void micro_print(const MicroResult *result, FILE *file);

/* An array of all results, with the ceilings in each; what was left out has "left_out" in place of figures.
 */
bool micro_write_json(const MicroResult *results, size_t count, const Ceilings *ceilings, const char *path,
                      Error *error);

#endif
