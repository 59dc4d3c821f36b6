/* The fluid's field on a grid of voxels: F(r) = sum_j V_j W_poly6(r - r_j, h) (Müller 2003, eq. 20). In a
   two-dimensional scene V is an area and W the plane's kernel, 4 (h^2 - r^2)^3 / (pi h^8), exact at z = 0.
   F is about 1 inside the fluid, 0.5 at the surface, 0 farther than h from all particles; r is in the
   box's frame.

   Needs a current OpenGL 4.5 core context, except volume_grid_for and volume_grid_crop. */
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
    double support;      /* h of the kernel, m */
    unsigned field;      /* GL_TEXTURE_3D, R32F, linear, 0 outside: F. 0 with method `direct`:
                            shaders/volume/field.glsl sums at the sample */
    unsigned scalar;     /* likewise sum V W scalar; the scalar's mean is this sum divided by F. 0 without a
                            scalar. Separate texture, since most samples need F alone */
    bool walled[3];      /* the box's sides perpendicular to this axis are walls, where the field ends */
    unsigned opacity[2]; /* `field` and `scalar` of a second volume on the same grid, for opacity by another
                            scalar; else 0 */
} Volume;

/* Spacings: smaller cells show no more detail of a field that is smooth over two spacings. */
#define VOLUME_FINEST 0.125

/* The grid that covers the box and h around it: `cells` along the box's longest side, or cells of `cell`
   spacings, but never wider than h (wider cells could miss particles between samples). With `cells_least`,
   a cell is not smaller than VOLUME_FINEST, if at least this many cells remain. Reads only box, spacing
   and h of the particles. Returns false if a side has more than 4096 cells, or the grid more than 2^31. */
bool volume_grid_for(const VolumeDef *def, const ParticleBuffers *particles, VolumeGrid *grid, Error *error);

/* The part of `whole` that contains `low` .. `high` (m) and h around, on the same lattice; sides are
   multiples of 8 cells unless they end with `whole`. One cell if low > high. */
void volume_grid_crop(const VolumeGrid *whole, const double low[3], const double high[3], double support,
                      VolumeGrid *out);

/* Makes volumes by one method; each new volume replaces the last. */
typedef struct Voxelizer Voxelizer;

/* `scalar`: volumes carry a scalar. VOLUME_AUTO takes the fastest method. Returns NULL if the driver lacks
   a needed feature or a shader does not compile. */
Voxelizer *voxelizer_create(VolumeMethod method, bool scalar, Error *error);
void voxelizer_destroy(Voxelizer *voxelizer); /* NULL is allowed */

/* Allocates in advance the resources of runs with `def`: memory of the whole grid, or the shader for the
   fluid's bounds. Thus missing resources are found before a picture is due. Returns false if a resource is
   missing. */
bool voxelizer_prepare(Voxelizer *voxelizer, const VolumeDef *def, const VolumeGrid *whole, Error *error);

/* Makes the volume of the particles. The scalar carried is `carried`, or 0 if the particles lack the
   scalar. The voxelizer owns the textures in `out`, which are valid until the next run. Particles outside
   the whole grid, or with a position or volume that is not finite, are left out. Returns false, with empty
   `out`, if memory is short or a shader does not compile. */
bool voxelizer_run(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *particles,
                   Scalar carried, Volume *out, Error *error);

/* Returns false if the driver or memory has no room for the volume, or the method cannot make the volume. */
bool voxelizer_fits(const Voxelizer *voxelizer, const VolumeGrid *grid, double support, Error *error);

/* Defines that shaders/volume/field.glsl needs for this voxelizer's volumes, in lines; static. */
const char *voxelizer_defines(const Voxelizer *voxelizer);

/* Binds the newest volume for shaders/volume/field.glsl: texture units 8 and 9, uniform block 2, storage 8
   to 10. */
void voxelizer_bind(const Voxelizer *voxelizer);

#endif
