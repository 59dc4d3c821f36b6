/* Solids in the hand: the mouse takes one, moves it in the plane that faces the camera, or turns it. Pure: no
   window, no GL. Places are in the box's frame, m. */
#ifndef SLOSH_APP_HOLD_H
#define SLOSH_APP_HOLD_H

#include "app/recording/solid_command.h"
#include "render/frame/handle.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>

/* Zero-initialise it. */
typedef struct Hold {
    bool pressed; /* a drag has begun, */
    bool holds;   /* and has a solid: */
    bool turns;   /* it turns it; else it moves it */
    int solid;
    int dimensions;
    double reach;            /* of the solid, m */
    double from[3];          /* where the mouse took it */
    double at[3], turn[4];   /* the hand's part of its pose then */
    double forward[3];       /* where the camera looked */
    double told[3], spun[4]; /* as it was last sent */
} Hold;

/* The solid that the ray meets first, as it is at `time` (s), and where; -1: none. `floating`: poses of those
   that float (WorldInfo), by the def's solids. */
int hold_under(const WorldDef *def, double time, const BoxState *floating, const SightRay *ray, double at[3]);

/* A drag begins, and takes the solid that the ray meets; false: there is none. */
bool hold_press(Hold *hold, const WorldDef *def, double time, const BoxState *floating, const SightRay *ray,
                const double forward[3], bool turns);

/* The mouse is there now; true: `command` is to be sent. */
bool hold_move(Hold *hold, const SightRay *ray, SolidCommand *command);

void hold_release(Hold *hold);

#endif
