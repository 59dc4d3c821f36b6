/* Quantities over places: linear between the places of a grid, whose planes need not be evenly spaced, and
   constant beyond its edges. */
#ifndef SLOSH_FIELD_TABLE_H
#define SLOSH_FIELD_TABLE_H

enum { FIELD_TABLE_COLUMNS = 3 };

/* Whoever made it owns the arrays. */
typedef struct FieldTable {
    int count[3];     /* of the planes across x, y, z; 1: nothing depends on that coordinate */
    double *place[3]; /* count[k] each, where the planes stand, ascending, m; of one plane not read */
    double *value[FIELD_TABLE_COLUMNS]; /* of a quantity at all places, x fastest, z slowest; NULL: none */
} FieldTable;

/* The quantity `column`, which must be there, at x (m). */
double field_table_at(const FieldTable *table, int column, const double x[3]);

#endif
