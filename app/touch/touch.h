/* The touch tool: the finger that a drag of the mouse puts into the fluid. Pure: no window, no GL. Places are
   in the box's frame, m. */
#ifndef SLOSH_APP_TOUCH_H
#define SLOSH_APP_TOUCH_H

#include "app/touch/hold.h"
#include "render/frame/handle.h"
#include "sim/touch/touch_def.h"

#include <stdbool.h>

/* Zero-initialise it. */
typedef struct TouchTool {
    bool on;          /* drags are for it */
    bool holds;       /* a drag has a place: */
    bool spent;       /* time has jumped under the drag: it does nothing more */
    FingerWay way;    /* what it does */
    double at[3];     /* where the pointer is; without a drag, where it would begin */
    Finger told;      /* as it was last sent */
    Hold hold;        /* a solid that is in the hand instead of it */
    unsigned travels; /* jumps in time that were seen, */
    bool scripted;    /* and whether a recorded session was played then */
} TouchTool;

/* What the left button does beyond the ways of a finger: it takes solids. In the place of a FingerWay less
 * one. */
enum { TOUCH_HOLD = FINGER_POUR };

/* What the other button does than that which does `way`: pull, or push where that pulls. */
FingerWay touch_other(FingerWay way);

/* From now on a drag does that, at a place. */
void touch_press(TouchTool *tool, FingerWay way, const double at[3]);

/* No drag has it. `behind`: states of later times are kept, which its end as a command would cut off. */
void touch_release(TouchTool *tool, bool behind);

/* Nothing is in the fluid: the scene begins anew, or another one is open. */
void touch_forget(TouchTool *tool);

/* Time has jumped so many times: a drag does nothing more from then on. Where a recorded session is played
   its commands count as jumps, and the drag takes over from it. */
void touch_travel(TouchTool *tool, unsigned travels, bool scripted);

/* Where `ray` meets the plane through the tool's place that faces the camera looking along `forward`, or that
   of a fluid in two dimensions: the tool's place from now on. False where they do not meet. */
bool touch_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions);

/* What is to be sent; false: what was sent still holds. */
bool touch_asks(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger);

/* The outline of the ball, or of what is poured, as it is seen along `forward`. */
Handle touch_ring(const TouchTool *tool, const TouchDef *def, double spacing, const double forward[3]);

/* `value` after so many notches of the wheel, within the key's bounds. */
double touch_notches(double value, double notches, double least, double most);

#endif
