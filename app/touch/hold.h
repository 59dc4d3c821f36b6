/* Solids in the hand: the mouse grabs a solid, and moves it in the plane facing the camera, or turns it.
   Pure: no window, no GL. Positions are in the box's frame, m. */
#ifndef SLOSH_APP_HOLD_H
#define SLOSH_APP_HOLD_H

#include "app/recording/solid_command.h"
#include "render/frame/handle.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>

/* Zero-initialise before use. */
typedef struct Hold {
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
} Hold;

/* Returns the first solid on the ray at `time` (s), and the hit point; -1: none. `floating`: poses of
   floating solids (WorldInfo), indexed like the def's solids. */
int hold_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray, double at[3]);

/* Begins a drag, and grabs the solid on the ray; returns false if there is none. */
bool hold_press(Hold *hold, const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                const double forward[3], bool turns);

/* Moves the mouse; returns true if `command` must be sent. */
bool hold_move(Hold *hold, const SightRay *ray, SolidCommand *command);

void hold_release(Hold *hold);

#endif
