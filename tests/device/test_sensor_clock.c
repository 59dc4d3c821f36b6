/* Late reports in a burst keep the device's time intervals. */
#include "tests/device/report_fixture.h"

#include "app/input/device/device.h"

#include <math.h>
#include <stdio.h>

static const double EVERY = 0.004, TICK = 16e-6 / 3; /* s: a DualShock 4 over USB */

static uint32_t ticks_at(double time)
{
    return (uint32_t)fmod(time / TICK, 65536);
}

/* When the report comes: from `from` on nobody reads for `starved` s. */
static double comes_at(double measured, double from, double starved)
{
    return measured > from && measured < from + starved ? from + starved : measured;
}

static void a_burst_is_told_apart(void **state)
{
    (void)state;
    SensorClock clock = {0};
    double latest = 0;
    for (int i = 0; i < 1000; i++) {
        const double measured = 10 + i * EVERY, time = comes_at(measured, 11.5, 0.15);
        const double late = sensor_clock_late(&clock, time, ticks_at(measured), 16, TICK);
        assert_true(fabs(time - late - measured) < 3e-4);
        latest = fmax(latest, late);
    }
    assert_true(latest > 0.14 && latest < 0.15);
}

static void clocks_may_drift_apart(void **state)
{
    (void)state;
    for (int way = -1; way <= 1; way += 2) {
        SensorClock clock = {0};
        for (int i = 0; i < 60000; i++) { /* 4 minutes, 200 parts in a million */
            const double time = i * EVERY;
            const double late =
                sensor_clock_late(&clock, time, ticks_at(time * (1 + 2e-4 * way) + 5), 16, TICK);
            assert_true(late >= 0 && late < 1e-3);
        }
    }
}

static void what_cannot_be_told_is_not_late(void **state)
{
    (void)state;
    SensorClock stands = {0}, pauses = {0}, random = {0};
    uint32_t noise = 1;
    for (int i = 0; i < 1000; i++) {
        const double time = 1 + i * EVERY;
        assert_true(sensor_clock_late(&stands, time, 7, 16, TICK) == 0);
        assert_true(sensor_clock_late(&pauses, 0.3 * i, ticks_at(0.3 * i), 16, TICK) == 0);
        noise = noise * 1664525u + 1013904223u;
        const double late = sensor_clock_late(&random, time, noise >> 16, 16, TICK);
        assert_true(late >= 0 && late <= SENSOR_CLOCK_LATEST);
    }
}

/* Where in the reports the clocks stand, by the kernel's driver for these controllers. */
static void reports_carry_it(void **state)
{
    (void)state;
    const struct {
        uint16_t product;
        int place;
        double tick;
    } of[] = {{0x09cc, 1 + 9, TICK}, {0x0ce6, 1 + 27, 1e-6 / 3}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        const ReportFormat format = format_of(0x054c, of[k].product, false);
        uint8_t bytes[64] = {0x01};
        DeviceState next = {0};
        for (int i = 0; i < 50; i++) {
            const double measured = i * EVERY, time = comes_at(measured, 0.04, 0.1);
            const uint32_t ticks = (uint32_t)(measured / of[k].tick);
            bytes[of[k].place] = (uint8_t)ticks;
            bytes[of[k].place + 1] = (uint8_t)(ticks >> 8);
            if (k == 1) {
                bytes[of[k].place + 2] = (uint8_t)(ticks >> 16);
                bytes[of[k].place + 3] = (uint8_t)(ticks >> 24);
            }
            assert_true(report_parse(&format, bytes, sizeof bytes, time, &next));
            assert_true(fabs(next.time - next.late - measured) < 2e-4);
        }
    }
}

/* A quarter turn about the vertical, measured by the gyro only, with a starved read in the middle. */
static void a_starved_read_loses_no_turn(void **state)
{
    (void)state;
    SensorClock clock = {0};
    Orientation orientation = orientation_start();
    const double rate[3] = {0, M_PI, 0}, up[3] = {0, 9.80665, 0};
    for (int i = 0; i <= 125; i++) {
        const double measured = 1 + i * EVERY, time = comes_at(measured, 1.2, 0.15);
        const double late = sensor_clock_late(&clock, time, ticks_at(measured), 16, TICK);
        orientation_update(&orientation, time - late, rate, up);
    }
    double q[4];
    orientation_turned(&orientation, q);
    const double angle = 2 * atan2(q[1], q[3]) * 180 / M_PI;
    printf("turned by %.2f degrees of 90\n", angle);
    assert_true(fabs(angle - 90) < 0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_burst_is_told_apart),           cmocka_unit_test(clocks_may_drift_apart),
        cmocka_unit_test(what_cannot_be_told_is_not_late), cmocka_unit_test(reports_carry_it),
        cmocka_unit_test(a_starved_read_loses_no_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
