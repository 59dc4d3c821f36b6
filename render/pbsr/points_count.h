/* Counts the points of a picture of the view pbsr, for measurements. */
#ifndef SLOSH_POINTS_COUNT_H
#define SLOSH_POINTS_COUNT_H

#include "render/frame/frame.h"
#include "render/pbsr/fluid_walk.h"
#include "render/pbsr/solid_layers.h"

/* Counts into frame->counts: the pixels covered by one set, and as fragments of STAGE_BLEND the points of
   `sets` sets. For counting, the CPU projects one set, even if the GPU projects the picture: both differ
   only by chance. Returns false, with nothing counted, if memory is short. */
bool points_count(const FluidLayers *layers, const FluidWalk walks[], const StillLayer still[],
                  const SolidLayers *solids, const SetSight *sight, int sets, const Frame *frame);

#endif
