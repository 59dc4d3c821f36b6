/* Surface tension, for scenes that name it: two models, each a sum over pairs of its own. */
#ifndef SLOSH_TENSION_H
#define SLOSH_TENSION_H

#include "sim/matter/world_def.h"

typedef enum TensionModel {
    TENSION_NONE,
    TENSION_COLOUR_FIELD,
    TENSION_COHESION,
    TENSION_CURVATURE
} TensionModel;

typedef struct TensionKind {
    const char *name, *help;
} TensionKind;

extern const TensionKind tension_kinds[]; /* in the order of TensionModel, ended by a NULL name */

/* Akinci, Akinci, Teschner 2013, eq. 2, without its factor 32 / (pi h^9): positive attracts; zero for
   r >= h. m6 for r and h in m. */
double cohesion_kernel(double r, double h);

/* The factor g in the force -g V_i V_j C(r) (x_ij / r) that makes the tension of a flat surface 1 N/m: half
   the work, an area, that it takes to part the lattice at rest along a plane of it. */
double cohesion_scale(int dimensions, double spacing, double h);

/* What the model `curvature` makes of the normals N = sum (1 - r/h)^3 x_ij of a fluid: how much of a surface
   a particle stands for, by |N| over that of the lattice's outermost layer. */
typedef struct CurvatureScale {
    float full;   /* 1 over |N| of that layer, 1/m */
    float layers; /* sum of curvature_weight over the lattice's layers */
    float few;    /* sum of (1 - r/h)^3 t^2, t along the surface, below which a curvature is none, m2 */
    float crowd;  /* 1 over sum (1 - r/h)^3 t^2 at the surface of a fluid in motion, 1/m2 */
    float offset; /* by how much less it is than sum over all directions, m: see curvature_calibrate */
    float most;   /* greatest curvature, 1/m: that of a drop of some spacings */
} CurvatureScale;

enum { CURVATURE_LEAST = 10, CURVATURE_WHOLE = 40 }; /* percent of |N|: no surface; a surface */

/* The force of a particle is divided by x^(3/8), x the crowd along the surface: sum (1 - r/h)^3 t^2 over the
   sum at the surface of a fluid in motion. New particles come up into a stretched surface only later. Without
   the division a stretched surface would pull less than a shrinking one, and the flow would gain energy.
   Sparser surfaces than the least crowd count as that crowd. */
#define CROWD_LEAST 0.2F

/* x t^2 (3 - 2 t), t from 0 at x = 0.1 to 1 at 0.4: what is unordered within the fluid is no surface. */
double curvature_weight(double x);

/* Pressure ends where the force begins, and pairs across a surface are missing: SPH feels pressure as if a
   drop were smaller by (centroid of the weights) + (d - 1) (half the kernel's mean |z|), which is (d - 1)
   times the offset. A drop at rest has the right pressure with it; a swing wants half of it. */
CurvatureScale curvature_calibrate(int dimensions, double spacing, double h);

/* A wall that fluid meets at that angle, degrees, lessens the curvature of a surface d away by this times
   (1 - d/h)^2, 1/m: over the lattice's layers it pulls with sigma cos(angle) in all, after Young. */
double wetting_curvature(double angle, double spacing, double h);

/* poly6's factor in the colour field's gradient and Laplacian (Müller 2003, eq. 15 to 19): 945 / (32 pi h^9),
   in two dimensions 24 / (pi h^8). */
double colour_scale(int dimensions, double h);

#endif
