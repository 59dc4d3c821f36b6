/* Combinations of swept settings: each value of a sweep with each value of the other sweeps; the last sweep
   varies fastest. */
#ifndef APP_CLI_SWEEP_H
#define APP_CLI_SWEEP_H

#include "app/cli/args/args.h"

/* Count of combinations; 1 without sweeps. */
size_t sweeps_combinations(const Sweep sweeps[], int count);

/* The value of sweep number `which` in a combination. */
const char *sweeps_value(const Sweep sweeps[], int count, int which, size_t combination);

/* The key as typed by the user. */
const char *sweep_typed(const Sweep *sweep);

/* "key=value, key=value", keys as typed by the user, `equals` between key and value; "" without sweeps. */
void sweeps_name(const Sweep sweeps[], int count, size_t combination, const char *equals, char *name,
                 size_t size);

enum { SWEEP_SAID = 512 };

/* Adds a value of a sweep to the settings; `said` gets "--sweep key=value", with the option's name, and must
   live as long as the settings. Returns false if there are too many settings. */
bool sweep_set(const char *key, const char *value, const char *option, char said[SWEEP_SAID],
               SceneSettings *settings, Error *error);

#endif
