/* Numbers in HID reports. */
#include "app/input/device/report.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <zlib.h>

static inline int little_i16(const uint8_t *bytes)
{
    return (int16_t)(bytes[0] | bytes[1] << 8);
}

static inline uint32_t little_u16(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8;
}

static inline uint32_t little_u32(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

uint32_t checksum_of(uint8_t kind, const uint8_t *bytes, size_t size)
{
    return (uint32_t)crc32(crc32(0, &kind, 1), bytes, (uInt)size);
}

/* Returns true if the last four of `size` (at least 4) bytes are the checksum of the bytes before. */
static bool checksum_holds(uint8_t kind, const uint8_t *bytes, size_t size)
{
    return size >= 4 && little_u32(bytes + size - 4) == checksum_of(kind, bytes, size - 4);
}

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

/* Parser of one layout. Returns false, with *state undefined, if the report does not fit. state->time is
   the report's time. */
typedef bool ReportParser(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state);

static double within(double value, double limit)
{
    return fmin(fmax(value, -limit), limit);
}

/* Reads `count` axes of the report, from axis `first` on, into the cap's axes. */
static void read_cap(const ReportFormat *format, const uint8_t *bytes, int first, int count,
                     DeviceState *state)
{
    const double full = 350; /* logical range of all models */
    for (int k = 0; k < 6; k++) {
        const DeviceAxis axis = format->row->axes[k];
        const int place = axis.from - first;
        if (place >= 0 && place < count)
            state->cap[k] = within(axis.sign * little_i16(bytes + 2 * (ptrdiff_t)place) / full, 1);
    }
}

/* Id 3: as many bytes of buttons as the model needs. */
static bool read_cap_buttons(const uint8_t *bytes, size_t size, DeviceState *state)
{
    if (size < 2 || size > 7)
        return false;
    state->buttons = 0;
    for (size_t i = 1; i < size && i <= 4; i++)
        state->buttons |= (uint32_t)bytes[i] << 8 * (i - 1);
    return true;
}

static bool parse_cap_w(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state)
{
    if (bytes[0] == 3)
        return read_cap_buttons(bytes, size, state);
    if ((bytes[0] != 1 && bytes[0] != 2) || size != 7)
        return false;
    read_cap(format, bytes + 1, bytes[0] == 1 ? 0 : 3, 3, state);
    return true;
}

static bool parse_cap_s(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state)
{
    if (bytes[0] == 3)
        return read_cap_buttons(bytes, size, state);
    if (bytes[0] != 1 || size != 13)
        return false;
    read_cap(format, bytes + 1, 0, 6, state);
    return true;
}

static bool parse_cap_any(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state)
{
    return parse_cap_w(format, bytes, size, state) || parse_cap_s(format, bytes, size, state);
}

/* 0 exactly at 128; both ends are reached. */
static double stick(uint8_t byte)
{
    return within((byte - 128) / 127.0, 1);
}

static void read_sticks(const uint8_t *bytes, DeviceState *state)
{
    for (int k = 0; k < 2; k++) {
        state->left[k] = stick(bytes[k]);
        state->right[k] = stick(bytes[2 + k]);
    }
}

/* Three bytes of buttons: the hat counts clockwise from up in eighths, 8 and more is none. `mask`: button
   bits of the last byte. */
static uint32_t buttons(const uint8_t *bytes, uint8_t mask)
{
    static const uint8_t hats[16] = {1, 3, 2, 6, 4, 12, 8, 9}; /* up 1, right 2, down 4, left 8 */
    return hats[bytes[0] & 15] | (bytes[0] & 0xf0u) | (uint32_t)bytes[1] << 8 |
           (uint32_t)(bytes[2] & mask) << 16;
}

/* Gyro x y z, accelerometer x y z. */
static void read_sensors(const ReportFormat *format, const uint8_t *bytes, DeviceState *state)
{
    const Calibration *calibration = &format->calibration;
    for (int k = 0; k < 3; k++) {
        const DeviceAxis turn = format->row->axes[k], push = format->row->axes[3 + k];
        const int place = push.from - 3;
        state->angular_velocity[k] =
            turn.sign * calibration->gyro_scale[turn.from] * little_i16(bytes + 2 * (ptrdiff_t)turn.from);
        state->acceleration[k] =
            push.sign * calibration->acceleration_scale[place] *
            (little_i16(bytes + 2 * (ptrdiff_t)push.from) - calibration->acceleration_zero[place]);
    }
    state->has_motion = true;
}

static void read_dualshock4(const ReportFormat *format, const uint8_t *payload, DeviceState *state)
{
    read_sticks(payload, state);
    state->triggers[0] = payload[7] / 255.0;
    state->triggers[1] = payload[8] / 255.0;
    state->buttons = buttons(payload + 4, 0x03); /* the upper bits are a counter */
    read_sensors(format, payload + 12, state);
    state->late = sensor_clock_late(&state->clock, state->time, little_u16(payload + 9), 16, 16e-6 / 3);
}

static void read_dualsense(const ReportFormat *format, const uint8_t *payload, DeviceState *state)
{
    read_sticks(payload, state);
    state->triggers[0] = payload[4] / 255.0;
    state->triggers[1] = payload[5] / 255.0;
    state->buttons = buttons(payload + 7, 0xf7); /* the upper half: buttons of the Edge */
    read_sensors(format, payload + 15, state);
    state->late = sensor_clock_late(&state->clock, state->time, little_u32(payload + 27), 32, 1e-6 / 3);
}

static bool parse_dualshock4_usb(const ReportFormat *format, const uint8_t *bytes, size_t size,
                                 DeviceState *state)
{
    if (bytes[0] != 0x01 || size != 64)
        return false;
    read_dualshock4(format, bytes + 1, state);
    return true;
}

/* Without a controller the adaptor goes on reporting, with a status bit. */
static bool parse_dualshock4_dongle(const ReportFormat *format, const uint8_t *bytes, size_t size,
                                    DeviceState *state)
{
    return parse_dualshock4_usb(format, bytes, size, state) && !(bytes[31] & 0x04);
}

static bool parse_dualshock4_bluetooth(const ReportFormat *format, const uint8_t *bytes, size_t size,
                                       DeviceState *state)
{
    if (bytes[0] != 0x11 || size != 78 || !checksum_holds(CHECKSUM_INPUT, bytes, size))
        return false;
    read_dualshock4(format, bytes + 3, state);
    return true;
}

static bool parse_dualsense_usb(const ReportFormat *format, const uint8_t *bytes, size_t size,
                                DeviceState *state)
{
    if (bytes[0] != 0x01 || size != 64)
        return false;
    read_dualsense(format, bytes + 1, state);
    return true;
}

static bool parse_dualsense_bluetooth(const ReportFormat *format, const uint8_t *bytes, size_t size,
                                      DeviceState *state)
{
    if (bytes[0] != 0x31 || size != 78 || !checksum_holds(CHECKSUM_INPUT, bytes, size))
        return false;
    read_dualsense(format, bytes + 2, state);
    return true;
}

static ReportParser *const parsers[LAYOUT_COUNT] = {
    [LAYOUT_SPACEMOUSE_W] = parse_cap_w,
    [LAYOUT_SPACEMOUSE_S] = parse_cap_s,
    [LAYOUT_SPACEMOUSE_ANY] = parse_cap_any,
    [LAYOUT_DUALSHOCK4_USB] = parse_dualshock4_usb,
    [LAYOUT_DUALSHOCK4_DONGLE] = parse_dualshock4_dongle,
    [LAYOUT_DUALSHOCK4_BLUETOOTH] = parse_dualshock4_bluetooth,
    [LAYOUT_DUALSENSE_USB] = parse_dualsense_usb,
    [LAYOUT_DUALSENSE_BLUETOOTH] = parse_dualsense_bluetooth,
};

bool report_parse(const ReportFormat *format, const uint8_t *bytes, size_t size, double time,
                  DeviceState *state)
{
    DeviceState next = *state;
    next.time = time;
    if (size == 0 || !parsers[format->layout](format, bytes, size, &next)) {
        state->refused++;
        return false;
    }
    next.reports++;
    *state = next;
    return true;
}
