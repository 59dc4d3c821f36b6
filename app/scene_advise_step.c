/* Whether the step fits what a scene asks for: friction and sound, by sim/step_control.h. */
#include "app/scene_advise_parts.h"
#include "sim/step_control.h"

#include <math.h>
#include <string.h>

/* The def with each viscosity the greatest that its table has. */
static WorldDef most_viscous(const WorldDef *def)
{
    WorldDef most = *def;
    for (int f = 0; f < def->fluid_count; f++)
        most.fluids[f].viscosity = fluid_viscosity_most(&def->fluids[f]);
    return most;
}

/* What binds the step by friction, as a key and its value. */
static void name_friction(const WorldDef *most, const StepFriction *friction, char name[64])
{
    const StepFriction laminar = {.laminar = friction->laminar};
    int thickest = 0;
    for (int f = 1; f < most->fluid_count; f++)
        thickest = most->fluids[f].viscosity > most->fluids[thickest].viscosity ? f : thickest;
    if (step_viscous(most, &laminar) > step_viscous(most, friction))
        snprintf(name, 64, "solver.artificial_viscosity %g", most->artificial_viscosity);
    else
        snprintf(name, 64, "fluids[%d].viscosity %g Pa s", thickest, most->fluids[thickest].viscosity);
}

void advise_friction(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef def = most_viscous(&scene->world);
    const StepFriction friction = step_friction(&def);
    const double step = def.dt / def.substeps, stands = STEP_VISCOUS_STANDS * step_viscous(&def, &friction);
    char what[64];
    if (def.step_mode != STEP_FIXED || step <= stands)
        return;
    name_friction(&def, &friction, what);
    advise(
        tree, "solver.step.dt", notes,
        "the step of %.3g ms is too long for %s: from %.3g ms on friction makes fluid boil instead of calming "
        "it; use %g substeps or more, or a lower viscosity",
        1e3 * step, what, 1e3 * stands, ceil(def.dt / stands * (1 - 1e-9)));
}
