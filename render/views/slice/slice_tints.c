#include "render/particles/particles.h"
#include "render/views/slice/slice_private.h"

bool slice_tints_shown(const ParticleBuffers *particles, const Frame *frame)
{
    return view_color_by(frame->def) == SCALAR_FLUID && frame->world->fluid_count > 1 &&
           particles->fluid.buffer != 0;
}

bool slice_tints_run(SliceTints *tints, PlaneSum *red, const PlaneJob *job, const ParticleBuffers *particles,
                     const WorldDef *world, Error *error)
{
    PlaneSum *const sums[FLUID_PARTS] = {red, &tints->green, &tints->blue};
    if (!tints->numbers.program && !fluid_numbers_create(&tints->numbers, error))
        return false;
    for (int part = 0; part < FLUID_PARTS; part++) {
        float of_fluid[FLUIDS_MAX] = {0};
        for (int f = 0; f < world->fluid_count; f++)
            of_fluid[f] = world->fluids[f].color[part];
        const ParticleBuffers tinted = fluid_numbers_add(&tints->numbers, part, of_fluid, particles);
        if (!plane_sum_run(sums[part], job, &tinted, error))
            return false;
    }
    return true;
}

void slice_tints_destroy(SliceTints *tints)
{
    fluid_numbers_destroy(&tints->numbers);
    plane_sum_destroy(&tints->green);
    plane_sum_destroy(&tints->blue);
}
