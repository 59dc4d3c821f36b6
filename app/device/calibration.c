#include "app/device/calibration.h"

#include "app/device/checksum.h"
#include "app/device/little_endian.h"

#include <math.h>
#include <stdlib.h>

#define GRAVITY 9.80665 /* m/s2 per g, as assumed by the calibration */
#define RADIANS (M_PI / 180)

static const double gyro_counts = 16, acceleration_counts = 8192; /* per degree/s, per g */

Calibration calibration_nominal(void)
{
    const double gyro = RADIANS / gyro_counts, acceleration = GRAVITY / acceleration_counts;
    return (Calibration){.gyro_scale = {gyro, gyro, gyro},
                         .acceleration_scale = {acceleration, acceleration, acceleration}};
}

CalibrationReport calibration_report(ReportLayout layout)
{
    switch (layout) {
    case LAYOUT_DUALSHOCK4_USB:
    case LAYOUT_DUALSHOCK4_DONGLE:
        return (CalibrationReport){.id = 0x02, .size = 37};
    case LAYOUT_DUALSHOCK4_BLUETOOTH:
        return (CalibrationReport){.wake = 0x02, .id = 0x05, .size = 41};
    case LAYOUT_DUALSENSE_USB:
    case LAYOUT_DUALSENSE_BLUETOOTH:
        return (CalibrationReport){.id = 0x05, .size = 41};
    case LAYOUT_SPACEMOUSE_W:
    case LAYOUT_SPACEMOUSE_S:
    case LAYOUT_SPACEMOUSE_ANY:
    case LAYOUT_COUNT:
        break;
    }
    return (CalibrationReport){0};
}

static bool plausible(double scale, double nominal)
{
    return scale > nominal / 2 && scale < nominal * 2;
}

/* `plus` and `minus`: readings of the gyro turned at +speed and -speed. */
static void read_gyro(const uint8_t *bytes, bool interleaved, int axis, double *scale)
{
    const int bias = little_i16(bytes + 1 + 2 * axis);
    const int plus = little_i16(bytes + 7 + (interleaved ? 4 : 2) * axis);
    const int minus = little_i16(bytes + (interleaved ? 9 + 4 * axis : 13 + 2 * axis));
    const int speeds = little_i16(bytes + 19) + little_i16(bytes + 21); /* degrees/s */
    const int counts = abs(plus - bias) + abs(minus - bias);
    const double read = counts > 0 ? speeds * RADIANS / counts : 0;
    *scale = plausible(read, *scale) ? read : *scale;
}

/* `plus` and `minus`: readings of the axis at +g and -g. */
static void read_acceleration(const uint8_t *bytes, int axis, double *zero, double *scale)
{
    const int plus = little_i16(bytes + 23 + 4 * axis), minus = little_i16(bytes + 25 + 4 * axis);
    const double read = plus > minus ? 2 * GRAVITY / (plus - minus) : 0, middle = (plus + minus) / 2.0;
    if (!plausible(read, *scale) || fabs(middle) > acceleration_counts / 2)
        return;
    *zero = middle;
    *scale = read;
}

bool calibration_parse(ReportLayout layout, const uint8_t *bytes, size_t size, Calibration *out)
{
    const CalibrationReport report = calibration_report(layout);
    const bool bluetooth = layout == LAYOUT_DUALSHOCK4_BLUETOOTH || layout == LAYOUT_DUALSENSE_BLUETOOTH;
    *out = calibration_nominal();
    if (report.size == 0 || size != report.size || bytes[0] != report.id ||
        (bluetooth && !checksum_holds(CHECKSUM_FEATURE, bytes, size)))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        read_gyro(bytes, layout != LAYOUT_DUALSHOCK4_BLUETOOTH, axis, &out->gyro_scale[axis]);
        read_acceleration(bytes, axis, &out->acceleration_zero[axis], &out->acceleration_scale[axis]);
    }
    return true;
}
