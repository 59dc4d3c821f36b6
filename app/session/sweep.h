/* Combinations of swept settings: each value of each sweep with each of the others, the last sweep fastest.
 */
#ifndef SLOSH_SWEEP_H
#define SLOSH_SWEEP_H

#include "app/session/args.h"

/* How many there are; 1 without sweeps. */
size_t sweeps_combinations(const Sweep sweeps[], int count);

/* The value that sweep number `which` has in a combination. */
const char *sweeps_value(const Sweep sweeps[], int count, int which, size_t combination);

/* The key as the user wrote it. */
const char *sweep_typed(const Sweep *sweep);

/* "key=value, key=value", keys as the user wrote them, `equals` between key and value; "" without sweeps. */
void sweeps_name(const Sweep sweeps[], int count, size_t combination, const char *equals, char *name,
                 size_t size);

enum { SWEEP_SAID = 512 };

/* Adds that value of a sweep to the settings; `said` gets "--sweep key=value", by that name of the option,
   and is to live as long as they do. False where there are too many. */
bool sweep_set(const char *key, const char *value, const char *option, char said[SWEEP_SAID],
               SceneSettings *settings, Error *error);

#endif
