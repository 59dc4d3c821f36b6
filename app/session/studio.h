/* All that turns a world into pictures: renderer and upload ring, in the current context. */
#ifndef SLOSH_STUDIO_H
#define SLOSH_STUDIO_H

#include "app/session/headless.h"
#include "render/particles/upload.h"
#include "render/renderer.h"
#include "sim/gl/timer.h"
#include "sim/world/world.h"

typedef struct Studio {
    Renderer *renderer;  /* NULL until it is there */
    Upload *upload;      /* NULL: the world has its particles on the GPU */
    unsigned attributes; /* that the view reads */
} Studio;

/* For worlds like that one; needs a current context. On failure call studio_close as well. */
bool studio_open(Studio *studio, const ViewDef *view, const WorldDef *def, const World *world, int width,
                 int height, Error *error);
void studio_close(Studio *studio); /* a zeroed one is allowed */

/* Uploads the world's state, unless it is on the GPU, and draws it; `clock` gets the upload, `timer` the GL
   stages; both may be NULL.
 */
bool studio_draw(Studio *studio, World *world, StageClock *clock, GlTimer *timer, Error *error);

/* Draws it once more and counts what the view's passes do: see render/frame/counts.h. */
bool studio_count(Studio *studio, World *world, ViewCounts *counts, Error *error);

#endif
