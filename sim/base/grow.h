/* Growing arrays for reuse. */
#ifndef SLOSH_GROW_H
#define SLOSH_GROW_H

#include <stdbool.h>
#include <stdlib.h>

/* Makes room for `count` items of `width` bytes in the caller's array, which is from realloc or NULL. Keeps
   the contents. `*capacity`: room in items. Returns false if memory is short, with nothing changed. Inline,
   so that a static analyser sees that the array exists if the result is true. */
static inline bool array_grow(void **array, size_t *capacity, size_t count, size_t width)
{
    if (count <= *capacity)
        return true;
    void *larger = realloc(*array, count * width);
    if (!larger)
        return false;
    *array = larger;
    *capacity = count;
    return true;
}

#endif
