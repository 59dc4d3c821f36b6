/* Fuzz target of particles in files of other programs: the first byte chooses the format. Accepted files have
   as many values as particles, and not more particles than the bytes can hold; refused ones have a reason
   with the path. */
#include "app/files/foreign/foreign.h"

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

/* Touches all values, for the sanitizers. */
static void check_table(const ForeignTable *table, size_t size)
{
    double sum = 0;
    must(table->head_only || table->count <= 1032 * size);
    for (int k = 0; k < table->column_count; k++) {
        const ForeignColumn *column = &table->column[k];
        must(column->components > 0 && column->role < (int)FOREIGN_OTHERS_END);
        for (size_t i = 0; column->value && !table->head_only && i < table->count; i++)
            sum += column->value[i * (size_t)column->components + (size_t)column->components - 1];
    }
    must(sum <= 0 || sum >= 0 || isnan(sum));
}

static void check_index(const ForeignBytes *file)
{
    ForeignSeries series = {0};
    Error error = {""};
    if (foreign_pvd_parse(file, &series, &error))
        must(series.count > 0);
    else
        must(error.message[0]);
    foreign_series_free(&series);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const ForeignFormat *const formats[] = {&foreign_csv, &foreign_ply, &foreign_vtk_xml,
                                                   &foreign_vtk_legacy};
    if (size < 2)
        return 0;
    const int which = (data[0] >> 1) % 5;
    const ForeignBytes file = {.path = "fuzz", .bytes = (const char *)data + 1, .size = size - 1};
    ForeignTable table = {.roles = FOREIGN_ALL, .head_only = data[0] & 1};
    Error error = {""};
    if (which == 4)
        check_index(&file);
    else if (formats[which]->parse(&file, &table, &error))
        check_table(&table, size);
    else
        must(strncmp(error.message, "fuzz:", strlen("fuzz:")) == 0);
    foreign_table_free(&table);
    return 0;
}
