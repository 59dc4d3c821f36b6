/* Lines between points, constant outside. */
#ifndef SIM_BASE_TABLES_H
#define SIM_BASE_TABLES_H

#include <stdbool.h>

/* Control points of a curve from a scalar to a visual value: position in a colormap, opacity, factor of a
   radius. Linear between the points, constant outside; x is the scalar's position in its range, 0 at the
   low end, 1 at the high end. */

#ifdef __cplusplus
extern "C" {
#endif

enum { CONTROL_POINTS_MAX = 8 };

typedef struct ControlPoints {
    int count;                    /* 1 and more */
    double x[CONTROL_POINTS_MAX]; /* 0 .. 1, ascending */
    double y[CONTROL_POINTS_MAX];
} ControlPoints;

/* Named points. */
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

/* The curve's value; NaN counts as x = 1, to be visible. */
double control_points_at(const ControlPoints *points, double x);

/* The greatest and the least y. */
double control_points_most(const ControlPoints *points);
double control_points_least(const ControlPoints *points);

/* Edits by the panel. Moves a point; its neighbours stop it at a distance of CONTROL_POINTS_GAP. */
#define CONTROL_POINTS_GAP 0.002
void control_points_move(ControlPoints *points, int at, double x, double y);
/* Adds a point and returns its index; -1 if there are CONTROL_POINTS_MAX points or a point is too near. */
int control_points_add(ControlPoints *points, double x, double y);
/* False for the only point. */
bool control_points_remove(ControlPoints *points, int at);

#ifdef __cplusplus
}
#endif

#endif
