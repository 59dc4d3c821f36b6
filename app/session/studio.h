/* Renderer and upload ring, which draw a world in the current context. */
#ifndef SLOSH_STUDIO_H
#define SLOSH_STUDIO_H

#include "app/session/headless.h"
#include "render/particles/upload.h"
#include "render/renderer.h"
#include "sim/gl/timer.h"
#include "sim/world/world.h"

typedef struct Studio {
    Renderer *renderer;  /* NULL until created */
    Upload *upload;      /* NULL: the world's particles are on the GPU */
    unsigned attributes; /* needed by the view */
} Studio;

/* Opens a studio for worlds like `world`; needs a current context. On failure call studio_close as well. */
bool studio_open(Studio *studio, const ViewDef *view, const WorldDef *def, const World *world, int width,
                 int height, Error *error);
void studio_close(Studio *studio); /* a zeroed studio is allowed */

/* Uploads the world's state, unless it is on the GPU, and draws it; `clock` gets the upload time, `timer` the
   GL stages; both may be NULL. */
bool studio_draw(Studio *studio, World *world, StageClock *clock, GlTimer *timer, Error *error);

/* Draws again and counts the work of the view's passes: see render/frame/counts.h. */
bool studio_count(Studio *studio, World *world, ViewCounts *counts, Error *error);

#endif
