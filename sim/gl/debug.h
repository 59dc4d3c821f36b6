/* Errors of the GL driver: counted and printed, so that tests can require zero errors. Messages of the
   shader compiler do not count: program_create returns them to its caller. */
#ifndef SLOSH_GL_DEBUG_H
#define SLOSH_GL_DEBUG_H

#include <stdbool.h>

/* Listens to the current context from now on. */
void gl_debug_install(void);

/* Takes pending glGetError codes. Returns the number of codes equal to `code`, or of all codes if `code` is
   0, for the caller to handle. The rest count as errors. */
int gl_errors_take(unsigned code);

/* While `asks` is true, out-of-memory is no error: callers that allocate buffers check glGetError. */
void gl_debug_asks_for_memory(bool asks);

/* Errors of all contexts since gl_debug_install, with pending glGetError codes of the current context. */
int gl_debug_errors(void);

/* Errors of all contexts since program start; needs no context. */
int gl_debug_total(void);

#endif
