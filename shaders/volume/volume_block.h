/* The grid of a volume, and particle constants in units of cells; filled by render/views/volume/voxelizer.c.
 */
#ifndef SLOSH_VOLUME_BLOCK_H
#define SLOSH_VOLUME_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/volume/volume_bindings.h"

UNIFORM_BLOCK(VolumeBlock, VOLUME_BLOCK)
{
    vec3 volume_corner; /* m */
    float cells_per_m;
    vec3 volume_low;     /* bounds of the particles that count, m */
    float kernel_radius; /* cells */
    vec3 volume_high;
    float radius2_inverse; /* 1 / kernel_radius^2 */
    ivec3 volume_size;     /* cells */
    uint particle_count;
    ivec3 list_size;   /* cells of the lists */
    float list_scale;  /* list cells per grid cell */
    float kernel_peak; /* W(0), 1/m3 */
}
BLOCK_END(VolumeBlock);

#endif
