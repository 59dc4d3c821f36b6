/* How many points the pictures of the view pbsr are made of, for those who measure. */
#ifndef SLOSH_POINTS_COUNT_H
#define SLOSH_POINTS_COUNT_H

#include "render/frame/frame.h"
#include "render/pbsr/fluid_walk.h"
#include "render/pbsr/solid_layers.h"

/* Fills in frame->counts: the pixels that one set covers, and as fragments of STAGE_BLEND the points of
   `sets` such sets. One set is projected by the CPU for that, whoever projects those of pictures: theirs
   differ by chance alone. False, with nothing counted, when memory is short. */
bool points_count(const FluidLayers *layers, const FluidWalk walks[], const StillLayer still[],
                  const SolidLayers *solids, const SetSight *sight, int sets, const Frame *frame);

#endif
