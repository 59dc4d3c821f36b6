/* Surface tension, for scenes with a model: three models, each a separate sum over pairs. */
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

/* Factor g in the force -g V_i V_j C(r) (x_ij / r) for a tension of 1 N/m at a flat surface. The tension is
   half the work per area to part the lattice at rest along a lattice plane. */
double cohesion_scale(int dimensions, double spacing, double h);

/* Pressure, Pa, by which cohesion presses a fluid of the def together: some 5 sigma / spacing, measured on
   drops of 552 particles at compressions of 0.4 to 6 %. */
double cohesion_pressure(const WorldDef *def, int fluid);

/* For the model `curvature`, with the normals N = sum (1 - r/h)^3 x_ij of a fluid. The part of a surface per
   particle follows from |N| over the |N| of the lattice's outermost layer. */
typedef struct CurvatureScale {
    float full;   /* 1 over |N| of the outermost layer, 1/m */
    float layers; /* sum of curvature_weight over the lattice's layers */
    float few;    /* least sum of (1 - r/h)^3 t^2, t along the surface, for a curvature, m2 */
    float crowd;  /* 1 over sum (1 - r/h)^3 t^2 at the surface of a fluid in motion, 1/m2 */
    float offset; /* apparent loss of a drop's radius, over (d - 1), m: see curvature_calibrate */
    float most;   /* greatest curvature, 1/m: of a drop of some spacings */
} CurvatureScale;

enum {
    CURVATURE_LEAST = 10,
    CURVATURE_WHOLE = 40
}; /* percent of |N|: below, no surface; above, a whole
      surface */

/* The force of a particle is divided by x^(3/8), x the crowd along the surface: sum (1 - r/h)^3 t^2 over the
   sum at the surface of a fluid in motion. New particles come up into a stretched surface only later. Without
   the division a stretched surface would pull less than a shrinking surface, and the flow would gain energy.
   Sparser surfaces count as having the least crowd. */
#define CROWD_LEAST 0.2F

/* x t^2 (3 - 2 t), t from 0 at x = 0.1 to 1 at 0.4: disorder within the fluid is no surface. */
double curvature_weight(double x);

/* Pressure ends where the force begins, and pairs across a surface are missing. So SPH feels pressure as if a
   drop were smaller by (d - 1) times the offset: by (centroid of the weights) + (d - 1) (half the kernel's
   mean |z|). With the offset a drop at rest has the right pressure; an oscillation wants half of the
   offset. */
CurvatureScale curvature_calibrate(int dimensions, double spacing, double h);

/* Factor f, 1/m, of a wall with contact angle `angle`, degrees: a surface at distance d from the wall loses
   the curvature f (1 - d/h)^2. Over the lattice's layers the wall pulls with sigma cos(angle) in all, after
   Young. */
double wetting_curvature(double angle, double spacing, double h);

/* poly6's factor in the colour field's gradient and Laplacian (Müller 2003, eq. 15 to 19): 945 / (32 pi h^9),
   in two dimensions 24 / (pi h^8). */
double colour_scale(int dimensions, double h);

#endif
