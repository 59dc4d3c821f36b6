#include "sim/base/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of parentheses within each other: deep enough for a text of FORMULA_SIZE, and the stack is bounded. */
enum { DEPTH_MAX = 40, NAME_MAX_LETTERS = 8 };

/* By recursive descent: a value is found while the text is read. */
typedef struct Reader {
    const char *text, *at, *names;
    const double *values;
    int depth;
    Error *error;
    bool ok;
} Reader;

typedef struct Function {
    const char *name;
    double (*one)(double);
    double (*two)(double, double);
} Function;

static const Function functions[] = {
    {"sin", sin, NULL},   {"cos", cos, NULL},   {"tan", tan, NULL},  {"exp", exp, NULL},
    {"log", log, NULL},   {"sqrt", sqrt, NULL}, {"abs", fabs, NULL}, {"tanh", tanh, NULL},
    {"sinh", sinh, NULL}, {"cosh", cosh, NULL}, {"min", NULL, fmin}, {"max", NULL, fmax},
};

static double sum_of(Reader *r);

static double wrong(Reader *r, const char *what)
{
    if (r->ok)
        error_set(r->error, "formula \"%s\": %s at letter %d", r->text, what, (int)(r->at - r->text) + 1);
    r->ok = false;
    return 0;
}

/* Whether the next letter is that one, and then behind it. */
static bool take(Reader *r, char letter)
{
    while (*r->at == ' ')
        r->at++;
    if (*r->at != letter)
        return false;
    r->at++;
    return true;
}

static double call(Reader *r, const Function *function)
{
    if (!take(r, '('))
        return wrong(r, "\"(\" is missing");
    const double a = sum_of(r);
    if (r->ok && function->two && !take(r, ','))
        return wrong(r, "a second number is missing");
    const double b = function->two && r->ok ? sum_of(r) : 0;
    if (r->ok && !take(r, ')'))
        return wrong(r, "\")\" is missing");
    return function->two ? function->two(a, b) : function->one(a);
}

static double named(Reader *r)
{
    char name[NAME_MAX_LETTERS + 1] = {0};
    const char *begin = r->at;
    for (int i = 0; i < NAME_MAX_LETTERS && isalpha((unsigned char)*r->at); i++)
        name[i] = *r->at++;
    const char *variable = strlen(name) == 1 ? strchr(r->names, name[0]) : NULL;
    if (variable)
        return r->values[variable - r->names];
    if (strcmp(name, "pi") == 0)
        return M_PI;
    for (size_t k = 0; k < sizeof functions / sizeof *functions; k++)
        if (strcmp(name, functions[k].name) == 0)
            return call(r, &functions[k]);
    r->at = begin;
    return wrong(r, "no number, variable or function");
}

static double single(Reader *r)
{
    double value = 0;
    if (++r->depth > DEPTH_MAX)
        return wrong(r, "too many parentheses");
    if (take(r, '(')) {
        value = sum_of(r);
        if (r->ok && !take(r, ')'))
            return wrong(r, "\")\" is missing");
    } else if (isdigit((unsigned char)*r->at) || *r->at == '.') {
        char *end;
        value = strtod(r->at, &end);
        if (end == r->at)
            return wrong(r, "no number");
        r->at = end;
    } else {
        value = named(r);
    }
    r->depth--;
    return value;
}

/* -x^2 is -(x^2), 2^-1 is a half, and a^b^c is a^(b^c). */
static double power_of(Reader *r)
{
    if (r->depth > DEPTH_MAX)
        return wrong(r, "too many signs");
    r->depth++;
    double value;
    if (take(r, '-'))
        value = -power_of(r);
    else if (take(r, '+'))
        value = power_of(r);
    else {
        value = single(r);
        if (r->ok && take(r, '^'))
            value = pow(value, power_of(r));
    }
    r->depth--;
    return value;
}

static double term_of(Reader *r)
{
    double value = power_of(r);
    while (r->ok)
        if (take(r, '*'))
            value *= power_of(r);
        else if (take(r, '/'))
            value /= power_of(r);
        else
            break;
    return value;
}

static double sum_of(Reader *r)
{
    double value = term_of(r);
    while (r->ok)
        if (take(r, '+'))
            value += term_of(r);
        else if (take(r, '-'))
            value -= term_of(r);
        else
            break;
    return value;
}

bool formula_given(const char *text)
{
    return text[0] && strcmp(text, "none") != 0;
}

bool formula_value(const char *text, const char *names, const double *values, double *value, Error *error)
{
    Reader r = {.text = text, .at = text, .names = names, .values = values, .error = error, .ok = true};
    *value = sum_of(&r);
    if (r.ok && !take(&r, '\0'))
        wrong(&r, "an operator or the end is missing");
    return r.ok;
}

bool formula_check(const char *text, const char *names, Error *error)
{
    const double values[8] = {0};
    double value;
    return formula_value(text, names, values, &value, error);
}
