/* All that turns a world into pictures: renderer and upload ring, in the current context. */
#ifndef SLOSH_STUDIO_H
#define SLOSH_STUDIO_H

#include "app/headless.h"
#include "render/renderer.h"
#include "render/upload.h"
#include "sim/gl/timer.h"
#include "sim/world.h"

typedef struct Studio {
    Renderer *renderer; /* NULL until it is there */
    Upload *upload;
} Studio;

/* For worlds of up to `count` particles; needs a current context. On failure call studio_close as well. */
bool studio_open(Studio *studio, const ViewDef *view, size_t count, int width, int height, Error *error);
void studio_close(Studio *studio); /* a zeroed one is allowed */

/* Uploads the world's state and draws it; `clock` gets the upload, `timer` the GL stages; both may be NULL.
 */
bool studio_draw(Studio *studio, World *world, StageClock *clock, GlTimer *timer, Error *error);

#endif
