#include "sim/base/scalar.h"

#include <stddef.h>

const ScalarRow scalar_list[] = {
#define X(NAME, name, unit) {name, unit},
    SCALAR_LIST(X)
#undef X
        {NULL, NULL}};

const char *scalar_name(Scalar scalar)
{
    return scalar_list[scalar].name;
}

const char *scalar_unit(Scalar scalar)
{
    return scalar_list[scalar].unit;
}
