/* One slice of a volume, as a picture for looking into it. */
#ifndef SLOSH_VOLUME_SLICE_H
#define SLOSH_VOLUME_SLICE_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/volume/volume.h"

typedef struct VolumeSlice {
    unsigned program, vertex_array;
    ColorTable colors;
} VolumeSlice;

/* For volumes of that voxelizer. False when a shader does not compile or the def's colormap is unknown;
   volume_slice_destroy is needed in either case. */
bool volume_slice_create(VolumeSlice *slice, const ViewDef *def, const Voxelizer *voxelizer, Error *error);
void volume_slice_destroy(VolumeSlice *slice);

/* Draws the slice that the def names into frame->target, colour and depth. The volume is bound. */
void volume_slice_draw(VolumeSlice *slice, const double box_size[3], const Frame *frame);

#endif
