/* Solids that fluid may be on the other side of within a step. */
#include "app/scene/advise_parts.h"
#include "app/scene/check.h"
#include "sim/matter/viscosity.h"

#include <math.h>

/* How fast the scene's motions shake, rock and spin the box at most, at its corners, m/s. */
static double greatest_shaking(const WorldDef *def)
{
    const double *size = def->box_size,
                 reach = 0.5 * sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    double sum = 0;
    for (const Motion *m = def->motions; m < def->motions + def->motion_count; m++)
        sum += m->kind == MOTION_SHAKE  ? 2 * M_PI * m->frequency * m->amplitude
               : m->kind == MOTION_ROCK ? 2 * M_PI * m->frequency * fabs(m->angle_deg) * M_PI / 180 * reach
               : m->kind == MOTION_SPIN ? fabs(m->rate) * reach
                                        : 0;
    return sum;
}

/* What the force on a solid leaves out: sim/matter/forces.h. */
static void advise_floating(const Tree *tree, const WorldDef *def, Notes *notes)
{
    for (int k = 0; k < def->solid_count; k++) {
        char path[64];
        snprintf(path, sizeof path, "solids[%d].density", k);
        if (solid_floats(&def->solids[k]) && def->viscosity_solver == VISCOSITY_IMPLICIT)
            advise(
                tree, path, notes,
                "solver.viscosity: implicit holds fluid to a solid, but no solid to the fluid: this one feels "
                "pressure alone; use explicit for friction");
    }
}

/* A solid holds what it finds within itself at the end of a step; what a step has carried over it, it does
   not see. The box's walls are the end of the world, and hold whatever comes. */
void advise_solids(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *def = &scene->world;
    const double step = def->dt / def->substeps, way = step * greatest_shaking(def);
    advise_floating(tree, def, notes);
    for (int k = 0; k < def->solid_count && def->step_mode == STEP_FIXED; k++) {
        const double width = scene_solid_width(&def->solids[k], def->dimensions);
        char path[64];
        snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(def->solids[k].kind));
        if (way > width)
            advise(
                tree, path, notes,
                "the box moves up to %.3g m in a step, and the solid is %.3g m thin: fluid may cross it; use "
                "steps of %.2g ms or less, or a thicker solid",
                way, width, 1e3 * step * width / way);
    }
}
