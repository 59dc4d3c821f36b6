/* The parsers of motion devices: accepted bytes, and the resulting states. */
#include "tests/device/report_fixture.h"

#include <math.h>
#include <stdio.h>

static const double degree = M_PI / 180;

static DeviceState filled(void)
{
    DeviceState state;
    memset(&state, 0x5a, sizeof state); /* padding too: states are compared byte by byte */
    state.has_motion = true;
    state.clock.runs = true;
    state.reports = 7;
    state.refused = 3;
    return state;
}

static bool same_but_refused(const DeviceState *a, const DeviceState *b)
{
    DeviceState copy;
    memcpy(&copy, a, sizeof copy);
    copy.refused = b->refused;
    return memcmp(&copy, b, sizeof copy) == 0;
}

static void accepts(const ReportFormat *format, const uint8_t *bytes, size_t size, DeviceState *state)
{
    const DeviceState before = *state;
    if (!report_parse(format, bytes, size, 12.5, state))
        fail_msg("%s refused id %02x, %zu bytes", format->row->name, bytes[0], size);
    assert_int_equal(state->reports, before.reports + 1);
    assert_int_equal(state->refused, before.refused);
    assert_true(state->time == 12.5);
}

static void refuses(const ReportFormat *format, const uint8_t *bytes, size_t size)
{
    DeviceState state = filled(), before;
    memcpy(&before, &state, sizeof before);
    if (report_parse(format, bytes, size, 12.5, &state))
        fail_msg("%s accepted id %02x, %zu bytes", format->row->name, bytes[0], size);
    assert_int_equal(state.refused, before.refused + 1);
    assert_true(same_but_refused(&before, &state));
}

static void near_to(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-9 * fmax(1, fabs(expected))))
        fail_msg("%.12g, expected %.12g", value, expected);
}

/* Whether these bytes are a report of the layout, told without the parser. */
static bool is_valid(ReportLayout layout, const uint8_t *bytes, size_t size)
{
    const LayoutFacts *facts = &layout_facts[layout];
    const bool w = layout != LAYOUT_SPACEMOUSE_S, s = layout != LAYOUT_SPACEMOUSE_W;
    if (size == 0)
        return false;
    if (is_cap(layout))
        return (bytes[0] == 3 && size >= 2 && size <= 7) ||
               (w && size == 7 && (bytes[0] == 1 || bytes[0] == 2)) || (s && size == 13 && bytes[0] == 1);
    if (bytes[0] != facts->id || size != facts->size)
        return false;
    if (layout == LAYOUT_DUALSHOCK4_DONGLE && bytes[31] & 4)
        return false;
    const uint32_t sum = checksum_of(CHECKSUM_INPUT, bytes, size - 4);
    return !facts->sealed || (bytes[size - 4] == (sum & 255) && bytes[size - 3] == (sum >> 8 & 255) &&
                              bytes[size - 2] == (sum >> 16 & 255) && bytes[size - 1] == sum >> 24);
}

/* Every layout, with every length and every id. */
static void id_and_length_must_be_right(void **state)
{
    (void)state;
    for (int layout = 0; layout < LAYOUT_COUNT; layout++) {
        const ReportFormat format = format_with((ReportLayout)layout);
        const Report good = rest_report((ReportLayout)layout);
        Report bad = good;
        DeviceState next = {0};
        accepts(&format, good.bytes, good.size, &next);
        for (size_t size = 0; size <= sizeof good.bytes; size++)
            if (!is_valid((ReportLayout)layout, good.bytes, size))
                refuses(&format, good.bytes, size);
        for (int id = 0; id < 256; id++) {
            bad.bytes[0] = (uint8_t)id;
            if (layout_facts[layout].sealed)
                seal(CHECKSUM_INPUT, bad.bytes, bad.size);
            if (!is_valid((ReportLayout)layout, bad.bytes, bad.size))
                refuses(&format, bad.bytes, bad.size);
        }
    }
}

static void foreign_reports_are_refused(void **state)
{
    (void)state;
    for (int a = 0; a < LAYOUT_COUNT; a++)
        for (int b = 0; b < LAYOUT_COUNT; b++) {
            const ReportFormat format = format_with((ReportLayout)a);
            const Report report = rest_report((ReportLayout)b);
            if (!is_valid((ReportLayout)a, report.bytes, report.size))
                refuses(&format, report.bytes, report.size);
        }
    /* reports of a DualShock 4 and a DualSense over Bluetooth before the wake-up */
    const uint8_t small[10] = {0x01, 128, 128, 128, 128, 8};
    const ReportFormat shock = format_of(0x054c, 0x09cc, true), sense = format_of(0x054c, 0x0ce6, true);
    refuses(&shock, small, sizeof small);
    refuses(&sense, small, sizeof small);
}

