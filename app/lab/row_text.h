/* Cells of CSV tables of runs. */
#ifndef SLOSH_ROW_TEXT_H
#define SLOSH_ROW_TEXT_H

#include "app/run/measure/outcome.h"

#include <stdio.h>

/* Parses the whole cell as a number; returns false on failure. */
bool row_number(const char *cell, double *number);

/* Writes a text and a comma after it. */
void row_put_text(const char *text, FILE *file);

/* Reads a text written by row_put_text; returns false if the text is too long. */
bool row_text(char *text, size_t size, const char *cell);

/* Reads an outcome from three cells: kind, time, words. */
bool row_outcome(char *const cells[3], Outcome *outcome);

/* Writes a table; the file is complete or not written at all. `print` returns false if memory is short. */
bool rows_write(const char *path, bool (*print)(const void *rows, FILE *file), const void *rows,
                Error *error);

#endif
