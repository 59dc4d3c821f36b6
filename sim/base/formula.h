/* A formula in a scene: numbers, the names of variables, pi, + - * / ^, parentheses, and the functions sin
   cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b). "0.1 * cos(pi * x / 0.5)". */
#ifndef SLOSH_FORMULA_H
#define SLOSH_FORMULA_H

#include "sim/base/error.h"

enum { FORMULA_SIZE = 96 }; /* of its text, with the 0 at its end */

/* Its value; `names` has a letter for each variable, "xyz". False with the reason, which says where. */
bool formula_value(const char *text, const char *names, const double *values, double *value, Error *error);

/* Whether there is one: neither "" nor "none". */
bool formula_given(const char *text);

/* Whether it can be read. */
bool formula_check(const char *text, const char *names, Error *error);

#endif
