/* Hash of all inputs of a run; tables of runs use the hash to recognise finished runs. */
#ifndef SLOSH_RUN_KEY_H
#define SLOSH_RUN_KEY_H

#include "app/scene/scene.h"
#include "sim/base/hash.h"

#include <stdint.h>

/* Initial value. */
#define RUN_KEY HASH_NONE

/* Adds a text to `key`. */
uint64_t run_key_text(uint64_t key, const char *text);

/* Adds the build of the program, all resolved settings of the scene (view settings only with `looks`), and
   the contents of its tables. Returns false, with a useless key, if memory is short or the program has no
   build id. */
bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error);

#endif