static void a_wrong_checksum_is_refused(void **state)
{
    (void)state;
    for (int layout = 0; layout < LAYOUT_COUNT; layout++) {
        if (!layout_facts[layout].sealed)
            continue;
        const ReportFormat format = format_with((ReportLayout)layout);
        const Report good = rest_report((ReportLayout)layout);
        for (size_t bit = 0; bit < 8 * good.size; bit++) {
            Report bad = good;
            bad.bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
            refuses(&format, bad.bytes, bad.size);
        }
        Report feature = good; /* sealed as another kind of report */
        seal(CHECKSUM_FEATURE, feature.bytes, feature.size);
        refuses(&format, feature.bytes, feature.size);
    }
    assert_int_equal(checksum_of('1', (const uint8_t *)"23456789", 8),
                     0xcbf43926); /* the CRC-32's check value */
}

/* For each axis of a cap's reports, the axis in the frame of DeviceState, with the sign. The cap's frame is
   x to the right, y towards the user, z down. */
static void caps_have_the_frame(void **state)
{
    (void)state;
    static const struct {
        int to, sign;
    } expected[6] = {{0, 1}, {2, 1}, {1, -1}, {3, 1}, {5, 1}, {4, -1}};
    int devices = 0;
    for (const DeviceRow *row = device_rows; row->name; row++) {
        if (row->family != DEVICE_SPACEMOUSE)
            continue;
        const ReportFormat format = format_of(row->vendor, row->product, false);
        for (int from = 0; from < 6; from++)
            for (int sign = -1; sign <= 1; sign += 2) {
                int counts[6] = {0};
                DeviceState next = {0};
                counts[from] = sign * 175;
                const Report report = axes_report(row->usb, counts, from >= 3);
                accepts(&format, report.bytes, report.size, &next);
                for (int to = 0; to < 6; to++)
                    near_to(next.cap[to], to == expected[from].to ? 0.5 * sign * expected[from].sign : 0);
            }
        devices++;
    }
    assert_int_equal(devices, 21);
}

/* Gyro and accelerometer, each axis and sign, of each controller on each bus. */
static void sensors_have_the_frame(void **state)
{
    (void)state;
    int devices = 0;
    for (const DeviceRow *row = device_rows; row->name; row++)
        for (int bluetooth = 0; bluetooth < 2 && row->family != DEVICE_SPACEMOUSE; bluetooth++, devices++) {
            const ReportFormat format = format_of(row->vendor, row->product, bluetooth);
            for (int axis = 0; axis < 6; axis++)
                for (int sign = -1; sign <= 1; sign += 2) {
                    int counts[6] = {0};
                    DeviceState next = {0};
                    counts[axis] = sign * (axis < 3 ? 1600 : 8192); /* 100 degrees/s, 1 g */
                    const Report report = axes_report(format.layout, counts, false);
                    accepts(&format, report.bytes, report.size, &next);
                    assert_true(next.has_motion);
                    for (int k = 0; k < 3; k++) {
                        near_to(next.angular_velocity[k], k == axis ? sign * 100 * degree : 0);
                        near_to(next.acceleration[k], k == axis - 3 ? sign * 9.80665 : 0);
                    }
                }
        }
    assert_int_equal(devices, 2 * 5);
}

/* A captured report of a SpaceNavigator turned right side down, and reports of the older layout: fields
   without data stay unchanged. */
static void w_has_a_report_for_each_half(void **state)
{
    (void)state;
    const ReportFormat format = format_of(0x046d, 0xc626, false);
    DeviceState next = {0};
    accepts(&format, (const uint8_t[]){0x02, 0, 0, 0xe2, 0xff, 0, 0}, 7, &next);
    near_to(next.cap[5], -30.0 / 350);
    accepts(&format, (const uint8_t[]){0x01, 0x5e, 0x01, 0xa2, 0xfe, 0, 0}, 7, &next);
    near_to(next.cap[0], 1);
    near_to(next.cap[2], -1);
    near_to(next.cap[5], -30.0 / 350);
    accepts(&format, (const uint8_t[]){0x03, 0x03, 0}, 3, &next);
    assert_int_equal(next.buttons, 3);
    assert_false(next.has_motion);
    near_to(next.cap[0], 1);
    accepts(&format, (const uint8_t[]){0x01, 0xff, 0x7f, 0, 0x80, 0, 0}, 7, &next); /* more than it can say */
    near_to(next.cap[0], 1);
    near_to(next.cap[2], -1);
    const ReportFormat pro = format_of(0x256f, 0xc632, false);
    accepts(&pro, (const uint8_t[]){0x03, 0x01, 0x80, 0, 0x02, 0xff, 0xff}, 7, &next);
    assert_int_equal(next.buttons, 0x02008001);
}

