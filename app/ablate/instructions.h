/* Counts instructions of a solver step with valgrind: the same in each run, however busy the machine. */
#ifndef SLOSH_INSTRUCTIONS_H
#define SLOSH_INSTRUCTIONS_H

#include "app/scene/scene.h"

/* Returns true if valgrind is installed. */
bool instructions_can(void);

/* Counts the instructions of the scene's first steps, mean per step, on one thread; with one more setting
   (NULL: none) and `particles` particles (0: as set). Runs the program again under valgrind, about fifty
   times slower; a signal ends the count. Returns false with the reason. */
bool instructions_count(const char *scene, const SceneSettings *settings, const char *more, size_t particles,
                        double *per_step, Error *error);

#endif
