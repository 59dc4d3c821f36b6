/* Published figures from a CSV file of scenes/reference: lines starting with '#' (the citation), a line of
   column names, rows. */
#ifndef SLOSH_REFERENCE_H
#define SLOSH_REFERENCE_H

#include "sim/base/error.h"

#include <stdbool.h>

enum { REFERENCE_COLUMNS = 8, REFERENCE_ROWS = 256, REFERENCE_CELL = 32, REFERENCE_NOTES = 512 };

typedef struct Reference {
    char path[1024];
    char notes[REFERENCE_NOTES]; /* the lines starting with '#', without the '#' */
    int columns, rows;
    char column[REFERENCE_COLUMNS][REFERENCE_CELL];
    char cell[REFERENCE_ROWS][REFERENCE_COLUMNS][REFERENCE_CELL];
} Reference;

/* Loads a reference; `name` as in scene_path_find. Returns false with "file:line: ...". */
bool reference_load(const char *name, Reference *reference, Error *error);

/* Returns a cell as text, "" if there is no such column; as a number, NaN if not a number. */
const char *reference_text(const Reference *reference, int row, const char *column);
double reference_number(const Reference *reference, int row, const char *column);

#endif
