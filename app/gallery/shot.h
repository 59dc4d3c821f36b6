/* A picture of a state with a view, and its drawing time. */
#ifndef SLOSH_SHOT_H
#define SLOSH_SHOT_H

#include "app/gallery/picture_error.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "sim/world/world.h"

enum { SHOT_FACTOR = 8 };

/* Returns the supersampling factor for a picture of the given size: SHOT_FACTOR, or less if limited by the
   driver or by 16 million pixels. Needs a current context. */
int shot_factor(int width, int height);

typedef struct Shot {
    LinearPicture picture; /* of the requested size; owned */
    double ms;             /* drawing time: the least of several pictures */
    char clock[NAME_SIZE]; /* "gl" or "finish" */
} Shot;

/* Draws the world's state with the scene's view, `factor` times as large, several times if `timed`. Call
   linear_picture_free(&shot->picture) in either case. */
bool shoot(const Scene *scene, World *world, int width, int height, int factor, bool timed, Shot *shot,
           Error *error);

#endif