/* A DualSense over USB and one over Bluetooth, byte by byte. */
static const uint8_t sense_usb[64] = {
    0x01, 0x00, 0xff, 0x80, 0x40, 0xff, 0x33, 0x11, 0x22, 0x81, 0x06, 0,
    0,    0,    0,    0, /* cross, right and up, r1, ... */
    0x40, 0x06, 0xc0, 0xf9, 0x10, 0x00, 0x00, 0x20, 0x00, 0xe0, 0x01, 0x00,
};
static const uint8_t shock_bluetooth[78] = {
    0x11, 0xc0, 0x00, 0x80, 0x80, 0xff, 0x00, 0x25, 0x20, 0xfd, 0x80, 0xff, 0,    0,
    0,    0x10, 0x00, 0xf0, 0xff, 0x00, 0x7d, 0x00, 0x00, 0x00, 0x20, 0x00, 0x00,
};

static void bytes_become_values(void **state)
{
    (void)state;
    const ReportFormat sense = format_of(0x054c, 0x0ce6, false), shock = format_of(0x054c, 0x05c4, true);
    DeviceState next = {0};
    Report sealed = {.size = sizeof shock_bluetooth};
    accepts(&sense, sense_usb, sizeof sense_usb, &next);
    near_to(next.left[0], -1);
    near_to(next.left[1], 1);
    assert_true(next.right[0] == 0);
    near_to(next.right[1], -64 / 127.0);
    near_to(next.triggers[0], 1);
    near_to(next.triggers[1], 0.2);
    near_to(next.angular_velocity[0], 100 * degree);
    near_to(next.angular_velocity[1], -100 * degree);
    near_to(next.angular_velocity[2], degree);
    near_to(next.acceleration[0], 9.80665);
    near_to(next.acceleration[1], -9.80665);
    near_to(next.acceleration[2], 9.80665 / 8192);
    memset(&next, 0, sizeof next);
    memcpy(sealed.bytes, shock_bluetooth, sealed.size);
    refuses(&shock, sealed.bytes, sealed.size);
    seal(CHECKSUM_INPUT, sealed.bytes, sealed.size);
    accepts(&shock, sealed.bytes, sealed.size, &next);
    near_to(next.right[0], 1);
    near_to(next.right[1], -1);
    near_to(next.triggers[0], 128 / 255.0);
    near_to(next.triggers[1], 1);
    near_to(next.angular_velocity[0], degree);
    near_to(next.angular_velocity[1], -degree);
    near_to(next.angular_velocity[2], 2000 * degree);
    near_to(next.acceleration[1], 9.80665);
    assert_int_equal(next.buttons, 0x01202c); /* down, left, cross; options; ps without the counter */
}

/* The names of the pressed buttons, with a blank behind each. */
static void pressed(const ReportFormat *format, const uint8_t three[3], char text[256])
{
    const LayoutFacts *facts = &layout_facts[format->layout];
    Report report = rest_report(format->layout);
    DeviceState next = {0};
    memcpy(report.bytes + facts->payload + facts->buttons, three, 3);
    if (facts->sealed)
        seal(CHECKSUM_INPUT, report.bytes, report.size);
    accepts(format, report.bytes, report.size, &next);
    text[0] = 0;
    for (int bit = 0; bit < DEVICE_BUTTONS_MAX; bit++)
        if (next.buttons >> bit & 1)
            snprintf(text + strlen(text), 256 - strlen(text), "%s ",
                     format->row->buttons[bit] ? format->row->buttons[bit] : "?");
}

