/* One slice of a volume as a picture, for inspection. */
#ifndef SLOSH_VOLUME_SLICE_H
#define SLOSH_VOLUME_SLICE_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/volume/volume.h"

typedef struct VolumeSlice {
    unsigned program, vertex_array;
    ColorTable colors;
} VolumeSlice;

/* For volumes of `voxelizer`. Returns false if a shader does not compile or the def's colormap is unknown;
   call volume_slice_destroy in either case. */
bool volume_slice_create(VolumeSlice *slice, const ViewDef *def, const Voxelizer *voxelizer, Error *error);
void volume_slice_destroy(VolumeSlice *slice);

/* Draws the def's slice into frame->target, colour and depth. The volume must be bound. */
void volume_slice_draw(VolumeSlice *slice, const double box_size[3], const Frame *frame);

#endif
