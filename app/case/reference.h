/* Published figures, from a CSV file of scenes/reference: lines of '#' (the citation), a line of column
 * names, rows. */
#ifndef SLOSH_REFERENCE_H
#define SLOSH_REFERENCE_H

#include "sim/base/error.h"

#include <stdbool.h>

enum { REFERENCE_COLUMNS = 8, REFERENCE_ROWS = 256, REFERENCE_CELL = 32, REFERENCE_NOTES = 512 };

typedef struct Reference {
    char path[1024];
    char notes[REFERENCE_NOTES]; /* the lines of '#', without it */
    int columns, rows;
    char column[REFERENCE_COLUMNS][REFERENCE_CELL];
    char cell[REFERENCE_ROWS][REFERENCE_COLUMNS][REFERENCE_CELL];
} Reference;

/* `name` as scene_path_find takes it. False with "file:line: ...". */
bool reference_load(const char *name, Reference *reference, Error *error);

/* The cell as text, "" where there is no such column; as a number, NaN where it is none. */
const char *reference_text(const Reference *reference, int row, const char *column);
double reference_number(const Reference *reference, int row, const char *column);

#endif
