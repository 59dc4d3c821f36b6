/* A user's touch: effect, size and strength at the pointer. The scene's keys `touch.*`. */
#ifndef SLOSH_TOUCH_DEF_H
#define SLOSH_TOUCH_DEF_H

#include "sim/touch/finger.h"

typedef struct TouchWay {
    const char *name, *help;
} TouchWay;

/* Indexed by FingerWay - 1; ended by a NULL name. */
extern const TouchWay touch_ways[];

typedef struct TouchDef {
    int way;         /* of touch_ways */
    int fluid;       /* for pouring */
    double radius;   /* spacings */
    double strength; /* 1: default */
} TouchDef;

TouchDef touch_def_default(void);

/* Radius, m: of the ball, or of the disk for pouring. */
double touch_radius(const TouchDef *def, FingerWay way, double spacing);

/* A finger of the def at a position (box's frame, m) in a scene with the given spacing (m). */
Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing);

/* "none" or a name of touch_ways; pouring has the same name for each fluid. finger_way_find returns
   FINGER_WAYS for an unknown name. */
const char *finger_way_name(FingerWay way);
FingerWay finger_way_find(const char *name);

#endif
