/* One picture of `slosh chart --views`: its view, settings, drawing time and error. Rows are kept in a CSV
   file, so that no picture is drawn twice. */
#ifndef SLOSH_VIEW_ROW_H
#define SLOSH_VIEW_ROW_H

#include "sim/base/error.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { VIEW_ROWS_MAX = 192, VIEW_SETTINGS = 160 };

typedef struct ViewRow {
    uint64_t key; /* hash of all inputs of the picture; of the machine only the renderer */
    char view[NAME_SIZE];
    char settings[VIEW_SETTINGS]; /* "as it is", "cells=48" */
    char clock[NAME_SIZE];        /* "gl" or "finish" */
    double ms;                    /* per picture; NaN: not drawn */
    double error, structure;      /* picture_rms and picture_structure from the view's reference; or NaN */
} ViewRow;

typedef struct ViewRows {
    int count;
    ViewRow row[VIEW_ROWS_MAX];
} ViewRows;

/* Reads the rows of an older run; zero rows if the file is missing. An unsound line is reported to
   `warnings` and skipped. Returns false if the file cannot be read or was written by another program; such
   a file must not be replaced. */
bool view_rows_read(ViewRows *rows, const char *path, FILE *warnings, Error *error);

/* Adds a row, replacing the row with the same key; if there is no room, the oldest row. */
void view_rows_add(ViewRows *rows, const ViewRow *row);

/* Writes all rows; the file is complete or not written at all. */
bool view_rows_write(const ViewRows *rows, const char *path, Error *error);

/* Returns the row with the key, or NULL. */
const ViewRow *view_rows_find(const ViewRows *rows, uint64_t key);

/* view_on_front: true if no other picture of the view is both cheaper and more accurate; errors within the
   factor VIEW_EQUAL count as equal. */
#define VIEW_EQUAL 1.01
bool view_on_front(const ViewRows *rows, int row);

typedef struct ViewWords {
    const char *title, *note, *renderer;
} ViewWords;

/* Draws the chart as FILE.svg or FILE.png: error over time, one colour per view. */
bool view_rows_draw(const ViewRows *rows, const ViewWords *words, const char *path, Error *error);

/* Prints one line per row. */
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
