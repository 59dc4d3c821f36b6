#include "sim/world/column.h"
#include "sim/world/constants.h"
#include "sim/world/method.h"

static bool tense(const Constants *constants)
{
    return constants->tension_model != TENSION_NONE;
}

#define AT(member) .at = offsetof(ParticleColumns, member)
#define KEPT       .flags = COLUMN_SAVED | COLUMN_SORTED

const ColumnDef columns_common[] = {
    {"position", "m", AT(x), 3, COLUMN_FLOAT, KEPT},
    {"velocity", "m/s", AT(vx), 3, COLUMN_FLOAT, KEPT},
    {"id", "", AT(id), 1, COLUMN_INDEX, KEPT},
    {"fluid", "", AT(fluid), 1, COLUMN_BYTE, KEPT},
    {"volume", "", AT(volume), 1, COLUMN_FLOAT},
    {"pressure", "Pa", AT(pressure), 1, COLUMN_FLOAT},
    {"pressure_term", "Pa", AT(pressure_term), 1, COLUMN_FLOAT},
    {"acceleration", "m/s2", AT(ax), 3, COLUMN_FLOAT},
    {"tension", "N/m", AT(tension), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = tense},
    {"kind", "", AT(kind), 1, COLUMN_FLOAT, .needed = tense},
    {0},
};

static bool wide(const Constants *constants)
{
    return constants->wide;
}

const ColumnDef columns_left[] = {
    {"remainder", "m", .at = COLUMN_OWN(COLUMNS_LEFT), 3, COLUMN_FLOAT, KEPT, .needed = wide},
    {0},
};

bool columns_wide(const WorldDef *def)
{
    double widest = 0;
    for (int k = 0; k < def->dimensions; k++)
        widest = def->box_size[k] > widest ? def->box_size[k] : widest;
    return widest > COLUMNS_WIDE * def->spacing;
}

static void add_rows(ColumnRows *rows, const ColumnDef *from, unsigned flags,
                     const struct Constants *constants)
{
    for (; from && from->name && rows->count < COLUMNS_MAX; from++)
        if ((from->flags & flags) == flags && (!constants || !from->needed || from->needed(constants)))
            rows->row[rows->count++] = from;
}

ColumnRows columns_saved(const WorldDef *def)
{
    ColumnRows rows = {0};
    add_rows(&rows, columns_common, COLUMN_SAVED, NULL);
    if (columns_wide(def))
        add_rows(&rows, columns_left, COLUMN_SAVED, NULL);
    add_rows(&rows, method_find(def->method)->columns, COLUMN_SAVED, NULL);
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->named(def))
            add_rows(&rows, (*term)->columns, COLUMN_SAVED, NULL);
    return rows;
}

uint32_t columns_scalars(const WorldDef *def)
{
    const ColumnRows saved = columns_saved(def);
    uint32_t scalars = 0;
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (s < SCALAR_OWN || columns_place(&saved, (Scalar)s) >= 0)
            scalars |= UINT32_C(1) << s;
    return scalars;
}

ColumnRows column_rows(const ColumnDef *own, unsigned flags, const struct Constants *constants)
{
    ColumnRows rows = {0};
    add_rows(&rows, columns_common, flags, constants);
    add_rows(&rows, columns_left, flags, constants);
    add_rows(&rows, own, flags, constants);
    for (const Term *const *term = shared_terms; *term; term++)
        add_rows(&rows, (*term)->columns, flags, constants);
    return rows;
}
