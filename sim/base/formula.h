/* A formula in a scene: numbers, the names of variables, pi, + - * / ^, parentheses, and the functions sin
   cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b). "0.1 * cos(pi * x / 0.5)". */
#ifndef SLOSH_FORMULA_H
#define SLOSH_FORMULA_H

#include "sim/base/error.h"

#include <stdint.h>

enum { FORMULA_SIZE = 96 }; /* of its text, with the 0 at its end */

/* A formula as a program for a stack of numbers: no step is without a letter of its own in the text. */
typedef struct Formula {
    int count;
    struct {
        uint8_t what, which; /* of the names or functions */
        double number;
    } step[FORMULA_SIZE];
} Formula;

/* Reads a text; `names` has a letter for each variable, "xyz". False with the reason, which says where. */
bool formula_read(const char *text, const char *names, Formula *formula, Error *error);

/* Its value where the variables have these. */
double formula_value(const Formula *formula, const double *values);

/* Whether there is one: neither "" nor "none". */
bool formula_given(const char *text);

#endif
