/* What a def asks of wcsph, and the columns that it needs. */
#include "sim/methods/wcsph/wcsph_private.h"
#include "sim/step/constants.h"

#include <math.h>

/* A single fluid has a constant viscosity: no column is cheaper. */
static bool differs_in_viscosity(const Constants *constants)
{
    return constants->viscous && constants->fluid_count > 1;
}

bool wcsph_is_artificial(const Constants *constants)
{
    return wcsph_constants(constants)->any_artificial != 0;
}

/* Boundary particles have no artificial viscosity. */
static bool differs_in_artificial(const Constants *constants)
{
    return wcsph_is_artificial(constants) && (constants->fluid_count > 1 || constants->solid_count > 0);
}

bool wcsph_meets_solids(const Constants *constants)
{
    return constants->solid_count > 0;
}

bool wcsph_diffuses(const Constants *constants)
{
    return wcsph_constants(constants)->diffusion > 0;
}

static bool shifts(const Constants *constants)
{
    return wcsph_constants(constants)->shift_speed > 0;
}

bool wcsph_returns(const Constants *constants)
{
    return shifts(constants) || wcsph_diffuses(constants);
}

bool wcsph_curves(const Constants *constants)
{
    return constants->tension_model == TENSION_CURVATURE;
}

bool wcsph_corrects(const Constants *constants)
{
    return wcsph_constants(constants)->corrected_gradient != 0;
}

bool wcsph_carries(const Constants *constants)
{
    return shifts(constants) && wcsph_corrects(constants);
}

bool wcsph_layers(const Constants *constants)
{
    float least = INFINITY, most = 0;
    for (int f = 0; f < constants->fluid_count; f++) {
        least = fminf(least, constants->density[f]);
        most = fmaxf(most, constants->density[f]);
    }
    return most > CONTRAST_LEAST * least;
}

static bool tells_kinds(const Constants *constants)
{
    return wcsph_diffuses(constants) || wcsph_corrects(constants);
}

#define OWN(k)            .at = COLUMN_OWN(k)
#define AT_COLUMN(member) .at = offsetof(ParticleColumns, member)

const ColumnDef wcsph_columns[] = {
    {"compression", "", AT_COLUMN(compression), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"rate", "1/s", OWN(RATE), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED},
    {"boundary_part", "", OWN(BOUNDARY_PART), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED,
     .needed = wcsph_meets_solids},
    {"boundary_rate", "1/s", OWN(BOUNDARY_RATE), 1, COLUMN_FLOAT, .flags = COLUMN_SAVED | COLUMN_SORTED,
     .needed = wcsph_meets_solids},
    {"viscosity", "Pa s", AT_COLUMN(viscosity), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = differs_in_viscosity},
    {"artificial", "Pa s", OWN(ARTIFICIAL), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = differs_in_artificial},
    {"relative", "", OWN(RELATIVE), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = wcsph_diffuses},
    {"slope", "1/m", OWN(SLOPE), 3, COLUMN_FLOAT, .needed = wcsph_diffuses},
    {"kind", "", AT_COLUMN(kind), 1, COLUMN_FLOAT, .needed = tells_kinds},
    {"uneven", "1/m", OWN(UNEVEN), 3, COLUMN_FLOAT, .needed = wcsph_returns},
    {"full", "", OWN(FULL), 1, COLUMN_FLOAT, .needed = wcsph_returns},
    {"dense", "", OWN(DENSE), 1, COLUMN_FLOAT, .needed = wcsph_returns},
    {"outward", "", OWN(OUTWARD), 3, COLUMN_FLOAT, .needed = wcsph_curves},
    {"correction", "", OWN(CORRECTION), 3, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = wcsph_corrects},
    {"correction_mixed", "", OWN(CORRECTION + 3), 3, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = wcsph_corrects},
    {"carried", "1/(m s)", OWN(CARRIED), 3, COLUMN_FLOAT, .needed = wcsph_carries},
    {"rest_density", "kg/m3", OWN(REST_DENSITY), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS,
     .needed = wcsph_layers},
    {"pull", "N", OWN(PULL), 3, COLUMN_FLOAT, .needed = wcsph_curves},
    {"drop", "", OWN(DROP), 1, COLUMN_INDEX, .needed = wcsph_curves},
    {"drop_sum", "", OWN(DROP_SUM), 3, COLUMN_INDEX, .needed = wcsph_curves},
    {"drop_tally", "", OWN(DROP_TALLY), 1, COLUMN_INDEX, .needed = wcsph_curves},
    {0},
};
