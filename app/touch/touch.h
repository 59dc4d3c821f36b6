/* The touch tool: a finger put into the fluid by a mouse drag. Pure: no window, no GL. Positions are in
   the box's frame, m. */
#ifndef SLOSH_APP_TOUCH_H
#define SLOSH_APP_TOUCH_H

#include "app/touch/hold.h"
#include "render/frame/handle.h"
#include "sim/touch/touch_def.h"

#include <stdbool.h>

/* Zero-initialise before use. */
typedef struct TouchTool {
    bool on;          /* drags belong to the tool */
    bool holds;       /* a drag has a position: */
    bool spent;       /* time has jumped during the drag: the drag has no more effect */
    FingerWay way;    /* effect of the finger */
    double at[3];     /* position of the pointer; without a drag, where a drag would begin */
    Finger told;      /* last sent */
    Hold hold;        /* a grabbed solid, instead of the finger */
    unsigned travels; /* count of time jumps seen */
    bool scripted;    /* a recorded session was played at that time */
} TouchTool;

/* A further effect of the left button, besides the ways of a finger: grabbing solids. Numbered like a
   FingerWay less one. */
enum { TOUCH_HOLD = FINGER_POUR };

/* Returns the effect of the second button: pull, or push if `way` is pull. */
FingerWay touch_other(FingerWay way);

/* Begins a drag with the given effect, at a position. */
void touch_press(TouchTool *tool, FingerWay way, const double at[3]);

/* Ends the drag. `behind`: later states are kept, and would be cut off by an end command. */
void touch_release(TouchTool *tool, bool behind);

/* Removes the finger: the scene restarts, or another scene is open. */
void touch_forget(TouchTool *tool);

/* Reports the count of time jumps: after a jump a drag has no more effect. While a recorded session is
   played, its commands count as jumps, and the drag takes over. */
void touch_travel(TouchTool *tool, unsigned travels, bool scripted);

/* Moves the tool to the point where `ray` meets the plane through the tool's position facing a camera
   looking along `forward`, or the plane of a two-dimensional fluid. Returns false if the ray misses. */
bool touch_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions);

/* Fills in the finger to send; returns false if the last sent finger still applies. */
bool touch_asks(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger);

/* Returns the outline of the ball, or of the poured fluid, seen along `forward`. */
Handle touch_ring(const TouchTool *tool, const TouchDef *def, double spacing, const double forward[3]);

/* Returns `value` changed by notches of the wheel, within the key's bounds. */
double touch_notches(double value, double notches, double least, double most);

#endif
