/* The points of a PLY file, with numbers as properties. */
#include "app/files/foreign/foreign.h"
#include "app/scene/import/import.h"

static bool take_rows(Ply *ply, ForeignTable *table)
{
    double value[PLY_PROPERTIES_MAX];
    for (size_t i = 0; i < table->count; i++) {
        if (!ply_row(ply, value))
            return false;
        for (int k = 0; k < ply->properties; k++)
            if (table->column[k].value)
                table->column[k].value[i] = value[k];
    }
    return true;
}

static bool parse(const ForeignBytes *file, ForeignTable *table, Error *error)
{
    Ply ply;
    if (!ply_begin(&ply, file->path, file->bytes, file->size, error))
        return false;
    table->time = ply.time;
    table->count = ply.count;
    if (table->head_only)
        return true;
    for (int k = 0; k < ply.properties; k++)
        if (!foreign_column_add(table, file->path, ply.name[k], 1, error))
            return false;
    return take_rows(&ply, table);
}

static const char *const endings[] = {".ply", NULL};

const ForeignFormat foreign_ply = {.name = "PLY", .endings = endings, .parse = parse};
