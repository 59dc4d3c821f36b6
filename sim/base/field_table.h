/* Quantities over positions: linear between the points of a grid with arbitrary plane spacing, constant
   outside of the grid. */
#ifndef SLOSH_FIELD_TABLE_H
#define SLOSH_FIELD_TABLE_H

enum { FIELD_TABLE_COLUMNS = 3 };

/* The creator owns the arrays. */
typedef struct FieldTable {
    int count[3];     /* planes across x, y, z; 1: independent of the coordinate */
    double *place[3]; /* count[k] positions of planes, ascending, m; not read for a single plane */
    double *value[FIELD_TABLE_COLUMNS]; /* values at all points, x fastest, z slowest; NULL: none */
} FieldTable;

/* Value of quantity `column`, which must exist, at x (m). */
double field_table_at(const FieldTable *table, int column, const double x[3]);

#endif
