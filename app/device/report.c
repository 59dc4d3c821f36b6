#include "app/device/report.h"

#include "app/device/checksum.h"
#include "app/device/little_endian.h"

#include <math.h>

/* Parser of one layout. Returns false, with *state undefined, if the report does not fit. state->time is
   the report's time. */
typedef bool Parser(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state);

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

static Parser *const parsers[LAYOUT_COUNT] = {
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
