/* Growing arrays for reuse. */
#ifndef SIM_BASE_MEMORY_H
#define SIM_BASE_MEMORY_H

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

/* Settings with a type known only to the owner are stored in byte arrays: MethodDef, BackendDef,
 * ViewOwnSettings. */

/* For the struct of such settings: a store to the struct must not move past a copy of the byte array, which
   has a different type. gcc -O3 did so. */
#define MAY_ALIAS __attribute__((may_alias))

#endif
