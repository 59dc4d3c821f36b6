/* Between two states: free fall exactly, whatever the order; what comes and goes; sides; the box. */
#include "tests/sim/fixture.h"

#include "app/run/playback/playback.h"

enum { COUNT = 5 };

static const bool closed[3] = {false, false, false};

/* COUNT particles in free fall, `time` s after the throw; ids in reverse order if `turned`. */
static void thrown(StateCopy *still, double time, bool turned)
{
    assert_true(state_copy_reserve(still, COUNT, PARTICLE_SCALAR(SCALAR_DENSITY)));
    still->state = (ParticleBuffers){.count = COUNT, .box_size = {2, 8, 2}, .time = time};
    for (size_t i = 0; i < COUNT; i++) {
        const size_t at = turned ? COUNT - 1 - i : i;
        float *x = still->arrays.position + 4 * at, *v = still->arrays.velocity + 4 * at;
        x[0] = (float)(0.1 * (double)i + 0.3 * time);
        x[1] = (float)(5 - 0.5 * 9.81 * time * time);
        x[2] = x[3] = v[2] = v[3] = 0;
        v[0] = 0.3F;
        v[1] = (float)(-9.81 * time);
        still->arrays.id[at] = (uint32_t)i;
        still->arrays.fluid[at] = (uint32_t)i % 2;
        still->arrays.scalar[SCALAR_DENSITY][at] = (float)(1000 + 100 * time);
    }
    still->state.box.orientation[3] = 1;
    still->state.box.position[0] = 0.5 * 4 * time * time;
    still->state.box.velocity[0] = 4 * time;
    still->state.floating[1] = still->state.box;
}

static void free_fall_is_exact(void **state)
{
    (void)state;
    StateCopy before = {.capacity = 0}, after = {.capacity = 0}, out = {.capacity = 0},
              exact = {.capacity = 0};
    thrown(&before, 0.2, false);
    thrown(&after, 0.24, true);
    assert_true(state_copy_reserve(&out, 2 * COUNT, PARTICLE_SCALAR(SCALAR_DENSITY)));
    for (int k = 0; k <= 4; k++) {
        const double time = 0.2 + 0.01 * k;
        thrown(&exact, time, true);
        assert_true(interpolate_states(&before, &after, closed, time, &out));
        assert_int_equal(out.state.count, COUNT);
        assert_float_equal(out.state.time, time, 1e-12);
        assert_float_equal(out.state.box.position[0], exact.state.box.position[0], 1e-12);
        assert_float_equal(out.state.floating[1].position[0], exact.state.floating[1].position[0], 1e-12);
        assert_memory_equal(&out.state.floating[0], &exact.state.floating[0], sizeof(BoxState)); /* no pose */
        for (size_t i = 0; i < COUNT; i++) {
            assert_int_equal(out.arrays.id[i], exact.arrays.id[i]);
            assert_int_equal(out.arrays.fluid[i], exact.arrays.fluid[i]);
            assert_float_equal(out.arrays.scalar[SCALAR_DENSITY][i], 1000 + 100 * time, 1e-3);
            for (size_t a = 0; a < 3; a++) {
                assert_float_equal(out.arrays.position[4 * i + a], exact.arrays.position[4 * i + a], 2e-6);
                assert_float_equal(out.arrays.velocity[4 * i + a], exact.arrays.velocity[4 * i + a], 2e-6);
            }
        }
    }
    state_copy_free(&before);
    state_copy_free(&after);
    state_copy_free(&out);
    state_copy_free(&exact);
}

/* A particle is drained, a second emitted, a third crosses a periodic side. */
static void what_comes_goes_and_crosses(void **state)
{
    (void)state;
    static const bool periodic[3] = {true, false, false};
    StateCopy before = {.capacity = 0}, after = {.capacity = 0}, out = {.capacity = 0};
    thrown(&before, 0, false);
    thrown(&after, 0.1, false);
    assert_true(state_copy_reserve(&out, 2 * COUNT, 0));
    before.arrays.id[0] = 77; /* no more there afterwards */
    after.arrays.id[0] = 99;  /* not there before */
    before.arrays.position[4] = 0.99F;
    after.arrays.position[4] = -0.98F; /* 0.03 m on */
    for (int half = 0; half < 2; half++) {
        const double time = half ? 0.075 : 0.025;
        assert_true(interpolate_states(&before, &after, periodic, time, &out));
        assert_int_equal(out.state.count, COUNT);
        for (size_t i = 0; i < COUNT; i++) {
            const uint32_t id = out.arrays.id[i];
            const float x = out.arrays.position[4 * i];
            assert_true(id != (half ? 77 : 99));
            if (id == 77 || id == 99)
                assert_float_equal(x, 0.3 * time, 1e-6);
            if (id == 1)
                assert_float_equal(x, half ? -1 + 0.0125 : 0.9975, 1e-6);
        }
    }
    state_copy_free(&before);
    state_copy_free(&after);
    state_copy_free(&out);
}

/* By half the angle at half the time, also where the quaternion has the other sign. */
static void the_box_turns_the_short_way(void **state)
{
    (void)state;
    StateCopy before = {.capacity = 0}, after = {.capacity = 0}, out = {.capacity = 0};
    thrown(&before, 0, false);
    thrown(&after, 0.1, false);
    assert_true(state_copy_reserve(&out, 2 * COUNT, 0));
    for (int sign = -1; sign <= 1; sign += 2) {
        after.state.box.orientation[0] = sign * sin(0.1);
        after.state.box.orientation[3] = sign * cos(0.1);
        assert_true(interpolate_states(&before, &after, closed, 0.05, &out));
        assert_float_equal(out.state.box.orientation[0], sin(0.05), 1e-9);
        assert_float_equal(out.state.box.orientation[3], cos(0.05), 1e-9);
    }
    state_copy_free(&before);
    state_copy_free(&after);
    state_copy_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_fall_is_exact),
        cmocka_unit_test(what_comes_goes_and_crosses),
        cmocka_unit_test(the_box_turns_the_short_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
