/* Sums independent of the order of terms and of the distribution over threads. */
#include "tests/tolerance.h"

#include "sim/base/base.h"

enum { COUNT = 4096, PARTS = 7 };

/* Of 40 decades and both signs, the same on each machine. */
static double number(uint32_t k)
{
    const uint32_t mixed = k * 2654435761U;
    return (mixed & 1 ? -1 : 1) * (1 + (double)(mixed >> 8) / 16777216) * pow(10, (int)(k % 41) - 20);
}

static void add_all(ExactSum *sum, uint32_t first, uint32_t step)
{
    for (uint32_t k = first; k < COUNT; k += step)
        exact_add(sum, number(k));
}

static void check_bits(double is, double should)
{
    assert_memory_equal(&is, &should, sizeof is);
}

static void parts_add_up_to_the_same_bits(void **state)
{
    (void)state;
    ExactSum all = {.strange = false}, merged = {.strange = false}, back;
    int64_t words[EXACT_WORDS] = {0}, part_words[EXACT_WORDS];
    add_all(&all, 0, 1);
    for (uint32_t p = PARTS; p-- > 0;) { /* shares of ranks, the last one first */
        ExactSum part = {.strange = false};
        add_all(&part, p, PARTS);
        exact_merge(&merged, &part);
        exact_to_words(&part, part_words);
        for (int k = 0; k < EXACT_WORDS; k++)
            words[k] += part_words[k];
    }
    exact_from_words(words, &back);
    check_bits(exact_value(&merged), exact_value(&all));
    check_bits(exact_value(&back), exact_value(&all));
    assert_true(exact_value(&all) != 0);
}

static void what_cancels_leaves_the_rest(void **state)
{
    (void)state;
    ExactSum sum = {.strange = false};
    const double added[] = {1e30, 3.5, -1e-30, -1e30, 0, -0.0, 1e-30, -1.25};
    for (size_t k = 0; k < sizeof added / sizeof *added; k++)
        exact_add(&sum, added[k]);
    check_bits(exact_value(&sum), 2.25);
}

static void what_is_no_number_shows(void **state)
{
    (void)state;
    const double strange[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e60};
    for (size_t k = 0; k < sizeof strange / sizeof *strange; k++) {
        ExactSum sum = {.strange = false}, other = {.strange = false}, back;
        int64_t words[EXACT_WORDS];
        exact_add(&sum, 1);
        exact_add(&sum, strange[k]);
        assert_true(isnan(exact_value(&sum)));
        exact_merge(&other, &sum);
        assert_true(isnan(exact_value(&other)));
        exact_to_words(&sum, words);
        exact_from_words(words, &back);
        assert_true(isnan(exact_value(&back)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_add_up_to_the_same_bits),
        cmocka_unit_test(what_cancels_leaves_the_rest),
        cmocka_unit_test(what_is_no_number_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
