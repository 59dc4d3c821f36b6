/* The trials of `slosh stability`, kept in a CSV file, so that none that is there is made again. */
#ifndef SLOSH_STABLE_ROW_H
#define SLOSH_STABLE_ROW_H

#include "app/outcome/outcome.h"
#include "sim/matter/world_def.h"

#include <stdint.h>
#include <stdio.h>

enum { STABLE_AT = 192 };

/* Who found that it does not hold. X(ENUM, word) */
#define STABLE_FINDERS(X)                                                                                    \
    X(NOBODY, "nobody")     /* it holds */                                                                   \
    X(SENTINEL, "sentinel") /* which ended it */                                                             \
    X(LOOK, "look")         /* which ended it */                                                             \
    X(LOOKS, "looks")       /* alone, and the trial went on to its end */

typedef enum StableFinder {
#define X(NAME, word) FOUND_BY_##NAME,
    STABLE_FINDERS(X)
#undef X
        STABLE_FINDER_COUNT
} StableFinder;

/* A scene at one step: how it went. */
typedef struct StableRow {
    uint64_t key; /* of all that the trial depends on: app/lab/run_key.h */
    char method[NAME_SIZE], backend[NAME_SIZE];
    int rung;           /* of the step: app/stability/stable_search.h */
    char at[STABLE_AT]; /* "solver.sound_speed=14 fluids[0].viscosity=2" */
    uint64_t steps;     /* that were made */
    StableFinder finder;
    Outcome outcome;
} StableRow;

/* Ordered by key. Zero-initialise it. */
typedef struct StableRows {
    size_t count, room;
    StableRow *row;
} StableRows;

void stable_rows_free(StableRows *rows);

/* NULL where there is none. */
const StableRow *stable_rows_find(const StableRows *rows, uint64_t key);

/* In place of the one with its key. False without memory. */
bool stable_rows_add(StableRows *rows, const StableRow *row);

/* The sound rows of the file; none where there is no such file, or it is empty. Each other row, or that the
   file is of another version, is told to `warnings` (NULL: to nobody). False with the reason where the file
   is no such table, or cannot be read: it is not to be replaced. */
bool stable_rows_read(StableRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds the rows that the file has got since it was read, from another map under the same name; of one trial
   that a look ended and another that went on, the other. False as stable_rows_read. */
bool stable_rows_merge(StableRows *rows, const char *path, Error *error);

/* Writes all rows, whole or not at all, in the order of method, backend, place and step: the same rows are
   the same file. */
bool stable_rows_write(const StableRows *rows, const char *path, Error *error);

#endif
