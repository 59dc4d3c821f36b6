#include "sim/base/formula.h"

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

/* ---- derivatives: automatic differentiation, forwards. After: L. B. Rall, "Automatic differentiation:
   techniques and applications", 1981 ---- */

static const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

/* g(a) with the value, the first and the second derivative of g there. */
static void compose(FormulaJet *a, double value, double first, double second)
{
    for (int p = 0; p < 6; p++)
        a->bend[p] = first * a->bend[p] + second * a->slope[pairs[p][0]] * a->slope[pairs[p][1]];
    for (int k = 0; k < 3; k++)
        a->slope[k] *= first;
    a->value = value;
}

static void add_times(FormulaJet *a, double times, const FormulaJet *b)
{
    a->value += times * b->value;
    for (int k = 0; k < 3; k++)
        a->slope[k] += times * b->slope[k];
    for (int p = 0; p < 6; p++)
        a->bend[p] += times * b->bend[p];
}

static void multiply(FormulaJet *a, const FormulaJet *b)
{
    FormulaJet out = {.value = a->value * b->value};
    for (int k = 0; k < 3; k++)
        out.slope[k] = a->value * b->slope[k] + b->value * a->slope[k];
    for (int p = 0; p < 6; p++) {
        const int i = pairs[p][0], j = pairs[p][1];
        out.bend[p] = a->value * b->bend[p] + b->value * a->bend[p] + a->slope[i] * b->slope[j] +
                      a->slope[j] * b->slope[i];
    }
    *a = out;
}

static bool is_constant(const FormulaJet *a)
{
    return a->slope[0] == 0 && a->slope[1] == 0 && a->slope[2] == 0;
}

/* A constant exponent takes numbers below 0 too. */
static void raise_to(FormulaJet *a, const FormulaJet *b)
{
    const double x = a->value, n = b->value;
    if (is_constant(b) && n == 2)
        compose(a, x * x, 2 * x, 2);
    else if (is_constant(b) && n == 3)
        compose(a, x * x * x, 3 * x * x, 6 * x);
    else if (is_constant(b))
        compose(a, pow(x, n), n == 0 ? 0 : n * pow(x, n - 1),
                n == 0 || n == 1 ? 0 : n * (n - 1) * pow(x, n - 2));
    else {
        compose(a, log(x), 1 / x, -1 / (x * x));
        multiply(a, b);
        const double value = exp(a->value);
        compose(a, value, value, value);
    }
}

/* First and second derivative at x; y: the value. */
static void slopes_of(double (*one)(double), double x, double y, double *first, double *second)
{
    *second = 0;
    if (one == sin)
        *first = cos(x), *second = -y;
    else if (one == cos)
        *first = -sin(x), *second = -y;
    else if (one == tan)
        *first = 1 + y * y, *second = 2 * y * *first;
    else if (one == exp)
        *first = *second = y;
    else if (one == log)
        *first = 1 / x, *second = -*first * *first;
    else if (one == sqrt)
        *first = 0.5 / y, *second = -0.5 * *first / x;
    else if (one == tanh)
        *first = 1 - y * y, *second = -2 * y * *first;
    else if (one == sinh)
        *first = cosh(x), *second = y;
    else if (one == cosh)
        *first = sinh(x), *second = y;
    else /* fabs */
        *first = x < 0 ? -1 : 1;
}

static void combine(int what, size_t function, FormulaJet *a, FormulaJet *b)
{
    const double x = b->value;
    if (what == PLUS || what == MINUS)
        add_times(a, what == PLUS ? 1 : -1, b);
    else if (what == POWER)
        raise_to(a, b);
    else if (what == FUNCTION_OF_TWO)
        *a = functions[function].two(a->value, x) == a->value ? *a : *b; /* min, max */
    else {
        if (what == OVER)
            compose(b, 1 / x, -1 / (x * x), 2 / (x * x * x));
        multiply(a, b);
    }
}

void formula_jet(const Formula *formula, const double place[3], FormulaJet *out)
{
    FormulaJet stack[FORMULA_SIZE / 2] = {{0}}, *top = stack;
    for (int k = 0; k < formula->count; k++) {
        const int what = formula->step[k].what;
        const size_t which = formula->step[k].which;
        if (what == NUMBER || what == VARIABLE) {
            *top = (FormulaJet){.value = what == NUMBER ? formula->step[k].number : place[which]};
            top->slope[which] = what == VARIABLE;
            top++;
        } else if (what == NEGATIVE)
            compose(top - 1, -top[-1].value, -1, 0);
        else if (what == FUNCTION_OF_ONE) {
            double (*one)(double) = functions[which].one;
            const double x = top[-1].value, y = one(x);
            double first, second;
            slopes_of(one, x, y, &first, &second);
            compose(top - 1, y, first, second);
        } else {
            top--;
            combine(what, which, top - 1, top);
        }
    }
    *out = stack[0];
}
