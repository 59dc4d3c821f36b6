/* The range of a scalar, against sorting in plain C. */
#include "tests/render/fixture.h"

#include "render/derived/ranges.h"

enum { ALL = 100000 };

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static ScalarRange by_sorting(const float *values, size_t count)
{
    static float sorted[ALL];
    size_t known = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            sorted[known++] = values[i];
    if (known == 0)
        return (ScalarRange){0, 0, 0, 0};
    qsort(sorted, known, sizeof *sorted, ascending);
    const size_t open = (known - 1) / 100;
    ScalarRange range = {sorted[open], sorted[known - 1 - open], sorted[0], sorted[known - 1]};
    if (!(range.low < range.high))
        range.low = range.least, range.high = range.greatest;
    return range;
}

static void check(Ranges *ranges, const char *what, const float *values, size_t count)
{
    enum { OFFSET = 512 };
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, OFFSET + ALL * 4, NULL, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(buffer, OFFSET, (GLsizeiptr)(count * 4), values);
    const ParticleAttribute attribute = {buffer, OFFSET, 4};
    const ScalarRange is = ranges_find(ranges, &attribute, count), wanted = by_sorting(values, count);
    glDeleteBuffers(1, &buffer);
    if (is.low != wanted.low || is.high != wanted.high || is.least != wanted.least ||
        is.greatest != wanted.greatest)
        fail_msg("%s: %g %g %g %g, not %g %g %g %g", what, is.least, is.low, is.high, is.greatest,
                 wanted.least, wanted.low, wanted.high, wanted.greatest);
}

static void ranges_are_percentiles(void **state)
{
    (void)state;
    static float values[ALL];
    unsigned seed = 5;
    Ranges ranges = {0};
    Error error = {0};
    assert_true(ranges_create(&ranges, &error));
    for (size_t i = 0; i < ALL; i++)
        values[i] = (float)((double)(seed = seed * 1664525 + 1013904223) / 4e9 - 0.3);
    check(&ranges, "even", values, ALL);
    for (size_t count = 1; count <= 700; count += count < 5 || (count > 98 && count < 103) ? 1 : 47)
        check(&ranges, "few", values, count);
    check(&ranges, "none", values, 0);
    values[17] = 1e30F, values[4711] = -1e30F, values[5] = NAN, values[6] = INFINITY, values[7] = -INFINITY;
    check(&ranges, "spikes", values, ALL);
    for (size_t i = 0; i < ALL; i++)
        values[i] = i % 200 ? 2.5F : 3;
    check(&ranges, "nearly the same", values, ALL);
    for (size_t i = 0; i < ALL; i++)
        values[i] = i % 3 ? -0.0F : 0.0F;
    values[1] = -1e-38F;
    check(&ranges, "zeros", values, 2);
    for (size_t i = 0; i < ALL; i++)
        values[i] = -7;
    check(&ranges, "the same", values, ALL);
    for (size_t i = 0; i < ALL; i++)
        values[i] = NAN;
    check(&ranges, "no number", values, ALL);
    ranges_destroy(&ranges);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(ranges_are_percentiles, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
