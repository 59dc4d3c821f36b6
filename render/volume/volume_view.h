/* View "volume": the fluid's field on a grid of voxels. After: SPH coupled with volume rendering, SIBGRAPI
 * 2010. */
#ifndef SLOSH_VOLUME_VIEW_H
#define SLOSH_VOLUME_VIEW_H

#include "render/frame/view.h"

extern const ViewKind view_volume;

#endif
