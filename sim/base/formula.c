#include "slosh/def.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Nesting of parentheses: deep enough for a text of FORMULA_SIZE, with a bounded stack. */
enum { DEPTH_MAX = 40, NAME_MAX_LETTERS = 8 };

/* Steps of the program: push a number, or pop operands and push the result. */
enum { NUMBER, VARIABLE, NEGATIVE, PLUS, MINUS, TIMES, OVER, POWER, FUNCTION_OF_ONE, FUNCTION_OF_TWO };

/* Recursive descent parser. */
typedef struct Reader {
    const char *text, *at, *names;
    Formula *formula;
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

static void sum_of(Reader *r);

static void wrong(Reader *r, const char *what)
{
    if (r->ok)
        error_set(r->error, "formula \"%s\": %s at letter %d", r->text, what, (int)(r->at - r->text) + 1);
    r->ok = false;
}

static void put(Reader *r, int what, size_t which, double number)
{
    Formula *f = r->formula;
    if (!r->ok)
        return;
    f->step[f->count].what = (uint8_t)what;
    f->step[f->count].which = (uint8_t)which;
    f->step[f->count++].number = number;
}

/* True if the next letter is `letter`; then skips the letter. */
static bool take(Reader *r, char letter)
{
    while (*r->at == ' ')
        r->at++;
    if (*r->at != letter)
        return false;
    r->at++;
    return true;
}

static void call(Reader *r, size_t function)
{
    const bool two = functions[function].two != NULL;
    if (!take(r, '(')) {
        wrong(r, "\"(\" is missing");
        return;
    }
    sum_of(r);
    if (r->ok && two) {
        if (!take(r, ','))
            wrong(r, "a second number is missing");
        else
            sum_of(r);
    }
    if (r->ok && !take(r, ')'))
        wrong(r, "\")\" is missing");
    put(r, two ? FUNCTION_OF_TWO : FUNCTION_OF_ONE, function, 0);
}

static void named(Reader *r)
{
    char name[NAME_MAX_LETTERS + 1] = {0};
    const char *begin = r->at;
    for (int i = 0; i < NAME_MAX_LETTERS && isalpha((unsigned char)*r->at); i++)
        name[i] = *r->at++;
    const char *variable = strlen(name) == 1 ? strchr(r->names, name[0]) : NULL;
    if (variable) {
        put(r, VARIABLE, (size_t)(variable - r->names), 0);
        return;
    }
    if (strcmp(name, "pi") == 0) {
        put(r, NUMBER, 0, M_PI);
        return;
    }
    for (size_t k = 0; k < sizeof functions / sizeof *functions; k++)
        if (strcmp(name, functions[k].name) == 0) {
            call(r, k);
            return;
        }
    r->at = begin;
    wrong(r, "no number, variable or function");
}

static void number(Reader *r)
{
    char *end;
    const double value = strtod(r->at, &end);
    if (end == r->at) {
        wrong(r, "no number");
        return;
    }
    r->at = end;
    put(r, NUMBER, 0, value);
}

static void single(Reader *r)
{
    if (++r->depth > DEPTH_MAX) {
        wrong(r, "too many parentheses");
        return;
    }
    if (take(r, '(')) {
        sum_of(r);
        if (r->ok && !take(r, ')'))
            wrong(r, "\")\" is missing");
    } else if (isdigit((unsigned char)*r->at) || *r->at == '.')
        number(r);
    else
        named(r);
    r->depth--;
}

/* -x^2 is -(x^2), 2^-1 is a half, and a^b^c is a^(b^c). */
static void power_of(Reader *r)
{
    if (r->depth > DEPTH_MAX) {
        wrong(r, "too many signs");
        return;
    }
    r->depth++;
    if (take(r, '-')) {
        power_of(r);
        put(r, NEGATIVE, 0, 0);
    } else if (take(r, '+'))
        power_of(r);
    else {
        single(r);
        if (r->ok && take(r, '^')) {
            power_of(r);
            put(r, POWER, 0, 0);
        }
    }
    r->depth--;
}

/* Operators of equal rank, left to right. */
static void chain(Reader *r, void (*part)(Reader *), const char letters[2], const int what[2])
{
    part(r);
    while (r->ok) {
        const int k = take(r, letters[0]) ? 0 : take(r, letters[1]) ? 1 : 2;
        if (k == 2)
            return;
        part(r);
        put(r, what[k], 0, 0);
    }
}

static void term_of(Reader *r)
{
    chain(r, power_of, (const char[2]){'*', '/'}, (const int[2]){TIMES, OVER});
}

static void sum_of(Reader *r)
{
    chain(r, term_of, (const char[2]){'+', '-'}, (const int[2]){PLUS, MINUS});
}

bool formula_given(const char *text)
{
    return text && text[0] && (text[0] != 'n' || strcmp(text, "none") != 0);
}

bool formula_read(const char *text, const char *names, Formula *formula, Error *error)
{
    Reader r = {.text = text, .at = text, .names = names, .formula = formula, .error = error, .ok = true};
    formula->count = 0;
    if (strlen(text) >= FORMULA_SIZE)
        return error_set(error, "formula \"%.20s...\": more than %d letters", text, FORMULA_SIZE - 1);
    sum_of(&r);
    if (r.ok && !take(&r, '\0'))
        wrong(&r, "an operator or the end is missing");
    return r.ok;
}

static double of_two(int what, size_t function, double a, double b)
{
    switch (what) {
    case PLUS:
        return a + b;
    case MINUS:
        return a - b;
    case TIMES:
        return a * b;
    case OVER:
        return a / b;
    case POWER:
        return pow(a, b);
    default:
        return functions[function].two(a, b);
    }
}

double formula_value(const Formula *formula, const double *values)
{
    double stack[FORMULA_SIZE / 2] = {0}, *top = stack; /* a letter separates any two numbers */
    for (int k = 0; k < formula->count; k++) {
        const int what = formula->step[k].what;
        const size_t which = formula->step[k].which;
        if (what == NUMBER)
            *top++ = formula->step[k].number;
        else if (what == VARIABLE)
            *top++ = values[which];
        else if (what == NEGATIVE)
            top[-1] = -top[-1];
        else if (what == FUNCTION_OF_ONE)
            top[-1] = functions[which].one(top[-1]);
        else {
            top--;
            top[-1] = of_two(what, which, top[-1], *top);
        }
    }
    return stack[0];
}
