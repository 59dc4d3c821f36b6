/* Cells of CSV tables of runs. */
#ifndef APP_LAB_RUN_TABLE_H
#define APP_LAB_RUN_TABLE_H

#include "app/run/measure/outcome.h"
#include "app/scene/scene.h"
#include "sim/base/sums.h"

#include <stdint.h>
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

/* Hash of all inputs of a run; tables of runs use the hash to recognise finished runs. */

/* Initial value. */
#define RUN_KEY HASH_NONE

/* Adds a text to `key`. */
uint64_t run_key_text(uint64_t key, const char *text);

/* Adds the build of the program, all resolved settings of the scene (view settings only with `looks`), and
   the contents of its tables. Returns false, with a useless key, if memory is short or the program has no
   build id. */
bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error);

#endif
