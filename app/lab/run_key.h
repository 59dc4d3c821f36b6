/* A number of all that a run depends on, by which tables of runs know what they have already. */
#ifndef SLOSH_RUN_KEY_H
#define SLOSH_RUN_KEY_H

#include "app/scene/scene.h"
#include "sim/base/hash.h"

#include <stdint.h>

/* Of nothing. */
#define RUN_KEY HASH_NONE

/* `key` with a text. */
uint64_t run_key_text(uint64_t key, const char *text);

/* With the build of the program, all settings of the scene as they were resolved, by whatever file or option,
   those of how it looks only with `looks`, and what its tables hold. False without memory or a build id: then
   the key is of no use. */
bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error);

#endif
