/* Solids over a step: positions, velocities and accelerations of boundary particles, and the guard against
   fluid inside. */
#ifndef SIM_SOLIDS_SOLID_H
#define SIM_SOLIDS_SOLID_H

#include "slosh/def.h"

/* A pose in single precision: x_box = x + r x_solid; the velocity at x_box is v + w x (x_box - x). */
typedef struct SolidPose {
    float x[3]; /* m */
    float r[3][3];
    float v[3]; /* m/s */
    float w[3]; /* rad/s */
} SolidPose;

/* Motion of one solid from one pose to the next. */
typedef struct SolidStep {
    SolidPose begin, end;
    bool still; /* no motion: the whole solid lies between `low` and `high` in the box's frame, m */
    float low[3], high[3];
    float change[3]; /* of v, over the step: m/s2 */
    float alpha[3];  /* of w, over the step: rad/s2 */
} SolidStep;

/* The pose at `time` (s); of a floating solid where the solid began. */
void solid_pose_at(const SolidDef *solid, double time, SolidPose *pose);
/* The same pose in single precision. */
void solid_pose_of(const BoxState *at, SolidPose *pose);

/* The solid's step from `begin` to `end`, s. */
void solid_step_make(const SolidDef *solid, double begin, double end, SolidStep *step);

/* The step of a solid at rest at `pose`. */
void solid_step_stand(const SolidDef *solid, const SolidPose *pose, SolidStep *step);

/* Gives both halves of a step the rates of the whole step. */
void solid_step_mean(SolidStep *first, SolidStep *second);

/* Positions, m, from the solid's frame to the box's frame and back. */
void solid_to_box(const SolidPose *pose, const float in_solid[3], float x[3]);
void solid_from_box(const SolidPose *pose, const float x[3], float in_solid[3]);

/* Signed distance of x from the surface, m; further away than `far`: a lower bound of at least `far`. */
float solid_clearance(const SolidDef *solid, const SolidPose *pose, int dimensions, const float x[3],
                      float far);

/* Velocity of the solid's matter at x (box's frame, m), m/s. */
void solid_velocity_at(const SolidPose *pose, const float x[3], float v[3]);

/* Acceleration of the solid's matter at x, m/s2, by the rates of the step. */
void solid_acceleration_at(const SolidStep *step, const float x[3], float a[3]);

/* Block around a particle's way, m, in the box's frame. */
typedef struct WayBounds {
    float low[3], high[3];
} WayBounds;

/* Bounds of the straight way from `before` to x. */
static inline WayBounds way_bounds(const float before[3], const float x[3])
{
    WayBounds way;
    for (int k = 0; k < 3; k++) {
        way.low[k] = before[k] < x[k] ? before[k] : x[k];
        way.high[k] = before[k] > x[k] ? before[k] : x[k];
    }
    return way;
}

/* True where solid_guard would find nothing to do: for nearly all particles beside a still solid. */
static inline bool solid_step_beside(const SolidStep *step, int dimensions, const WayBounds *way)
{
    return step->still && (way->high[0] < step->low[0] || way->low[0] > step->high[0] ||
                           way->high[1] < step->low[1] || way->low[1] > step->high[1] ||
                           (dimensions == 3 && (way->high[2] < step->low[2] || way->low[2] > step->high[2])));
}

/* Keeps a particle on a way from `before` to x out of the solid, on the side of `before`, however thin the
   solid is there. Removes the velocity into the surface. True if x and v had to change. */
bool solid_guard(const SolidDef *solid, const SolidStep *step, int dimensions, const float before[3],
                 float x[3], float v[3]);

/* Boundary particles: how fluid sees solids. Layers of particles lie behind a solid's surface, the first half
   a spacing away, down to the support radius; each particle has a volume of spacing^dimensions. Sums over
   neighbours treat boundary particles like particles of a lattice at rest (Akinci 2012; Adami 2012). Layers
   follow the surface, so that a sphere is as smooth as its particles allow. */

typedef struct Boundary {
    size_t count;
    float *rest;    /* 3 per particle: in the solid's frame, m */
    uint8_t *solid; /* per particle: index into WorldDef.solids */
} Boundary;

/* Creates the boundary particles of all solids of the def; without solids nothing is allocated. Returns false
   if memory is short. */
bool boundary_create(Boundary *boundary, const WorldDef *def);
void boundary_destroy(Boundary *boundary);

/* The layers of one solid, not a mesh, up to `depth` m behind the surface: writes 3 floats per particle, in
   the solid's frame, m, and returns the number of particles. With NULL only counts. In two dimensions all
   have z = 0. */
size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position);

/* Estimates the number of particles without making them; meshes too. */
double boundary_estimate(const SolidDef *solid, int dimensions, double spacing, double depth);

#endif
