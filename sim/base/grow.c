#include "sim/base/grow.h"

#include <stdint.h>
#include <stdlib.h>

bool array_grow(void **array, size_t *capacity, size_t count, size_t width)
{
    if (count <= *capacity)
        return true;
    void *larger = count <= SIZE_MAX / width ? realloc(*array, count * width) : NULL;
    if (!larger)
        return false;
    *array = larger;
    *capacity = count;
    return true;
}
