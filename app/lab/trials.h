/* Trials of a tool: rows of results, kept in a CSV file by the hash of all inputs, so that no trial is made
   twice. A tool describes its rows by a table of columns. */
#ifndef APP_LAB_TRIALS_H
#define APP_LAB_TRIALS_H

#include "app/run/measure/measure.h"
#include "app/scene/scene.h"
#include "sim/base/base.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum CellKind {
    CELL_TEXT,    /* char[size] */
    CELL_WORD,    /* an enum: one of `words` */
    CELL_INTEGER, /* of 4 or 8 bytes */
    CELL_NUMBER,  /* double */
    CELL_OUTCOME, /* Outcome: three cells, NAME, NAME_s and NAME_words */
    CELL_OWN      /* by `print` and `parse`; the last column */
} CellKind;

enum {
    CELL_EMPTY = 1 /* a text may be empty */,
    CELL_NAN = 2 /* may be NaN */,
    CELL_OPEN = 4 /* not `least` */
};

typedef struct TrialColumn {
    const char *name; /* for messages; NULL after the last */
    CellKind kind;
    size_t offset, size; /* of the member */
    unsigned flags;
    double least, most; /* of numbers; most 0: any finite number */
    int digits;
    const char *const *words; /* ends with NULL */
    void (*print)(const void *row, FILE *file);
    bool (*parse)(char *cell, void *row);
} TrialColumn;

#define CELL(Row, member) .offset = offsetof(Row, member), .size = sizeof((Row *)0)->member

/* The first member of each row is its key, a uint64_t; the key is the first cell, too. */
typedef struct TrialTable {
    const char *who;     /* "a chart": writes the file */
    const char *result;  /* "map": has the name of the file */
    const char *trial;   /* "run" */
    const char *head;    /* first line of the file */
    const char *opening; /* start of the first line, in all versions */
    size_t row_size;
    int most; /* rows; 0: as memory allows */
    const TrialColumn *columns;
    /* True if the row is possible as a whole; or NULL. */
    bool (*possible)(const void *row);
    /* True if a row of another process replaces the own row with the same key; NULL: never. */
    bool (*replaces)(const void *other, const void *own);
    /* Order of two rows in the file, given pointers to pointers to rows; NULL: as added. */
    int (*order)(const void *a, const void *b);
} TrialTable;

/* Initialise `table`, and the rest by zero. */
typedef struct Trials {
    const TrialTable *table;
    int count, capacity;
    uint64_t *keys;
    char *rows; /* count * table->row_size bytes */
} Trials;

void trials_free(Trials *trials);

/* Returns a row; valid until the next row is added. */
static inline void *trials_row(const Trials *trials, int i)
{
    return trials->rows + (size_t)i * trials->table->row_size;
}

/* The row with the key: its place or -1; the row or NULL. */
int trials_place(const Trials *trials, uint64_t key);
void *trials_find(const Trials *trials, uint64_t key);

/* Adds a row at the end, whatever its key. Returns the row; NULL: memory is short. */
void *trials_append(Trials *trials, const void *row);

/* Adds a row, replacing the row with the same key. If there is no room, drops the oldest row that is not in
   `keep` (may be NULL). Returns false without room or memory. */
bool trials_add(Trials *trials, const void *row, const Trials *keep);

/* Reads the sound rows of an older run; no rows if the file is missing or empty. Each unsound row, or a file
   of another version, is reported to `warnings` (may be NULL). Returns false with the reason if the file
   cannot be read or was written by another program; such a file must not be replaced. */
bool trials_read(Trials *trials, const char *path, FILE *warnings, Error *error);

/* Adds the rows written to the file by other processes since the last reading. Returns false as
   trials_read. */
bool trials_merge(Trials *trials, const char *path, const Trials *keep, Error *error);

/* Writes all rows; the file is complete or not written at all. */
bool trials_write(const Trials *trials, const char *path, Error *error);

/* Both: the file then has the rows of all processes. */
bool trials_keep(Trials *trials, const char *path, const Trials *keep, Error *error);

/* Hash of all inputs of a trial. */

/* Initial value. */
#define RUN_KEY HASH_NONE

/* Adds a text to `key`. */
uint64_t run_key_text(uint64_t key, const char *text);

/* Adds the build of the program, all resolved settings of the scene (view settings only with `looks`), and
   the contents of its tables. Returns false, with a useless key, if memory is short or the program has no
   build id. */
bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error);

#endif
