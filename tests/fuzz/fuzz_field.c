/* Fuzz target of tables over places: a parsed table is a full grid, and interpolated values lie between
   grid values. The last byte chooses the kind: heights if a newline. */
#include "app/scene/import/import.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static void check_planes(const FieldTable *table)
{
    for (int k = 0; k < 3; k++) {
        must(table->count[k] >= 1);
        for (int i = 0; i < table->count[k]; i++)
            must(isfinite(table->place[k][i]) && (i == 0 || table->place[k][i] > table->place[k][i - 1]));
    }
}

static bool between(double value, double least, double most)
{
    const double slack = 1e-12 * fmax(fabs(least), fabs(most));
    return value >= least - slack && value <= most + slack; /* not of a NaN */
}

/* On the first and the last place, between them, and beyond. */
static void check_column(const FieldTable *table, int column)
{
    const size_t count = (size_t)table->count[0] * (size_t)table->count[1] * (size_t)table->count[2];
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, table->value[column][i]);
        most = fmax(most, table->value[column][i]);
    }
    must(isfinite(least) && isfinite(most));
    for (int part = -1; part <= 5; part++) {
        double x[3];
        for (int k = 0; k < 3; k++) {
            const double share = 0.25 * part, *place = table->place[k];
            x[k] = (1 - share) * place[0] + share * place[table->count[k] - 1];
        }
        must(between(field_table_at(table, column, x), least, most));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool heights = size > 0 && data[size - 1] == '\n';
    Error error = {""};
    FieldTable *table = field_file_parse("fuzz.csv", (const char *)data, size,
                                         heights ? &field_file_heights : &field_file_velocities, &error);
    if (!table) {
        must(strncmp(error.message, "fuzz.csv:", strlen("fuzz.csv:")) == 0);
        return 0;
    }
    check_planes(table);
    for (int k = 0; k < FIELD_TABLE_COLUMNS; k++)
        if (table->value[k])
            check_column(table, k);
    field_file_free(table);
    return 0;
}
