/* Random numbers by counters against the published answers; functions of lanes against the C library;
 * normals. */
#include "tests/tolerance.h"

#include "sim/points/philox.h"
#include "sim/points/points.h"

#include <string.h>

/* J. Salmon et al., Random123 1.14, kat_vectors: philox4x32 10. */
static const struct {
    uint32_t counter[4], key[2], answer[4];
} known[] = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {{~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}, {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
     {0xa4093822, 0x299f31d0},
     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

static void philox_has_the_known_answers(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const PhiloxKey key = {{known[i].key[0], known[i].key[1]}};
        uint32_t word[4];
        u8 wide[4];
        for (int k = 0; k < 4; k++) {
            word[k] = known[i].counter[k];
            wide[k] = (u8){0} + word[k];
        }
        wide[0][3] += 1; /* a lane is a separate counter */
        philox(key, word);
        philox_lanes(key, wide);
        for (int k = 0; k < 4; k++) {
            assert_int_equal(word[k], known[i].answer[k]);
            assert_int_equal(wide[k][0], known[i].answer[k]);
            assert_int_equal(wide[k][7], known[i].answer[k]);
            assert_int_not_equal(wide[k][3], known[i].answer[k]);
        }
    }
}

static void functions_of_lanes_are_the_c_librarys(void **state)
{
    (void)state;
    for (int i = 1; i < 4000; i++) {
        f8 sine, cosine;
        const float x = (float)i / 4000, turns = (float)(i - 2000) / 300;
        const double angle = 2 * M_PI * (double)turns;
        check_near((double)f8_log(f8_splat(x))[i % LANES], log((double)x), 2e-7 * fmax(1, -log((double)x)),
                   "log");
        f8_sincos(f8_splat(turns), &sine, &cosine);
        check_near((double)sine[i % LANES], sin(angle), 2e-6,
                   "sine"); /* of a float's rounding of 6.7 turns */
        check_near((double)cosine[i % LANES], cos(angle), 2e-6, "cosine");
    }
    check_near((double)f8_log(f8_splat(0x1p-24F))[0], log(0x1p-24), 1e-6, "log");
}

/* Mean, variance and fourth moment of 2^19 numbers, within four standard errors of 0, 1, 3. */
static void noise_is_normal_and_white(void **state)
{
    (void)state;
    enum { BLOCKS = 1 << 15 };
    double mean[3] = {0}, square[3] = {0}, fourth[3] = {0}, mixed = 0, count = 8.0 * BLOCKS;
    for (uint32_t i = 0; i < BLOCKS; i++) {
        u8 word[4] = {(u8){0, 1, 2, 3, 4, 5, 6, 7} + 8 * i, {0}, {0}, {0}};
        f8 normal[3];
        philox_lanes(philox_key(1), word);
        philox_normal_lanes(word, normal);
        for (int lane = 0; lane < LANES; lane++)
            for (int k = 0; k < 3; k++) {
                const double x = (double)normal[k][lane];
                mean[k] += x / count;
                square[k] += x * x / count;
                fourth[k] += x * x * x * x / count;
                mixed += x * (double)normal[(k + 1) % 3][lane] / (3 * count);
            }
    }
    for (int k = 0; k < 3; k++) {
        check_near(mean[k], 0, 4 / sqrt(count), "mean");
        check_near(square[k], 1, 4 * sqrt(2 / count), "variance");
        check_near(fourth[k], 3, 4 * sqrt(96 / count), "fourth moment");
    }
    check_near(mixed, 0, 4 / sqrt(3 * count), "covariance");
}

static void packed_normals_come_back(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        const double z = 1 - (i + 0.5) / 10000, angle = 2.399963 * i, r = sqrt(1 - z * z);
        const float n[3] = {(float)(r * cos(angle)), (float)(r * sin(angle)), (float)z};
        float back[3];
        surface_normal_unpack(surface_normal_pack(n), back);
        const double off =
            hypot(hypot((double)(back[0] - n[0]), (double)(back[1] - n[1])), (double)(back[2] - n[2]));
        worst = fmax(worst, off);
    }
    check_near(worst, 0, 7e-5, "the worst normal"); /* 0.004 degrees */
    float up[3];
    surface_normal_unpack(surface_normal_pack((float[]){0, 0, 0}), up);
    check_vector((double[]){(double)up[0], (double)up[1], (double)up[2]}, 0, 0, 1, 0, "no normal");
}

static void points_that_do_not_fit_leave_all_as_it_was(void **state)
{
    (void)state;
    SurfacePoints points = {0};
    Error error = {{0}};
    assert_true(surface_points_reserve(&points, 2, &error));
    points.count = 1;
    points.point[0].surface = 4;
    assert_false(surface_points_reserve(&points, SIZE_MAX, &error));
    assert_non_null(strstr(error.message, "no memory"));
    assert_true(points.count == 1 && points.capacity == 2 && points.point[0].surface == 4);
    surface_points_free(&points);
    surface_points_free(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_has_the_known_answers),
        cmocka_unit_test(functions_of_lanes_are_the_c_librarys),
        cmocka_unit_test(noise_is_normal_and_white),
        cmocka_unit_test(packed_normals_come_back),
        cmocka_unit_test(points_that_do_not_fit_leave_all_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
