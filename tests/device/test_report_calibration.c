/* A controller's stored calibration: from sensor counts to rad/s and m/s2. */
#include "tests/device/report_fixture.h"

#include <math.h>

static const double degree = M_PI / 180, g = 9.80665;

/* As read from a controller: gyro bias, plus and minus for pitch, yaw, roll; speeds; accelerometer plus and
 * minus. */
static const int bias[3] = {-7, 9, -7};
static const int plus[3] = {8958, 8891, 8841}, minus[3] = {-8972, -8871, -8856};
static const int up[3] = {8403, 8383, 7868}, down[3] = {-8441, -8022, -8396};
enum { SPEED = 540 };

static Report feature(ReportLayout layout)
{
    const bool apart = layout == LAYOUT_DUALSHOCK4_BLUETOOTH;
    const CalibrationReport what = calibration_report(layout);
    Report report = {.size = what.size};
    report.bytes[0] = what.id;
    for (int k = 0; k < 3; k++) {
        put_i16(report.bytes + 1 + 2 * k, bias[k]);
        put_i16(report.bytes + (apart ? 7 + 2 * k : 7 + 4 * k), plus[k]);
        put_i16(report.bytes + (apart ? 13 + 2 * k : 9 + 4 * k), minus[k]);
        put_i16(report.bytes + 23 + 4 * k, up[k]);
        put_i16(report.bytes + 25 + 4 * k, down[k]);
    }
    put_i16(report.bytes + 19, SPEED);
    put_i16(report.bytes + 21, SPEED);
    if (layout_facts[layout].sealed)
        seal(CHECKSUM_FEATURE, report.bytes, report.size);
    return report;
}

static void near_to(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-12 + 1e-9 * fabs(expected)))
        fail_msg("%.12g, expected %.12g", value, expected);
}

static void nominal_is(const Calibration *calibration, int axis)
{
    near_to(calibration->gyro_scale[axis], degree / 16);
    near_to(calibration->acceleration_scale[axis], g / 8192);
    near_to(calibration->acceleration_zero[axis], 0);
}

static void each_layout_has_its_own(void **state)
{
    (void)state;
    int layouts = 0;
    for (int layout = 0; layout < LAYOUT_COUNT; layout++) {
        const Report report = feature((ReportLayout)layout);
        Calibration calibration;
        if (is_cap((ReportLayout)layout)) {
            assert_int_equal(calibration_report((ReportLayout)layout).size, 0);
            continue;
        }
        assert_true(calibration_parse((ReportLayout)layout, report.bytes, report.size, &calibration));
        for (int k = 0; k < 3; k++) {
            /* the sensor turned at plus and minus 540 degrees/s */
            near_to(calibration.gyro_scale[k], 1080 * degree / (plus[k] - minus[k]));
            near_to(calibration.acceleration_zero[k], (up[k] + down[k]) / 2.0);
            near_to((up[k] - calibration.acceleration_zero[k]) * calibration.acceleration_scale[k], g);
            near_to((down[k] - calibration.acceleration_zero[k]) * calibration.acceleration_scale[k], -g);
        }
        layouts++;
    }
    assert_int_equal(layouts, 5);
}

/* A calibrated controller at rest, and a controller turned at the calibration speed. */
static void reports_are_calibrated(void **state)
{
    (void)state;
    ReportFormat format = format_of(0x054c, 0x0ce6, true);
    const Report kept = feature(format.layout);
    assert_true(calibration_parse(format.layout, kept.bytes, kept.size, &format.calibration));
    for (int axis = 0; axis < 3; axis++) {
        int counts[6] = {0};
        DeviceState next = {0};
        counts[axis] = plus[axis] - bias[axis];
        for (int k = 0; k < 3; k++)
            counts[3 + k] = k == axis ? up[k] : 0;
        const Report report = axes_report(format.layout, counts, false);
        assert_true(report_parse(&format, report.bytes, report.size, 0, &next));
        assert_true(fabs(next.angular_velocity[axis] - 540 * degree) < 0.001 * 540 * degree);
        near_to(next.acceleration[axis], g);
    }
}

static void what_is_none_leaves_the_nominal(void **state)
{
    (void)state;
    for (int layout = LAYOUT_DUALSHOCK4_USB; layout < LAYOUT_COUNT; layout++) {
        const Report good = feature((ReportLayout)layout);
        Calibration calibration;
        for (size_t size = 0; size <= CALIBRATION_BYTES_MAX; size++) {
            assert_int_equal(calibration_parse((ReportLayout)layout, good.bytes, size, &calibration),
                             size == good.size);
            if (size != good.size)
                nominal_is(&calibration, 1);
        }
        Report bad = good;
        bad.bytes[0] ^= 0x10;
        assert_false(calibration_parse((ReportLayout)layout, bad.bytes, bad.size, &calibration));
        nominal_is(&calibration, 0);
        bad = good;
        bad.bytes[bad.size - 1] ^= 1; /* padding over USB, the checksum over Bluetooth */
        assert_int_equal(calibration_parse((ReportLayout)layout, bad.bytes, bad.size, &calibration),
                         !layout_facts[layout].sealed);
    }
}

/* Impossible sensor numbers, an axis at a time: zero denominators, scales far off, a zero far away. */
static void nonsense_is_nominal(void **state)
{
    (void)state;
    const ReportLayout layout = LAYOUT_DUALSENSE_USB;
    for (int axis = 0; axis < 3; axis++) {
        Report report = feature(layout);
        Calibration calibration;
        put_i16(report.bytes + 1 + 2 * axis, 0);
        put_i16(report.bytes + 7 + 4 * axis, 0);
        put_i16(report.bytes + 9 + 4 * axis, 0);
        put_i16(report.bytes + 23 + 4 * axis, 8192);
        put_i16(report.bytes + 25 + 4 * axis, 8192);
        assert_true(calibration_parse(layout, report.bytes, report.size, &calibration));
        nominal_is(&calibration, axis);
        near_to(calibration.gyro_scale[(axis + 1) % 3],
                1080 * degree / (plus[(axis + 1) % 3] - minus[(axis + 1) % 3]));
        put_i16(report.bytes + 7 + 4 * axis, 100);
        put_i16(report.bytes + 23 + 4 * axis, 16384 + 8192);
        assert_true(calibration_parse(layout, report.bytes, report.size, &calibration));
        nominal_is(&calibration, axis);
    }
    Report empty = {.size = 41, .bytes = {0x05}};
    Calibration calibration;
    assert_true(calibration_parse(layout, empty.bytes, empty.size, &calibration));
    for (int axis = 0; axis < 3; axis++)
        nominal_is(&calibration, axis);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_layout_has_its_own),
        cmocka_unit_test(reports_are_calibrated),
        cmocka_unit_test(what_is_none_leaves_the_nominal),
        cmocka_unit_test(nonsense_is_nominal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
