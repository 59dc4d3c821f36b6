/* The axes of a map: what --axis says, or what is chosen for the scene. */
#ifndef SLOSH_STABLE_AXIS_H
#define SLOSH_STABLE_AXIS_H

#include "app/scene/scene.h"
#include "sim/base/key.h"

enum { STABLE_AXES = 2, STABLE_POINTS = 32, STABLE_KEY = 96, STABLE_VALUE = 32 };

typedef struct StableAxis {
    char key[STABLE_KEY];
    const Key *row;
    int count;
    bool logarithmic; /* where it spans a decade and more */
    double value[STABLE_POINTS];
    char text[STABLE_POINTS][STABLE_VALUE]; /* as a scene has it */
} StableAxis;

/* "KEY=a:b" or "KEY=a:b:n"; false with the reason. */
bool stable_axis_parse(const char *text, StableAxis *axis, Error *error);

/* Where the command line names none: the speed of sound, from a quarter to four times the scene's, and the
   viscosity of its first fluid, from where friction binds a hundredth as much as sound to where it binds four
   times as much, by the first method that has sound. Without one: viscosity alone, against what pressure
   stands. Each of eight points; how many axes. */
int stable_axes_choose(const Scene *scene, const char *const methods[], int count,
                       StableAxis axes[STABLE_AXES]);

#endif
