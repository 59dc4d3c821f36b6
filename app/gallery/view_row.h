/* One picture of `slosh chart --views`: of which view, with which settings, how long it took, how far off it
   is. Rows are kept in a CSV file, so that a picture already there is not drawn again. */
#ifndef SLOSH_VIEW_ROW_H
#define SLOSH_VIEW_ROW_H

#include "sim/base/error.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { VIEW_ROWS_MAX = 192, VIEW_SETTINGS = 160 };

typedef struct ViewRow {
    uint64_t key; /* of all that the picture depends on, the machine but for its renderer left out */
    char view[NAME_SIZE];
    char settings[VIEW_SETTINGS]; /* "as it is", "cells=48" */
    char clock[NAME_SIZE];        /* "gl" or "finish" */
    double ms;                    /* of a picture; NaN: not drawn */
    double error, structure;      /* picture_rms and picture_structure against the view's reference; NaN */
} ViewRow;

typedef struct ViewRows {
    int count;
    ViewRow row[VIEW_ROWS_MAX];
} ViewRows;

/* The rows of an older run; none where there is no such file. A line that is no row is told to `warnings` and
   left out. False where another program wrote the file, or it cannot be read: it is not to be replaced. */
bool view_rows_read(ViewRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds a row, in place of the one with its key or, where there is no room, of the oldest. */
void view_rows_add(ViewRows *rows, const ViewRow *row);

/* Writes all rows, whole or not at all. */
bool view_rows_write(const ViewRows *rows, const char *path, Error *error);

/* NULL where there is none. */
const ViewRow *view_rows_find(const ViewRows *rows, uint64_t key);

/* Whether no other picture of its view is both cheaper and nearer, or hardly farther: by that factor. */
#define VIEW_EQUAL 1.01
bool view_on_front(const ViewRows *rows, int row);

typedef struct ViewWords {
    const char *title, *note, *renderer;
} ViewWords;

/* The chart: error over time, one colour a view, FILE.svg or FILE.png. */
bool view_rows_draw(const ViewRows *rows, const ViewWords *words, const char *path, Error *error);

/* A line a row. */
void view_rows_print(const ViewRows *rows, const ViewWords *words, FILE *file);

/* {"views": scene, "renderer", "size", "supersampled", "time", "runs": [...], "error": failure} */
typedef struct ViewFacts {
    const char *scene, *renderer;
    int width, height, factor;
    double time;
} ViewFacts;
bool view_rows_write_json(const ViewRows *rows, const ViewFacts *facts, const char *failure, const char *path,
                          Error *error);

#endif
