/* The window's own measurements against known inputs; and the script that shakes the box. */
#include "tests/tolerance.h"

#include "app/window/window.h"

#include <math.h>

static void pictures_a_second(void **state)
{
    (void)state;
    FrameTimes meter = {0};
    float history[FRAME_TIMES_HISTORY];
    for (int i = 0; i < 101; i++)
        frame_times_picture(&meter, 1000 + 20.0 * i, 0);
    assert_int_equal(meter.pictures, 101);
    assert_true(fabs(meter.pictures_per_second - 50) < 0.5);
    assert_int_equal(frame_times_history(&meter, history), 100);
    for (int i = 0; i < 100; i++)
        assert_true(fabsf(history[i] - 20) < 1e-3F);
    for (int i = 0; i < 200; i++) /* the ring keeps the last ones, in order */
        frame_times_picture(&meter, 3000 + i + 0.001 * i * i, 0);
    assert_int_equal(frame_times_history(&meter, history), FRAME_TIMES_HISTORY);
    for (int i = 1; i < FRAME_TIMES_HISTORY; i++)
        assert_true(history[i] > history[i - 1]);
}

/* A pause of 27 s is no picture of 27 s, and none of its pictures counts. */
static void pauses_are_left_out(void **state)
{
    (void)state;
    FrameTimes meter = {0};
    float history[FRAME_TIMES_HISTORY];
    for (int i = 0; i < 61; i++)
        frame_times_picture(&meter, 1000 + 20.0 * i, 0);
    frame_times_pause(&meter, true);
    frame_times_picture(&meter, 2300, 0);
    frame_times_picture(&meter, 29000, 0);
    frame_times_picture(&meter, 29300, 0);
    frame_times_pause(&meter, false);
    frame_times_picture(&meter, 29320, 0);
    assert_int_equal(frame_times_history(&meter, history), 61);
    for (int i = 0; i < 61; i++)
        assert_true(fabsf(history[i] - 20) < 1e-3F);
    assert_true(fabs(meter.pictures_per_second - 50) < 0.5);
}

/* An event is shown by the first picture with a state that applied the command, and by no earlier
   picture. */
static void events_wait_for_their_picture(void **state)
{
    (void)state;
    FrameTimes meter = {0};
    frame_times_event(&meter, 100, 1);
    frame_times_event(&meter, 110, 2);
    frame_times_event(&meter, 115, 3);
    frame_times_picture(&meter, 120, 0);
    assert_int_equal(meter.latencies, 0);
    frame_times_picture(&meter, 150, 2);
    assert_int_equal(meter.latencies, 2);
    frame_times_picture(&meter, 180, 2);
    assert_int_equal(meter.latencies, 2);
    frame_times_picture(&meter, 210, 9);
    assert_int_equal(meter.latencies, 3);
    assert_true(frame_times_latency(&meter, 0) == 40);
    assert_true(frame_times_latency(&meter, 0.5) == 50);
    assert_true(frame_times_latency(&meter, 1) == 95);
    frame_times_event(&meter, 220, 10);
    frame_times_forget_events(&meter);
    frame_times_picture(&meter, 300, 10);
    assert_int_equal(meter.latencies, 3);
}

static void more_than_it_holds(void **state)
{
    (void)state;
    FrameTimes meter = {0};
    assert_true(frame_times_latency(&meter, 0.5) == 0);
    for (int i = 0; i < 2 * FRAME_TIMES_WAITING_MAX; i++)
        frame_times_event(&meter, 0, (uint64_t)i + 1);
    frame_times_picture(&meter, 7, 4 * FRAME_TIMES_WAITING_MAX);
    assert_int_equal(meter.latencies, FRAME_TIMES_WAITING_MAX);
    for (int i = 0; i < FRAME_TIMES_SAMPLES_MAX + 50; i++) {
        frame_times_event(&meter, i, (uint64_t)i + 1);
        frame_times_picture(&meter, i + 3, (uint64_t)i + 1);
    }
    assert_true(frame_times_latency(&meter, 0) == 3 && frame_times_latency(&meter, 1) == 3);
}

static void the_process_has_an_age(void **state)
{
    (void)state;
    const double age = process_age_ms();
    assert_true(age >= 0 && age < 60000);
    assert_true(process_age_ms() >= age);
}

/* 125 events a second with due times; a drag with Shift, within the picture. */
static void the_script_keeps_its_times(void **state)
{
    (void)state;
    WindowShake script = {0};
    WindowEvent event;
    int events = 0;
    double last = 0, least = 1e9, most = 0;
    for (double now = 5000; now <= 7000; now += 37)
        while (window_shake_next(&script, now, 400, 300, &event)) {
            assert_int_equal(event.kind, events == 0 ? WINDOW_BUTTON : WINDOW_MOVE);
            assert_true(event.when_ms <= now && event.when_ms > last);
            assert_true(event.x > 0 && event.x < 400 && event.y > 0 && event.y < 300);
            last = event.when_ms;
            least = fmin(least, event.x);
            most = fmax(most, event.x);
            events++;
        }
    assert_true(events > 245 && events < 253);
    assert_true(most - least > 150);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_a_second),
        cmocka_unit_test(pauses_are_left_out),
        cmocka_unit_test(events_wait_for_their_picture),
        cmocka_unit_test(more_than_it_holds),
        cmocka_unit_test(the_process_has_an_age),
        cmocka_unit_test(the_script_keeps_its_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
