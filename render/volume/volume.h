/* The fluid's field on a grid of voxels: F(r) = sum_j V_j W_poly6(r - r_j, h) (Müller 2003, eq. 20). In a
   scene of two dimensions V is an area and W the plane's, 4 (h^2 - r^2)^3 / (pi h^8), right where z = 0. F is
   about 1 inside the fluid, 0.5 at its surface, 0 farther than h from any particle; a point in space is in
   the box's frame.

   Needs a current OpenGL 4.5 core context, but for volume_grid_for and volume_grid_crop. */
#ifndef SLOSH_VOLUME_H
#define SLOSH_VOLUME_H

#include "render/volume/volume_def.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"
#include "sim/gl/timer.h"
#include "sim/mesh/field.h"

#include <stdbool.h>

typedef struct Volume {
    VolumeGrid grid;
    double support;  /* h of the kernel, m */
    unsigned field;  /* GL_TEXTURE_3D, R32F, linear, 0 outside: F. 0 with method `direct`, where
                        shaders/volume/field.glsl sums at the sample */
    unsigned scalar; /* the same for sum V W scalar, whose mean is this by F; 0 where none is carried. A
                        texture of its own, since most samples need F alone */
    bool walled[3]; /* the box's sides across this axis are walls that the field reaches, and where it ends */
    unsigned
        opacity[2]; /* both of another volume on the same grid, for opacity by a scalar of its own; else 0 */
} Volume;

/* Spacings: smaller cells show nothing more of a field that is smooth over two spacings. */
#define VOLUME_FINEST 0.125

/* The grid that covers the box and h around it: `cells` along the box's longest side or cells of `cell`
   spacings, but never wider than h: a particle reaches no farther, and would fall between the samples. Where
   `cells_least` is set a cell is no smaller than VOLUME_FINEST, as long as there are that many. Reads
   of the particles box, spacing and h only. False when a side has more than 4096 cells or all together more
   than 2^31. */
bool volume_grid_for(const VolumeDef *def, const ParticleBuffers *particles, VolumeGrid *grid, Error *error);

/* The part of `whole` that holds `low` .. `high` (m) and h around it, on the same lattice, its sides
   multiples of 8 cells unless it ends with the whole. One cell where low > high. */
void volume_grid_crop(const VolumeGrid *whole, const double low[3], const double high[3], double support,
                      VolumeGrid *out);

/* Makes volumes by one method; each new volume takes the place of the last. */
typedef struct Voxelizer Voxelizer;

/* With `scalar` volumes carry one. VOLUME_AUTO takes the fastest. NULL when the driver lacks what the method
   needs or a shader does not compile. */
Voxelizer *voxelizer_create(VolumeMethod method, bool scalar, Error *error);
void voxelizer_destroy(Voxelizer *voxelizer); /* NULL is allowed */

/* Takes beforehand what runs for that def need: the memory of the whole grid, or the shader that finds the
   fluid's bounds; so that what is not there is known before a picture is due. False when it is not. */
bool voxelizer_prepare(Voxelizer *voxelizer, const VolumeDef *def, const VolumeGrid *whole, Error *error);

/* Makes the volume of these particles. The scalar carried is `carried`, where it is there, else 0. What `out`
   names belongs to the voxelizer and holds until its next run. Particles outside the whole
   grid, and those whose position or volume is not finite, count for nothing. False when memory is short
   or a shader does not compile: `out` is then empty. */
bool voxelizer_run(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *particles,
                   Scalar carried, Volume *out, Error *error);

/* False when the driver or the memory has no room for such a volume, or the method cannot make it. */
bool voxelizer_fits(const Voxelizer *voxelizer, const VolumeGrid *grid, double support, Error *error);

/* Lines of defines that shaders/volume/field.glsl needs for this voxelizer's volumes; a constant. */
const char *voxelizer_defines(const Voxelizer *voxelizer);

/* Binds the newest volume for shaders/volume/field.glsl: texture units 8 and 9, uniform block 2, storage 8
 * to 10. */
void voxelizer_bind(const Voxelizer *voxelizer);

#endif
