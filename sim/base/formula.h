/* A formula in a scene: numbers, the names of variables, pi, + - * / ^, parentheses, and the functions sin
   cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b). "0.1 * cos(pi * x / 0.5)". */
#ifndef SLOSH_FORMULA_H
#define SLOSH_FORMULA_H

#include "sim/base/error.h"

#include <stdint.h>

enum { FORMULA_SIZE = 96 }; /* size of the text, with the final 0 */

/* A formula as a program for a stack machine. Each step comes from at least a letter of the text. */
typedef struct Formula {
    int count;
    struct {
        uint8_t what, which; /* index of the name or function */
        double number;
    } step[FORMULA_SIZE];
} Formula;

/* Parses a text; `names` has a letter per variable, such as "xyz". Returns false with the reason and its
   position. */
bool formula_read(const char *text, const char *names, Formula *formula, Error *error);

/* The value for the given values of the variables. */
double formula_value(const Formula *formula, const double *values);

/* True if the text is neither "" nor "none". */
bool formula_given(const char *text);

#endif
