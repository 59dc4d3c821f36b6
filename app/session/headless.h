/* An OpenGL 4.5 core context without a display, by EGL. */
#ifndef SLOSH_HEADLESS_H
#define SLOSH_HEADLESS_H

#include "sim/base/error.h"

#include <stdbool.h>

enum { HEADLESS_GPU_AUTO = -1, HEADLESS_GPUS_MAX = 16 };

typedef struct Headless Headless;

/* Makes a context and makes it current on the calling thread. `gpu` counts the EGL devices, hardware first,
   then the software one; -1 takes the first that works, and Mesa's surfaceless platform when none does. NULL
   on failure: `error` says what was tried. */
Headless *headless_create(int gpu, Error *error);
void headless_destroy(Headless *headless); /* NULL is allowed */

/* The driver's name for what draws, for people; owned by `headless`. */
const char *headless_renderer(const Headless *headless);

#endif
