/* Drawing without a window: an OpenGL 4.5 core context without a display, by EGL, and what draws a world in
   the current context. */
#ifndef APP_RUN_OFFSCREEN_H
#define APP_RUN_OFFSCREEN_H

#include "render/particles/particles.h"
#include "render/renderer.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <stdbool.h>

enum { HEADLESS_GPU_AUTO = -1, HEADLESS_GPUS_MAX = 16 };

typedef struct Headless Headless;

/* Creates a context and makes it current on the calling thread. `gpu` counts the EGL devices of hardware; -1
   takes the first working device, a software driver where no GPU is, and Mesa's surfaceless platform if all
   fail. Returns NULL on failure: `error` lists the attempts. */
Headless *headless_create(int gpu, Error *error);
void headless_destroy(Headless *headless); /* NULL is allowed */

/* Makes the context current on the calling thread, or no context if `current` is false; forgets known values
   of OpenGL's state. Returns false on failure; a NULL context fails. */
bool headless_use(Headless *headless, bool current);

/* The driver's name of the renderer, for people; owned by `headless`. */
const char *headless_renderer(const Headless *headless);

/* Tells the name of the current context's renderer on standard error, in a line; of a software driver also
   the reason why no GPU is used. */
void renderer_tell(const char *name);

/* Renderer and upload ring. */
typedef struct Offscreen {
    Renderer *renderer;  /* NULL until created */
    Upload *upload;      /* NULL: the world's particles are on the GPU */
    unsigned attributes; /* needed by the view */
} Offscreen;

/* Opens for worlds like `world`; needs a current context. On failure call offscreen_close as well.
 */
bool offscreen_open(Offscreen *offscreen, const ViewDef *view, const WorldDef *def, const World *world,
                    int width, int height, Error *error);
void offscreen_close(Offscreen *offscreen); /* a zeroed one is allowed */

/* Uploads the world's state, unless it is on the GPU, and draws it; `clock` gets the upload time, `timer` the
   GL stages; both may be NULL. */
bool offscreen_draw(Offscreen *offscreen, World *world, StageClock *clock, GlTimer *timer, Error *error);

/* Draws again and counts the work of the view's passes: see render/frame/frame.h. */
bool offscreen_count(Offscreen *offscreen, World *world, ViewCounts *counts, Error *error);

#endif
