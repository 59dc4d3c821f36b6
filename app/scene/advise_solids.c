/* Warns of solids that fluid may cross within a step, and of overlaps. */
#include "app/scene/advise_parts.h"
#include "app/scene/check.h"
#include "sim/body/bodies.h"
#include "sim/matter/fill.h"
#include "sim/matter/viscosity.h"

#include <math.h>

/* Greatest speed of the box's corners by the scene's shake, rock and spin motions, m/s. */
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

/* Warns of parts left out of the force on a solid: sim/matter/forces.h. */
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

/* Warns of an overlap at the start. Not for hinged solids: their overlap stays, and is mostly intended, like
   an axle in its bearing. */
static void advise_overlap(const Tree *tree, const SolidDef *solid, int k, const BodyOverlap *overlap,
                           Notes *notes)
{
    char path[64], other[32] = "a wall of the box";
    snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(solid->kind));
    if (overlap->other != BODY_AT_WALL)
        snprintf(other, sizeof other, "solids[%d]", overlap->other);
    if (!overlap->fits)
        advise(tree, path, notes, "the solid does not fit into the box: it sticks out by %.3g m",
               overlap->depth);
    else
        advise(tree, path, notes,
               "the solid starts %.3g m deep in %s, and is moved out of it in the first step", overlap->depth,
               other);
}

/* For a floating solid without a hinge, which the first step moves. */
static bool starts_in_another(const WorldDef *def, const Bodies *bodies, int k, BodyOverlap *overlap)
{
    const double *axis = def->solids[k].hinge_axis;
    return axis[0] == 0 && axis[1] == 0 && axis[2] == 0 && bodies_overlap(bodies, k, overlap);
}

static void advise_overlaps(const Tree *tree, const WorldDef *def, Notes *notes)
{
    Walls walls;
    Bodies *bodies;
    Error none;
    walls_place(&walls, def->dimensions, def->box_size, def->periodic, def->spacing);
    if (!bodies_create(&bodies, &(BodiesIn){.def = def, .walls = &walls}, &none) || !bodies)
        return;
    for (int k = 0; k < def->solid_count; k++) {
        BodyOverlap overlap, its;
        if (!starts_in_another(def, bodies, k, &overlap))
            continue;
        if (overlap.other > k && starts_in_another(def, bodies, overlap.other, &its) && its.other == k)
            continue; /* the other solid reports */
        advise_overlap(tree, &def->solids[k], k, &overlap, notes);
    }
    bodies_destroy(bodies);
}

static void advise_emitters(const Tree *tree, const WorldDef *def, Notes *notes)
{
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            for (int k = 0; k < def->drain_count; k++)
                if (fill_holds(&def->drains[k], def->dimensions, def->fluids[f].emits[i].centre, 0)) {
                    char path[64];
                    snprintf(path, sizeof path, "fluids[%d].emit[%d]", f, i);
                    advise(tree, path, notes,
                           "the emitter stands in drains[%d], which takes its fluid at once", k);
                }
}

/* A solid acts only on particles inside at the end of a step, so fluid carried across a thin solid within a
   step is missed. The box's walls hold all fluid, since every place beyond a wall is outside. */
void advise_solids(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *def = &scene->world;
    const double step = def->dt / def->substeps, way = step * greatest_shaking(def);
    advise_floating(tree, def, notes);
    advise_overlaps(tree, def, notes);
    advise_emitters(tree, def, notes);
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
