#include "sim/base/scalar.h"

#include <stddef.h>

#define X(NAME, name, unit) {name, unit},
const ScalarRow scalar_list[] = {SCALAR_LIST(X){NULL, NULL}};
const ScalarRow vector_list[] = {VECTOR_LIST(X){NULL, NULL}};
#undef X

const char *scalar_name(Scalar scalar)
{
    return scalar_list[scalar].name;
}

const char *scalar_unit(Scalar scalar)
{
    return scalar_list[scalar].unit;
}
