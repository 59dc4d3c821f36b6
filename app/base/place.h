/* Locations of slosh's own files, for any place of the program. */
#ifndef SLOSH_BASE_PLACE_H
#define SLOSH_BASE_PLACE_H

#include <stdbool.h>

enum { PLACE_SIZE = 1024 };

/* The folder with scenes/: PREFIX/share/slosh of an installed program, or the sources of a program in its
   build tree. False: neither exists. */
bool place_shipped(char folder[PLACE_SIZE]);

/* The user's folder: $XDG_CONFIG_HOME/slosh, or ~/.config/slosh. False: unknown. */
bool place_own(char folder[PLACE_SIZE]);

/* The udev rule of an installed program; false: not installed. */
bool place_rule(char path[PLACE_SIZE]);

/* The sources of a program in its build tree; NULL: not in a build tree. */
const char *place_sources(void);

#endif
