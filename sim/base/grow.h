/* Arrays that are reused and become longer when they must. */
#ifndef SLOSH_GROW_H
#define SLOSH_GROW_H

#include <stdbool.h>
#include <stdlib.h>

/* Makes room for `count` items of `width` bytes in the caller's array, which realloc made or which is NULL.
   What it held stays. `*capacity` is how many there is room for; false where memory is short: then all is as
   it was. Inline: an analyser then sees that there is an array behind true. */
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
