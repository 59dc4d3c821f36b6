#include "sim/base/scalar.h"

#include <string.h>

static const struct {
    const char *name, *unit;
} scalars[] = {
#define X(NAME, name, unit) {name, unit},
    SCALAR_LIST(X)
#undef X
};

const char *scalar_name(Scalar scalar)
{
    return scalars[scalar].name;
}

const char *scalar_unit(Scalar scalar)
{
    return scalars[scalar].unit;
}

Scalar scalar_find(const char *name)
{
    for (int i = 0; i < SCALAR_COUNT; i++)
        if (strcmp(scalars[i].name, name) == 0)
            return (Scalar)i;
    return SCALAR_COUNT;
}
