/* Trials of `slosh stability`, kept in a CSV file, so that no trial is repeated. */
#ifndef SLOSH_STABLE_ROW_H
#define SLOSH_STABLE_ROW_H

#include "app/run/measure/outcome.h"
#include "sim/matter/world_def.h"

#include <stdint.h>
#include <stdio.h>

enum { STABLE_AT = 192 };

/* Finder of the failure. X(ENUM, word) */
#define STABLE_FINDERS(X)                                                                                    \
    X(NOBODY, "nobody")     /* the trial holds */                                                            \
    X(SENTINEL, "sentinel") /* ended the trial */                                                            \
    X(LOOK, "look")         /* ended the trial */                                                            \
    X(LOOKS, "looks")       /* only looks; the trial went on to its end */

typedef enum StableFinder {
#define X(NAME, word) FOUND_BY_##NAME,
    STABLE_FINDERS(X)
#undef X
        STABLE_FINDER_COUNT
} StableFinder;

/* The outcome of a scene at one step. */
typedef struct StableRow {
    uint64_t key; /* hash of all inputs of the trial: app/lab/run_key.h */
    char method[NAME_SIZE], backend[NAME_SIZE];
    int rung;           /* of the step: app/stability/stable_search.h */
    char at[STABLE_AT]; /* "solver.sound_speed=14 fluids[0].viscosity=2" */
    uint64_t steps;     /* made */
    StableFinder finder;
    Outcome outcome;
} StableRow;

/* Ordered by key. Zero-initialise before use. */
typedef struct StableRows {
    size_t count, room;
    StableRow *row;
} StableRows;

void stable_rows_free(StableRows *rows);

/* Returns the row with the key, or NULL. */
const StableRow *stable_rows_find(const StableRows *rows, uint64_t key);

/* Adds a row, replacing the row with the same key. Returns false if memory is short. */
bool stable_rows_add(StableRows *rows, const StableRow *row);

/* Reads the sound rows of the file; zero rows if the file is missing or empty. Each unsound row, or a file
   of another version, is reported to `warnings` (may be NULL). Returns false with the reason if the file
   cannot be read or is no such table; such a file must not be replaced. */
bool stable_rows_read(StableRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds the rows written to the file since it was read, by another map under the same name. Of two rows of
   a trial, one ended by a look and one complete, the complete row stays. Returns false as
   stable_rows_read. */
bool stable_rows_merge(StableRows *rows, const char *path, Error *error);

/* Writes all rows, ordered by method, backend, cell and step: the same rows give the same file. The file
   is complete or not written at all. */
bool stable_rows_write(const StableRows *rows, const char *path, Error *error);

#endif
