/* The images of a group of particles in the walls, found by lanes, against those of each particle. */
#include "tests/sim/fixture.h"

#include "sim/cpu/pair_loop.h"

static void lanes_have_the_images_of_each(void **state)
{
    (void)state;
    enum { COUNT = 64 * LANES };
    static float x[3][COUNT + LANES];
    static Constants s;
    const bool open[3] = {false, false, false};
    s.support_radius = 0.21F;
    walls_place(&s.walls, 3, (double[]){1, 0.8, 0.3}, open, 0.1); /* some see both walls across z */
    for (uint32_t i = 0, seed = 7; i < COUNT; i++)
        for (int k = 0; k < 3; k++) {
            seed = seed * 1664525u + 1013904223u;
            const float size = 2 * s.walls.half_size[k], part = (float)(seed >> 8) * 0x1p-24F;
            x[k][i] = part * size - (k == 1 ? 0 : 0.5F * size);
        }
    const PairArgs args = {.constants = &s, .count = COUNT, .x = x[0], .y = x[1], .z = x[2]};
    const WallsFar far = out_of_sight(&s);
    size_t found = 0;
    for (size_t i = 0; i < COUNT; i += LANES) {
        LaneImages images;
        images_of(&args, &far, i, 0, COUNT, &images);
        for (size_t lane = 0; lane < LANES; lane++) {
            WallImage one[IMAGES_MAX];
            const size_t at = i + lane;
            const int count =
                wall_images(&s.walls, (float[]){x[0][at], x[1][at], x[2][at]}, s.support_radius, one);
            int next = 1;
            for (int m = 1; m <= images.count; m++) {
                const ImageParticle *image = &images.of[m];
                if (image->sign.x[lane] == 0)
                    continue;
                assert_true(next < count);
                assert_true(image->at.x[lane] == one[next].x[0] && image->at.y[lane] == one[next].x[1] &&
                            image->at.z[lane] == one[next].x[2]);
                assert_true(image->sign.x[lane] == one[next].sign[0] &&
                            image->sign.y[lane] == one[next].sign[1] &&
                            image->sign.z[lane] == one[next].sign[2]);
                next++;
            }
            assert_int_equal(next, count);
            found += (size_t)(count - 1);
        }
    }
    assert_true(found > COUNT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lanes_have_the_images_of_each)};
    return cmocka_run_group_tests_name("dfsph.images", tests, NULL, NULL);
}
