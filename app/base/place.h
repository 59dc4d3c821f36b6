/* Where what belongs to the program lies, wherever the program was put. */
#ifndef SLOSH_BASE_PLACE_H
#define SLOSH_BASE_PLACE_H

#include <stdbool.h>

enum { PLACE_SIZE = 1024 };

/* The folder that holds scenes/: PREFIX/share/slosh of an installed program, else, of a program in its build
   tree, the sources. False: the program stands alone. */
bool place_shipped(char folder[PLACE_SIZE]);

/* The user's own: $XDG_CONFIG_HOME/slosh, or ~/.config/slosh. False: no folder is known. */
bool place_own(char folder[PLACE_SIZE]);

/* The udev rule of an installed program; false: it is not installed. */
bool place_rule(char path[PLACE_SIZE]);

/* The sources of a program in its build tree; NULL: it is not in it. */
const char *place_sources(void);

#endif
