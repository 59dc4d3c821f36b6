/* The axes of a map: set by --axis, or chosen for the scene. */
#ifndef SLOSH_STABLE_AXIS_H
#define SLOSH_STABLE_AXIS_H

#include "app/scene/scene.h"
#include "sim/base/key.h"

enum { STABLE_AXES = 2, STABLE_POINTS = 32, STABLE_KEY = 96, STABLE_VALUE = 32 };

typedef struct StableAxis {
    char key[STABLE_KEY];
    const Key *row;
    int count;
    bool logarithmic; /* if the axis spans a decade or more */
    double value[STABLE_POINTS];
    char text[STABLE_POINTS][STABLE_VALUE]; /* as in a scene file */
} StableAxis;

/* Parses "KEY=a:b" or "KEY=a:b:n". Returns false with the reason. */
bool stable_axis_parse(const char *text, StableAxis *axis, Error *error);

/* Chooses axes for a command line without --axis; returns their count. First axis: speed of sound, from
   1/4 to 4 times the scene's. Second: viscosity of the first fluid, from where friction limits the step a
   hundredth as much as sound to four times as much, for the first method with sound. Without such a
   method: viscosity alone, compared with the step for pressure; if viscosity has no effect either, the
   spacing. Each axis has eight points. */
int stable_axes_choose(const Scene *scene, const char *const methods[], int count,
                       StableAxis axes[STABLE_AXES]);

#endif
