/* An OpenGL 4.5 core context without a display, by EGL. */
#ifndef SLOSH_HEADLESS_H
#define SLOSH_HEADLESS_H

#include "sim/base/error.h"

#include <stdbool.h>

enum { HEADLESS_GPU_AUTO = -1, HEADLESS_GPUS_MAX = 16 };

typedef struct Headless Headless;

/* Creates a context and makes it current on the calling thread. `gpu` counts the EGL devices, hardware before
   software; -1 takes the first working device, and Mesa's surfaceless platform if all fail. Returns NULL on
   failure: `error` lists the attempts. */
Headless *headless_create(int gpu, Error *error);
void headless_destroy(Headless *headless); /* NULL is allowed */

/* The driver's name of the renderer, for people; owned by `headless`. */
const char *headless_renderer(const Headless *headless);

#endif
