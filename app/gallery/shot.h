/* A picture of a state with a view, and how long it takes. */
#ifndef SLOSH_SHOT_H
#define SLOSH_SHOT_H

#include "app/gallery/picture_error.h"
#include "app/scene/scene.h"
#include "app/session/headless.h"
#include "sim/world/world.h"

enum { SHOT_FACTOR = 8 };

/* By how much a picture of that size can be supersampled: SHOT_FACTOR, or what the driver and 16 million
   pixels allow. Needs a current context. */
int shot_factor(int width, int height);

typedef struct Shot {
    LinearPicture picture; /* of the size asked for; owned */
    double ms;             /* of drawing: the least of several pictures */
    char clock[NAME_SIZE]; /* "gl" or "finish" */
} Shot;

/* Draws the world's state as the scene's view is, `factor` times as large, several times where `timed`.
   linear_picture_free(&shot->picture) in either case. */
bool shoot(const Scene *scene, World *world, int width, int height, int factor, bool timed, Shot *shot,
           Error *error);

#endif
