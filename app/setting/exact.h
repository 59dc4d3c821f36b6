/* Values of a scene as text that reads back as the same bits. */
#ifndef SLOSH_EXACT_H
#define SLOSH_EXACT_H

#include "sim/base/file_name.h"
#include "sim/base/key.h"

#include <stdio.h>

enum { EXACT_SIZE = 2 * FILE_NAME_SIZE + 2 }; /* in quotes, with any letter escaped */

/* Like key_value_text, but numbers with all significant digits. `dimensions`: of the scene. */
void exact_text(const Key *key, const void *base, int dimensions, char *text, size_t size);

/* True if the struct at `base` has the mapping or the variant. */
bool exact_is_there(const Key *key, const char *base);

/* Prints the elements of a list with rows of its own as one value: "[{sphere: {...}}, {...}]". Default values
   of an element are left out. */
void exact_list(const Key *list, const void *base, int dimensions, FILE *file);

#endif
