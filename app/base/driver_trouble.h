/* What an OpenGL driver does where memory or a disk is short: Mesa ends the program by a signal. */
#ifndef SLOSH_DRIVER_TROUBLE_H
#define SLOSH_DRIVER_TROUBLE_H

/* Before a context is made. From now on a crash outside of slosh's own code is said in a line, removes what
   is half-written and ends the program with 1. Where Mesa's cache of shaders has no room it is turned off,
   with a word: Mesa maps its file without looking. */
void driver_trouble_begin(void);

#endif
