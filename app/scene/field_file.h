/* A table of a quantity over places, as a CSV file. Lines beginning with '#' and empty lines are skipped. The
   first line names the columns, in any order, each with an optional unit in parentheses. Each further line is
   a place of a grid and its values, in any order:

     x (m), z (m), height (m)
     -0.5, 0, 0.21
     ... */
#ifndef SLOSH_FIELD_FILE_H
#define SLOSH_FIELD_FILE_H

#include "sim/base/error.h"
#include "sim/base/field_table.h"

#include <stddef.h>

enum { FIELD_FILE_BYTES_MAX = 64 << 20 };

/* Columns of a kind of table: coordinates among "xyz", and quantities, of which at least one is required. */
typedef struct FieldFileKind {
    const char *axes;
    const char *quantity[FIELD_TABLE_COLUMNS], *unit;
    const char *words; /* "x, z and height", for messages */
} FieldFileKind;

extern const FieldFileKind field_file_heights, field_file_velocities;

/* Parses the bytes of a file; pure. Returns NULL with "path:line: the fault; the remedy". */
FieldTable *field_file_parse(const char *path, const char *bytes, size_t size, const FieldFileKind *kind,
                             Error *error);
void field_file_free(FieldTable *table); /* NULL is allowed */

#endif
