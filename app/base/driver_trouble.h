/* Crashes of an OpenGL driver where memory or a disk is short: Mesa ends the program by a signal. */
#ifndef SLOSH_DRIVER_TROUBLE_H
#define SLOSH_DRIVER_TROUBLE_H

/* Call before a context is made. From then on a crash outside of slosh's code prints a line, removes
   half-written outputs and ends the program with 1. Turns Mesa's cache of shaders off, and says so, if its
   folder has no room: Mesa maps a file there without looking. */
void driver_trouble_begin(void);

#endif
