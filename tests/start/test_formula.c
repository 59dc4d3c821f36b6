/* Formulas of a scene: values, and what is said of what can't be read. */
#include "tests/sim/fixture.h"

#include "sim/def.h"

static const double at[] = {2, 3, 5};

static void values(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } list[] = {
        {"1", 1},
        {"x + y * z", 17},
        {"(x + y) * z", 25},
        {"-x^2", -4},
        {"2^-1", 0.5},
        {"2^3^2", 512},
        {"8 / 2 / 2", 2},
        {"1 - 2 - 3", -4},
        {"1e-3*x", 0.002},
        {"min(x, y) * 2", 4},
        {"max(x, y)", 3},
        {" abs( -z ) ", 5},
        {"cos(pi)", -1},
        {"sqrt(x^2 + 0)", 2},
        {"--x", 2},
        {"exp(log(z))", 5},
        {"sinh(0)+cosh(0)", 1},
        {"tanh(0) - tan(0) + sin(0)", 0},
        {".5+.5", 1},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        Error error = {{0}};
        Formula formula;
        if (!formula_read(list[i].text, "xyz", &formula, &error))
            fail_msg("%s", error.message);
        assert_float_equal(formula_value(&formula, at), list[i].value, 1e-12);
    }
}

static void what_is_none(void **state)
{
    (void)state;
    static const char *const list[][2] = {
        {"", "letter 1"},           {"x +", "letter 4"},
        {"(x", "\")\" is missing"}, {"sin x", "\"(\" is missing"},
        {"min(x)", "second"},       {"x y", "the end"},
        {"w", "no number"},         {"x)", "the end"},
        {"1..2", "the end"},        {"sinus(x)", "no number"},
        {"y", "no number"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        Error error = {{0}};
        Formula formula;
        if (formula_read(list[i][0], "xz", &formula, &error) || !strstr(error.message, list[i][1]))
            fail_msg("\"%s\": %s", list[i][0], error.message);
    }
}

/* As deep as a text may be; as many steps; a letter too long. */
static void no_text_is_too_deep(void **state)
{
    (void)state;
    char text[FORMULA_SIZE + 1] = {0};
    Error error;
    Formula formula;
    memset(text, '(', FORMULA_SIZE - 1);
    assert_false(formula_read(text, "x", &formula, &error));
    memset(text, '-', FORMULA_SIZE - 1);
    assert_false(formula_read(text, "x", &formula, &error));
    for (int k = 0; k < FORMULA_SIZE - 1; k++)
        text[k] = k % 2 ? '+' : 'x';
    assert_true(formula_read(text, "x", &formula, &error));
    assert_int_equal(formula.count, FORMULA_SIZE - 1);
    assert_float_equal(formula_value(&formula, at), 2 * (FORMULA_SIZE / 2), 0);
    text[FORMULA_SIZE - 1] = '+';
    assert_false(formula_read(text, "x", &formula, &error));
    assert_non_null(strstr(error.message, "more than 95 letters"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),
        cmocka_unit_test(what_is_none),
        cmocka_unit_test(no_text_is_too_deep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
