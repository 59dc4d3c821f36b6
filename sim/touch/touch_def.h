/* How a user touches: what the pointer does, how large it is, how strong. The scene's keys `touch.*`. */
#ifndef SLOSH_TOUCH_DEF_H
#define SLOSH_TOUCH_DEF_H

#include "sim/touch/finger.h"

typedef struct TouchWay {
    const char *name, *help;
} TouchWay;

/* By FingerWay less one; ended by a NULL name. */
extern const TouchWay touch_ways[];

typedef struct TouchDef {
    int way;         /* of touch_ways */
    int fluid;       /* that is poured */
    double radius;   /* spacings */
    double strength; /* 1: as a rule */
} TouchDef;

TouchDef touch_def_default(void);

/* How large that is, m: of the ball, or of the disk from which fluid is poured. */
double touch_radius(const TouchDef *def, FingerWay way, double spacing);

/* A finger that does it at a place (box's frame, m) of a scene with that spacing (m). */
Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing);

/* "none", or a name of touch_ways, that of pouring for each fluid; FINGER_WAYS where there is none of that
   name. */
const char *finger_way_name(FingerWay way);
FingerWay finger_way_find(const char *name);

#endif
