/* Surfaces given by formulas. Values are positive inside; level 0 is the named surface, and further levels
   surround it. Lengths in m, in the box's frame. */
#ifndef SIM_POINTS_FIELDS_H
#define SIM_POINTS_FIELDS_H

#include "sim/points/points.h"

#include "slosh/error.h"
#include "slosh/mesh.h"

/* radius - |x - centre|. Bounds: 1.1 times the sphere. */
LevelField level_sphere(const double centre[3], double radius);

/* tube minus the distance from a ring about the y axis through `centre`. Bounds: 1.1 times the torus. */
LevelField level_torus(const double centre[3], double ring, double tube);

/* sin X cos Y + sin Y cos Z + sin Z cos X with X = 2 pi x / period: half the space at level 0; -1.5 .. 1.5.
   After: A. Schoen, "Infinite periodic minimal surfaces without self-intersections", 1970, its first
   approximation. */
LevelField level_gyroid(const double low[3], const double high[3], double period);

/* height + amplitude cos(2 pi x / period) cos(2 pi z / period) - y: an open surface. */
LevelField level_wave(const double low[3], const double high[3], double height, double amplitude,
                      double period);

/* (x - point) . normal, with the normal scaled to length 1: a slice, to colour by a second field. */
LevelField level_plane(const double low[3], const double high[3], const double point[3],
                       const double normal[3]);

/* The particles' field itself, summed over the neighbours of each position: F(r) = sum V_j W_poly6(|r -
   r_j|, h), and a carried scalar, sum V s W / sum V W. Equal to field_at of include/slosh/mesh.h, which sums
   over all particles. */

typedef struct SphField SphField; /* the particles, sorted by cell */

/* Copies the particles, without particles whose position, volume or scalar is not finite. Returns NULL if
   none is left, h is not above 0, or memory is short. */
SphField *sph_field_create(const FieldParticles *particles, Error *error);

void sph_field_destroy(SphField *field); /* NULL is allowed */

/* F: about 1 inside, 0.5 at the surface, 0 farther than h from any particle. `from` must outlive the fields.
 */
LevelField level_sph(const SphField *from);

/* The scalar, without a gradient for F below 0.5: walks on its levels stay inside the fluid. */
LevelField level_sph_inside(const SphField *from);

/* The scalar; 0 without a particle within h. The particles must have a scalar. */
LevelField level_sph_scalar(const SphField *from);

/* Values on a grid as a field: volume data, or the fluid's field of include/slosh/mesh.h. */

/* Owned by the caller, with its values; must outlive all fields made of it. */
typedef struct VolumeData {
    int size[3];        /* values, each at least 2 */
    double corner[3];   /* m, the box's frame: position of the first value */
    double spacing[3];  /* m: between values */
    const float *value; /* at i + size[0] (j + size[1] k) */
} VolumeData;

/* Volume data of values at cell centres of a grid. */
VolumeData volume_of_grid(const VolumeGrid *grid, const float *value);

typedef enum VolumeInterpolation {
    VOLUME_TRILINEAR,   /* continuous, with edges between cells */
    VOLUME_CATMULL_ROM, /* once differentiable, through the values. After: E. Catmull, R. Rom, "A class of
                           local interpolating splines", 1974; the outermost values count twice at the border
                         */
    VOLUME_INTERPOLATIONS
} VolumeInterpolation;

/* "trilinear", "catmull_rom"; NULL past the last. */
const char *volume_interpolation_name(VolumeInterpolation interpolation);

/* Makes a field from the first value to the last. Returns false if values are not finite, with their count
   and first position, or if the grid is invalid. */
bool level_volume(const VolumeData *volume, VolumeInterpolation interpolation, LevelField *field,
                  Error *error);

/* Volume data with the range of the values, as handed over by file readers. */

/* Constant; must outlive all readers. */
typedef struct RangedVolume {
    VolumeData volume;
    float low, high; /* least and greatest finite value; both 0: none */
} RangedVolume;

#endif
