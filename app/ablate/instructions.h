/* Instructions of a solver's step, counted by valgrind: the same in each run, however busy the machine. */
#ifndef SLOSH_INSTRUCTIONS_H
#define SLOSH_INSTRUCTIONS_H

#include "app/scene/scene.h"

/* Whether valgrind is there. */
bool instructions_can(void);

/* Counts those of the first steps of the scene with one more setting (NULL: none) and that many particles (0:
   as many as the settings say), on one thread: a step's, in the mean. Runs this program anew under valgrind,
   which is some fifty times slower; a signal ends it. False with the reason. */
bool instructions_count(const char *scene, const SceneSettings *settings, const char *more, size_t particles,
                        double *per_step, Error *error);

#endif
