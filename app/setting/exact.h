/* Values of a scene as text that is read as the same bits. */
#ifndef SLOSH_EXACT_H
#define SLOSH_EXACT_H

#include "sim/base/key.h"

#include <stdio.h>

enum { EXACT_SIZE = 16 * 48 }; /* the rows of a curve are the longest */

/* As key_value_text, but of a number all digits that count. `dimensions`: of the scene. */
void exact_text(const Key *key, const void *base, int dimensions, char *text, size_t size);

/* Whether what `base` points to has that mapping or that variant. */
bool exact_is_there(const Key *key, const char *base);

/* The elements of a list that has rows of its own, as one value: "[{sphere: {...}}, {...}]". What an element
   has by default is left out. */
void exact_list(const Key *list, const void *base, int dimensions, FILE *file);

#endif
