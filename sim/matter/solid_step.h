/* Solids over a step: where their boundary particles go, what they feel, and the guard that keeps fluid out.
 */
#ifndef SLOSH_SOLID_STEP_H
#define SLOSH_SOLID_STEP_H

#include "sim/matter/solid.h"

/* A pose in single precision: x_box = x + r x_solid; the velocity at x_box is v + w x (x_box - x). */
typedef struct SolidPose {
    float x[3]; /* m */
    float r[3][3];
    float v[3]; /* m/s */
    float w[3]; /* rad/s */
} SolidPose;

/* What one solid does from one pose to the next. */
typedef struct SolidStep {
    SolidPose begin, end;
    bool still; /* it has no motion: all of it lies between `low` and `high` in the box's frame, m */
    float low[3], high[3];
    float change[3]; /* of v, over the step: m/s2 */
    float alpha[3];  /* of w, over the step: rad/s2 */
} SolidStep;

void solid_pose_at(const SolidDef *solid, double time, SolidPose *pose);
void solid_pose_of(const BoxState *at, SolidPose *pose);

/* From `begin` to `end`, s. */
void solid_step_make(const SolidDef *solid, double begin, double end, SolidStep *step);

/* Of one that stands at `pose` throughout. */
void solid_step_stand(const SolidDef *solid, const SolidPose *pose, SolidStep *step);

/* Gives both halves of a step the rates of the whole. */
void solid_step_mean(SolidStep *first, SolidStep *second);

void solid_to_box(const SolidPose *pose, const float in_solid[3], float x[3]);
void solid_from_box(const SolidPose *pose, const float x[3], float in_solid[3]);
/* Signed distance of x from the surface, m, or `far` and more where it is further away than that. */
float solid_clearance(const SolidDef *solid, const SolidPose *pose, int dimensions, const float x[3],
                      float far);

void solid_velocity_at(const SolidPose *pose, const float x[3], float v[3]);

/* The acceleration of the solid's matter at x, by the rates of the step. */
void solid_acceleration_at(const SolidStep *step, const float x[3], float a[3]);

/* A particle's way from one place to another: the block about it, m, in the box's frame. */
typedef struct WayBounds {
    float low[3], high[3];
} WayBounds;

static inline WayBounds way_bounds(const float before[3], const float x[3])
{
    WayBounds way;
    for (int k = 0; k < 3; k++) {
        way.low[k] = before[k] < x[k] ? before[k] : x[k];
        way.high[k] = before[k] > x[k] ? before[k] : x[k];
    }
    return way;
}

/* True where solid_guard would find nothing to do, as for nearly all particles beside what stands still. */
static inline bool solid_step_beside(const SolidStep *step, int dimensions, const WayBounds *way)
{
    return step->still && (way->high[0] < step->low[0] || way->low[0] > step->high[0] ||
                           way->high[1] < step->low[1] || way->low[1] > step->high[1] ||
                           (dimensions == 3 && (way->high[2] < step->low[2] || way->low[2] > step->high[2])));
}

/* Keeps a particle that went from `before` to x out of the solid, on the side from which it came, however
   thin the solid is there, and takes its velocity into the surface away; true if it had to. */
bool solid_guard(const SolidDef *solid, const SolidStep *step, int dimensions, const float before[3],
                 float x[3], float v[3]);

#endif
