/* For the solver's tests on a GPU: a context from before main to the end. */
#include "app/run/offscreen.h"
#include "sim/gpu/gl.h"

#include <stdio.h>
#include <stdlib.h>

static Headless *context;

static void end(void)
{
    headless_destroy(context);
}

__attribute__((constructor)) static void begin(void)
{
    Error error;
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    if (!context) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    backends_add();
    atexit(end);
}
