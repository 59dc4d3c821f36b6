#include "sim/matter/world_def.h"

double fluid_viscosity_at(const FluidDef *fluid, double time)
{
    return fluid->viscosity_table.rows > 0 ? time_table_at(&fluid->viscosity_table, time) : fluid->viscosity;
}

double fluid_viscosity_most(const FluidDef *fluid)
{
    return fluid->viscosity_table.rows > 0 ? time_table_most(&fluid->viscosity_table) : fluid->viscosity;
}

double fluid_viscosity_least(const FluidDef *fluid)
{
    return fluid->viscosity_table.rows > 0 ? time_table_least(&fluid->viscosity_table) : fluid->viscosity;
}

WorldDef world_def_most_viscous(const WorldDef *def)
{
    WorldDef most = *def;
    for (int f = 0; f < def->fluid_count; f++)
        most.fluids[f].viscosity = fluid_viscosity_most(&def->fluids[f]);
    return most;
}

void world_def_at(WorldDef *def, double time)
{
    for (int f = 0; f < def->fluid_count; f++)
        def->fluids[f].viscosity = fluid_viscosity_at(&def->fluids[f], time);
}
