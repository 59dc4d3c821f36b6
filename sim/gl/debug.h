/* What the GL driver complains about: errors are counted and printed, so that tests can ask for none.
   Messages of the shader compiler do not count: program_create hands them to its caller. */
#ifndef SLOSH_GL_DEBUG_H
#define SLOSH_GL_DEBUG_H

#include <stdbool.h>

/* Listens to the current context from now on. */
void gl_debug_install(void);

/* Takes what is pending of glGetError's codes; returns how many were `code`, or of any kind for 0: the caller
   sees to these. The others are errors as if nobody had asked. */
int gl_errors_take(unsigned code);

/* While `asks`, what there is no memory for is no error: who asks for a buffer looks at glGetError. */
void gl_debug_asks_for_memory(bool asks);

/* Errors since gl_debug_install, of all contexts; takes pending glGetError codes of the current one along. */
int gl_debug_errors(void);

/* Errors of all contexts since the program began, none forgotten; needs no context. */
int gl_debug_total(void);

#endif
