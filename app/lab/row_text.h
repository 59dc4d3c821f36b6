/* Cells of the tables that keep runs (CSV). */
#ifndef SLOSH_ROW_TEXT_H
#define SLOSH_ROW_TEXT_H

#include "app/outcome/outcome.h"

#include <stdio.h>

/* The cell's number, all of it; false without one. */
bool row_number(const char *cell, double *number);

/* A text and the comma behind it. */
void row_put_text(const char *text, FILE *file);

/* What row_put_text wrote; false where it is too long. */
bool row_text(char *text, size_t size, const char *cell);

/* Of three cells: kind, time, words. */
bool row_outcome(char *const cells[3], Outcome *outcome);

/* Writes a table, whole or not at all; `print` returns false without memory. */
bool rows_write(const char *path, bool (*print)(const void *rows, FILE *file), const void *rows,
                Error *error);

#endif
