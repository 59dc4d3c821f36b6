#include "sim/base/scalar.h"

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
