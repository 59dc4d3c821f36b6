#include "sim/wcsph/columns.h"

#include "sim/world/constants.h"

static bool viscous(const Constants *constants)
{
    return constants->viscous;
}

static bool artificial(const Constants *constants)
{
    return constants->artificial;
}

static bool diffuses(const Constants *constants)
{
    return constants->diffusion > 0;
}

static bool shifts(const Constants *constants)
{
    return constants->shifting > 0;
}

#define OWN(k)     .at = COLUMN_OWN(k)
#define AT(member) .at = offsetof(ParticleColumns, member)

const ColumnDef wcsph_columns[] = {
    {"compression", "", AT(compression), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"viscosity", "Pa s", AT(viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = viscous},
    {"artificial", "Pa s", OWN(ARTIFICIAL), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = artificial},
    {"relative", "", OWN(RELATIVE), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = diffuses},
    {"slope", "1/m", OWN(SLOPE), 3, COLUMN_FLOAT, .needed = diffuses},
    {"kind", "", AT(kind), 1, COLUMN_FLOAT, .needed = diffuses},
    {"uneven", "1/m4", OWN(UNEVEN), 3, COLUMN_FLOAT, .needed = shifts},
    {"full", "1/m3", OWN(FULL), 1, COLUMN_FLOAT, .needed = shifts},
    {"dense", "1/m3", OWN(DENSE), 1, COLUMN_FLOAT, .needed = shifts},
    {0},
};
