#include "sim/matter/world_def.h"

#include <math.h>

WorldDef world_def_default(void)
{
    return (WorldDef){
        .dimensions = 3,
        .gravity = {0, -9.81, 0},
        .support = 2.1, /* 32 neighbours in the lattice; at exactly 2 the shell at h flickers in and out */
        .method = "mueller",
        .backend = "cpu",
        .sound_speed =
            20, /* ten times the speed of a fall of 0.2 m: density within 1 % in a scene of a hand's size */
        .kernel = "cubic",
        .artificial_viscosity = 0.05, /* calms what the walls' lattice stirs up, half of what breaks waves */
        .density_kernel = "spiky",    /* the paper's poly6 heats the fluid: see sim/README.md */
        .dt = 0.01,                   /* a frame of 100 Hz */
        .limits = box_limits_default(),
        .substeps = 10,    /* paper 003's stable setting at 8,192 particles */
        .cfl_number = 0.3, /* three quarters of what mueller stands at support 2.1 */
        .max_dt = 0.01,
        .most = 100000, /* some 60 MB, and a frame in a tenth of a second */
        .retries = 3,   /* to an eighth of the step: trouble that stays is no matter of the step */
    };
}

double fluid_viscosity_at(const FluidDef *fluid, double time)
{
    return fluid->viscosity_table.rows > 0 ? time_table_at(&fluid->viscosity_table, time) : fluid->viscosity;
}

double fluid_viscosity_most(const FluidDef *fluid)
{
    return fluid->viscosity_table.rows > 0 ? time_table_most(&fluid->viscosity_table) : fluid->viscosity;
}

void world_def_at(WorldDef *def, double time)
{
    for (int f = 0; f < def->fluid_count; f++)
        def->fluids[f].viscosity = fluid_viscosity_at(&def->fluids[f], time);
}
