/* What a drag of the mouse does inside the box: the touch tool, with a finger in the fluid (TouchTool), a
   solid in the hand (SolidDrag), and walls as handles. Pure: no window, no GL. Positions are in the box's
   frame, m. */
#ifndef APP_INPUT_TOUCH_H
#define APP_INPUT_TOUCH_H

#include "app/run/recording/sim_command.h"
#include "render/frame/camera.h"
#include "sim/flow/finger.h"
#include "slosh/def.h"

#include <stdbool.h>

/* Solids in the hand: the mouse grabs a solid, and moves it in the plane facing the camera, or turns it.
   Pure: no window, no GL. Positions are in the box's frame, m. */

/* Zero-initialise before use. */
typedef struct SolidDrag {
    bool pressed; /* a drag has begun */
    bool holds;   /* and has grabbed a solid: */
    bool turns;   /* true: turns the solid; false: moves it */
    int solid;
    int dimensions;
    double reach;            /* of the solid, m */
    double from[3];          /* where the mouse grabbed the solid */
    double at[3], turn[4];   /* the hand's part of the solid's pose at the grab */
    double forward[3];       /* direction of the camera at the grab */
    double told[3], spun[4]; /* last sent */
} SolidDrag;

/* Returns the first solid on the ray at `time` (s), and the hit point; -1: none. `floating`: poses of
   floating solids (WorldInfo), indexed like the def's solids. */
int solid_drag_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                     double at[3]);

/* Begins a drag, and grabs the solid on the ray; returns false if there is none. */
bool solid_drag_press(SolidDrag *hold, const WorldDef *def, double time, const BoxState *floating,
                      const SightRay *ray, const double forward[3], bool turns);

/* Moves the mouse; returns true if `command` must be sent. */
bool solid_drag_move(SolidDrag *hold, const SightRay *ray, SolidCommand *command);

void solid_drag_release(SolidDrag *hold);

/* The walls of the box as handles: an arrow on each movable wall, dragged along the wall's normal. The
   floor stays; opposite walls move together, as the middle of the floor stays. */

enum { WALL_HANDLES_MAX = 5 };

/* Fills in the arrows of the walls that are not open; returns their count. */
int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX]);

/* Handles a drag of the arrow `taken` to `at`: `size` gets the new box size, at least `least` along the
   axis. */
void wall_drag(const Handle *taken, const double at[3], double least, double size[3]);

/* The touch tool: a finger put into the fluid by a mouse drag. Pure: no window, no GL. Positions are in
   the box's frame, m. */

/* Zero-initialise before use. */
typedef struct TouchTool {
    bool on;          /* drags belong to the tool */
    bool holds;       /* a drag has a position: */
    bool spent;       /* time has jumped during the drag: the drag has no more effect */
    FingerWay way;    /* effect of the finger */
    double at[3];     /* position of the pointer; without a drag, where a drag would begin */
    Finger told;      /* last sent */
    SolidDrag hold;   /* a grabbed solid, instead of the finger */
    unsigned travels; /* count of time jumps seen */
    bool scripted;    /* a recorded session was played at that time */
} TouchTool;

/* A further effect of the left button, besides the ways of a finger: grabbing solids. Numbered like a
   FingerWay less one. */
enum { TOUCH_TOOL_SOLIDS = FINGER_POUR };

/* Returns the effect of the second button: pull, or push if `way` is pull. */
FingerWay touch_tool_other(FingerWay way);

/* Begins a drag with the given effect, at a position. */
void touch_tool_press(TouchTool *tool, FingerWay way, const double at[3]);

/* Ends the drag. `behind`: later states are kept, and would be cut off by an end command. */
void touch_tool_release(TouchTool *tool, bool behind);

/* Removes the finger: the scene restarts, or another scene is open. */
void touch_tool_reset(TouchTool *tool);

/* Reports the count of time jumps: after a jump a drag has no more effect. While a recorded session is
   played, its commands count as jumps, and the drag takes over. */
void touch_tool_travel(TouchTool *tool, unsigned travels, bool scripted);

/* Moves the tool to the point where `ray` meets the plane through the tool's position facing a camera
   looking along `forward`, or the plane of a two-dimensional fluid. Returns false if the ray misses. */
bool touch_tool_move(TouchTool *tool, const SightRay *ray, const double forward[3], int dimensions);

/* Fills in the finger to send; returns false if the last sent finger still applies. */
bool touch_tool_finger(TouchTool *tool, const TouchDef *def, double spacing, Finger *finger);

/* Returns the outline of the ball, or of the poured fluid, seen along `forward`. */
Handle touch_tool_outline(const TouchTool *tool, const TouchDef *def, double spacing,
                          const double forward[3]);

/* Returns `value` changed by notches of the wheel, within the key's bounds. */
double touch_tool_notches(double value, double notches, double least, double most);

#endif
