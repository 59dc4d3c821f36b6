#include "sim/world/backend.h"
#include "sim/world/method.h"
#include "sim/world/world.h"

#include <stdio.h>

WorldDef world_def_default(void)
{
    WorldDef def = {
        .dimensions = 3,
        .gravity = {0, -9.81, 0},
        .support = 2.1, /* 32 neighbours in the lattice; at exactly 2, neighbours at distance h come and go */
        .backend = "cpu",
        .sound_speed = 20, /* ten times the speed after a fall of 0.2 m: density within 1 % in a scene of a
                              hand's size */
        .viscosity_tolerance = 0.001, /* a thousandth of the forces that drive a flow: below the lattice
                                         error */
        .viscosity_iterations = 200,
        .dt = 0.01, /* a frame of 100 Hz */
        .limits = box_limits_default(),
        .substeps = 10,    /* paper 003's stable setting at 8,192 particles */
        .cfl_number = 0.3, /* three quarters of the stable number of the first method at support 2.1 */
        .max_dt = 0.01,
        .most = 100000, /* some 60 MB, and a frame in a tenth of a second */
        .retries = 3,   /* to an eighth of the step: remaining trouble does not depend on the step */
    };
    snprintf(def.method, sizeof def.method, "%s", method_list()[0]->name);
    methods_default(&def);
    backends_default(&def);
    return def;
}
