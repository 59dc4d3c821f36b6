/* The range of a scalar, against sorting in plain C. */
#include "tests/render/fixture.h"

#include "render/particles/particles.h"

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
        return (ScalarRange){.known = true};
    qsort(sorted, known, sizeof *sorted, ascending);
    const size_t open = (known - 1) / 100;
    ScalarRange range = {sorted[open], sorted[known - 1 - open], sorted[0], sorted[known - 1], true, true};
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
        is.greatest != wanted.greatest || !is.known || is.any != wanted.any)
        fail_msg("%s: %g %g %g %g, not %g %g %g %g", what, is.least, is.low, is.high, is.greatest,
                 wanted.least, wanted.low, wanted.high, wanted.greatest);
}

/* A range read without waiting is the same a picture later, for a redrawn state too; only the first read
   waits, and no range is requested twice. */
static void what_is_late_is_the_same(void **state)
{
    (void)state;
    enum { STATES = 6, COUNT = 5000 };
    static float values[COUNT];
    Ranges ranges = {0};
    Error error = {0};
    ScalarRange before = {0};
    GLuint buffer;
    assert_true(ranges_create(&ranges, &error));
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, sizeof values, NULL, GL_DYNAMIC_STORAGE_BIT);
    ParticleBuffers particles = {.count = COUNT};
    particles.scalar[SCALAR_PRESSURE] = (ParticleAttribute){buffer, 0, 4};
    for (int k = 0; k < STATES; k++) {
        bool behind = false;
        for (int i = 0; i < COUNT; i++)
            values[i] = (float)((i * 7919 % COUNT) * (k + 1) - 100 * k);
        glNamedBufferSubData(buffer, 0, sizeof values, values);
        particles.step = (uint64_t)k;
        const ScalarRange now = by_sorting(values, COUNT),
                          late = ranges_find_async(&ranges, SCALAR_PRESSURE, &particles, &behind);
        const ScalarRange *shown = behind ? &before : &now;
        assert_memory_equal(&late, shown, 4 * sizeof(double));
        assert_int_equal(behind, k > 0);
        glFinish();
        for (int again = 0; again < 2; again++) { /* no motion */
            behind = false;
            const ScalarRange settled = ranges_find_async(&ranges, SCALAR_PRESSURE, &particles, &behind);
            assert_false(behind);
            assert_null(ranges.late[SCALAR_PRESSURE].found.fence);
            assert_memory_equal(&settled, &now, 4 * sizeof(double));
        }
        const ScalarRange waited = ranges_find(&ranges, &particles.scalar[SCALAR_PRESSURE], COUNT);
        assert_memory_equal(&waited, &now, 4 * sizeof(double));
        before = now;
    }
    bool behind = false;
    particles.count = 0;
    assert_true(ranges_find_async(&ranges, SCALAR_PRESSURE, &particles, &behind).known && !behind);
    glDeleteBuffers(1, &buffer);
    ranges_destroy(&ranges);
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

/* ---- in a picture ---- */

enum { WIDE = 320, HIGH = 240 };

/* Draws particles with speeds 0 .. 1, except `spike` for two of a thousand. */
static uint8_t *picture_of(const char *range, double spike, double found[2])
{
    Error error = {0};
    ViewDef def = view_def_default();
    ParticleBuffers buffers, state = box_state(1000, 0.05);
    Particles *particles = calloc(1, sizeof *particles);
    uint8_t *rgb = calloc(1, (size_t)3 * WIDE * HIGH);
    assert_true(particles && rgb);
    for (int i = 0; i < 1000; i++)
        particles_add(particles, 0.001 * i, 0.5, 0, i < 2 ? spike : i / 999.0, 0);
    snprintf(def.colormap, sizeof def.colormap, "viridis");
    def.range_symmetric = strcmp(range, "symmetric") == 0;
    def.range_auto = strcmp(range, "fixed") != 0;
    def.range[1] = 2;
    Upload *upload = upload_particles(particles, &state, &buffers);
    Renderer *renderer = renderer_create(&def, NULL, WIDE, HIGH, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_range(renderer, found);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
    return rgb;
}

static void a_picture_has_the_range_of_most(void **state)
{
    (void)state;
    double found[2];
    free(picture_of("auto", 1e6, found));
    assert_true(fabs(found[0] - 9 / 999.0 - 2 / 999.0) < 1e-6 && fabs(found[1] - 992 / 999.0) < 1e-6);
    free(picture_of("symmetric", -1e6, found));
    assert_true(fabs(found[1] - 989 / 999.0) < 2e-3 && found[0] == -found[1]);
    free(picture_of("fixed", 1e6, found));
    assert_true(found[0] == 0 && found[1] == 2);
}

/* Values already in the state stay: so several pictures have a common range. */
static void a_range_may_be_given(void **state)
{
    (void)state;
    Error error = {0};
    double found[2];
    const ViewDef def = view_def_default();
    ParticleBuffers buffers, box = box_state(3, 0.05);
    Particles *particles = calloc(1, sizeof *particles);
    assert_non_null(particles);
    for (int i = 0; i < 3; i++)
        particles_add(particles, 0.1 * i, 0.5, 0, i, 0);
    Upload *upload = upload_particles(particles, &box, &buffers);
    Renderer *renderer = renderer_create(&def, NULL, WIDE, HIGH, &error);
    assert_non_null(renderer);
    renderer_derive(renderer, &buffers);
    assert_true(buffers.range[SCALAR_SPEED].known && buffers.range[SCALAR_SPEED].high == 2);
    buffers.range[SCALAR_SPEED].high = 5;
    renderer_draw(renderer, &buffers, NULL);
    renderer_range(renderer, found);
    assert_true(found[0] == 0 && found[1] == 5);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
}

/* Yellow of viridis above the bar, violet below it, in the legend's panel. */
static int tips(const uint8_t *rgb, int from, int to)
{
    const int em = 11;
    int found = 0;
    for (int y = from * em / 10; y < to * em / 10; y++)
        for (int x = WIDE - 9 * em; x < WIDE - em; x++) {
            const uint8_t *at = rgb + 3 * (y * WIDE + x);
            const bool yellow = at[0] > 230 && at[1] > 210 && at[2] < 90, violet = at[1] < 30 && at[2] > 60;
            found += yellow || violet;
        }
    return found;
}

/* The bar is from 4 to 15 letters' heights below the top (render/frame/legend.c). */
static void the_legend_says_that_some_are_beyond(void **state)
{
    (void)state;
    double found[2];
    static const char *const ranges[] = {"auto", "symmetric", "fixed"};
    for (int k = 0; k < 3; k++) {
        uint8_t *rgb = picture_of(ranges[k], 1e6, found);
        const int above = tips(rgb, 32, 39), below = tips(rgb, 152, 158);
        assert_true((above > 10) == (k < 2) && (below > 10) == (k == 0));
        free(rgb);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_is_late_is_the_same, no_gl_errors),
        cmocka_unit_test_teardown(ranges_are_percentiles, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_has_the_range_of_most, no_gl_errors),
        cmocka_unit_test_teardown(a_range_may_be_given, no_gl_errors),
        cmocka_unit_test_teardown(the_legend_says_that_some_are_beyond, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