static void buttons_have_names(void **state)
{
    (void)state;
    static const struct {
        uint8_t bytes[3];
        const char *shock, *sense, *edge;
    } cases[] = {
        {{0x00, 0, 0}, "up ", "up ", "up "},
        {{0x01, 0, 0}, "up right ", "up right ", "up right "},
        {{0x02, 0, 0}, "right ", "right ", "right "},
        {{0x03, 0, 0}, "right down ", "right down ", "right down "},
        {{0x04, 0, 0}, "down ", "down ", "down "},
        {{0x05, 0, 0}, "down left ", "down left ", "down left "},
        {{0x06, 0, 0}, "left ", "left ", "left "},
        {{0x07, 0, 0}, "up left ", "up left ", "up left "},
        {{0x08, 0, 0}, "", "", ""},
        {{0x0f, 0, 0}, "", "", ""},
        {{0x18, 0, 0}, "square ", "square ", "square "},
        {{0x28, 0, 0}, "cross ", "cross ", "cross "},
        {{0x48, 0, 0}, "circle ", "circle ", "circle "},
        {{0x88, 0, 0}, "triangle ", "triangle ", "triangle "},
        {{0x08, 0x0f, 0}, "l1 r1 l2 r2 ", "l1 r1 l2 r2 ", "l1 r1 l2 r2 "},
        {{0x08, 0xf0, 0}, "share options l3 r3 ", "create options l3 r3 ", "create options l3 r3 "},
        {{0x08, 0, 0x03}, "ps touchpad ", "ps touchpad ", "ps touchpad "},
        {{0x08, 0, 0xf4}, "", "mute ? ? ? ? ", "mute fn left fn right paddle left paddle right "},
        {{0x08, 0, 0x08}, "", "", ""},
    };
    const ReportFormat formats[] = {format_of(0x054c, 0x09cc, false), format_of(0x054c, 0x09cc, true),
                                    format_of(0x054c, 0x0ce6, false), format_of(0x054c, 0x0ce6, true),
                                    format_of(0x054c, 0x0df2, false), format_of(0x054c, 0x0df2, true)};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int f = 0; f < 6; f++) {
            char text[256];
            pressed(&formats[f], cases[i].bytes, text);
            assert_string_equal(text, f < 2 ? cases[i].shock : f < 4 ? cases[i].sense : cases[i].edge);
        }
}

static void an_adaptor_without_a_controller_is_silent(void **state)
{
    (void)state;
    const ReportFormat format = format_of(0x054c, 0x0ba0, false), plain = format_of(0x054c, 0x09cc, false);
    Report report = rest_report(format.layout);
    DeviceState next = {0};
    report.bytes[31] = 0x04;
    refuses(&format, report.bytes, report.size);
    accepts(&plain, report.bytes, report.size, &next);
}

static uint64_t random_state = 88172645463325252u;

static uint64_t random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state;
}

/* A valid report with some bytes replaced, noise of some length, or a shortened or extended report. */
static Report mutated(const Report *good)
{
    Report report = *good;
    const uint64_t bits = random_bits();
    for (uint64_t n = bits & 3; n > 0; n--) {
        const uint64_t more = random_bits();
        report.bytes[more % report.size] = (uint8_t)(more >> 32);
    }
    if ((bits & 0x700) == 0)
        report.size = (bits >> 16) % (sizeof report.bytes + 1);
    if ((bits & 0x3800) == 0)
        for (size_t i = 0; i + 8 <= sizeof report.bytes; i += 8) {
            const uint64_t noise = random_bits();
            memcpy(report.bytes + i, &noise, 8);
        }
    return report;
}

static bool in_range(const DeviceState *state)
{
    bool ok = true;
    for (int k = 0; k < 6; k++)
        ok &= fabs(state->cap[k]) <= 1;
    for (int k = 0; k < 2; k++)
        ok &= fabs(state->left[k]) <= 1 && fabs(state->right[k]) <= 1 && state->triggers[k] >= 0 &&
              state->triggers[k] <= 1;
    for (int k = 0; k < 3; k++)
        ok &= fabs(state->angular_velocity[k]) < 36 && fabs(state->acceleration[k]) < 40;
    return ok;
}

/* A million inputs through each parser: invalid reports change no state. */
static void noise_changes_nothing(void **state)
{
    (void)state;
    enum { COUNT = 1000000 };
    for (int layout = 0; layout < LAYOUT_COUNT; layout++) {
        const ReportFormat format = format_with((ReportLayout)layout);
        const Report good = rest_report((ReportLayout)layout);
        DeviceState next, before;
        size_t accepted = 0;
        memset(&next, 0, sizeof next);
        for (int i = 0; i < COUNT; i++) {
            const Report report = mutated(&good);
            memcpy(&before, &next, sizeof before);
            const bool ok = report_parse(&format, report.bytes, report.size, i, &next);
            if (ok != is_valid((ReportLayout)layout, report.bytes, report.size) ||
                !(ok ? in_range(&next) : same_but_refused(&before, &next)))
                fail_msg("%s: report %d of the noise", format.row->name, i);
            accepted += ok;
        }
        assert_true(accepted > COUNT / 100 && accepted < COUNT - COUNT / 100);
        assert_int_equal(next.reports, accepted);
        assert_int_equal(next.refused, COUNT - accepted);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(id_and_length_must_be_right),
        cmocka_unit_test(foreign_reports_are_refused),
        cmocka_unit_test(a_wrong_checksum_is_refused),
        cmocka_unit_test(caps_have_the_frame),
        cmocka_unit_test(sensors_have_the_frame),
        cmocka_unit_test(w_has_a_report_for_each_half),
        cmocka_unit_test(bytes_become_values),
        cmocka_unit_test(buttons_have_names),
        cmocka_unit_test(an_adaptor_without_a_controller_is_silent),
        cmocka_unit_test(noise_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
