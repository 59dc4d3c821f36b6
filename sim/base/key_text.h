/* The allowed values of a key, in words. */
#ifndef SLOSH_KEY_TEXT_H
#define SLOSH_KEY_TEXT_H

#include "sim/base/key.h"

/* "0.001 to 1000", "more than 0, at most 5"; "" when not bounded. */
void key_range_text(const Key *key, char *text, size_t size);

/* The same for the numbers alone, if names are also allowed. */
void key_bounds_text(const Key *key, char *text, size_t size);

#endif
