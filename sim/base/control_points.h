/* The control points of a curve by which a scalar becomes something that is seen: a place in a colormap, an
   opacity, a factor of a radius. Straight lines between the points, constant before the first and after the
   last; x is where the scalar is in its range, 0 at the low end, 1 at the high one. */
#ifndef SLOSH_CONTROL_POINTS_H
#define SLOSH_CONTROL_POINTS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CONTROL_POINTS_MAX = 8 };

typedef struct ControlPoints {
    int count;                    /* 1 and more */
    double x[CONTROL_POINTS_MAX]; /* 0 .. 1, ascending */
    double y[CONTROL_POINTS_MAX];
} ControlPoints;

/* Points by a name. */
typedef struct ControlPreset {
    const char *name;
    ControlPoints points;
} ControlPreset;

/* For opacities, sizes and colours; ended by a NULL name. The first is y = x. */
extern const ControlPreset control_presets[];

/* y = x */
ControlPoints control_points_straight(void);
bool control_points_are_straight(const ControlPoints *points);
bool control_points_equal(const ControlPoints *a, const ControlPoints *b);

/* NaN is taken as 1: it is to be seen. */
double control_points_at(const ControlPoints *points, double x);

/* The greatest and the least y. */
double control_points_most(const ControlPoints *points);
double control_points_least(const ControlPoints *points);

/* What the panel does. Moves a point; its neighbours stop it `CONTROL_POINTS_GAP` before them. */
#define CONTROL_POINTS_GAP 0.002
void control_points_move(ControlPoints *points, int at, double x, double y);
/* A new point; its place among the others, -1 where there are CONTROL_POINTS_MAX or one is too near. */
int control_points_add(ControlPoints *points, double x, double y);
/* False where it is the only one. */
bool control_points_remove(ControlPoints *points, int at);

#ifdef __cplusplus
}
#endif

#endif
