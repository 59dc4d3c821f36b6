/* A CSV file with a table of a quantity over places. Lines that begin with '#' and empty lines do not count.
   The first line names the columns, in any order, with optional units in parentheses. Each further line is a
   place of a grid with the quantity there; the order of lines is free. A semicolon or a tab, instead of the
   first comma of the first line, separates the cells of all lines; numbers may then have a decimal comma.
   Cells may be in quotes.

     x (m), z (m), height (m)
     -0.5, 0, 0.21
     ... */
#ifndef SLOSH_FIELD_FILE_H
#define SLOSH_FIELD_FILE_H

#include "sim/base/error.h"
#include "sim/base/field_table.h"

#include <stddef.h>

enum { FIELD_FILE_BYTES_MAX = 64 << 20 };

/* Columns of a kind of table: coordinates among "xyz", and quantities, at least one of them required. */
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
