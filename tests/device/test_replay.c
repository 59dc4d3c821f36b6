/* A recording in the devices' place, and recordings of what the devices say. */
#include "tests/app/output_fixture.h"
#include "tests/device/hid_stand_in.h"
#include "tests/patience.h"

#include "app/input/device/device.h"

#include <math.h>

enum { EVENTS_MAX = 256 };

typedef struct Told {
    DeviceEventKind kind;
    int number;
    DeviceState state;
    double ms;
} Told;

static pthread_mutex_t told_lock = PTHREAD_MUTEX_INITIALIZER;
static Told told[EVENTS_MAX];
static int told_count;

static void listen(void *user, const DeviceEvent *event)
{
    (void)user;
    pthread_mutex_lock(&told_lock);
    if (told_count < EVENTS_MAX)
        told[told_count++] = (Told){event->kind, event->number, *event->state, wall_ms()};
    pthread_mutex_unlock(&told_lock);
}

static int begin(void **state)
{
    memset(stand_in.devices, 0, sizeof stand_in.devices);
    told_count = 0;
    return folder_setup(state);
}

static Devices *start(const char *source, ReportLogWriter *record)
{
    Error error = {{0}};
    const DevicesSetup setup = {
        .port = &stand_in_port, .source = source, .listener = listen, .record = record};
    Devices *devices = devices_start(&setup, &error);
    if (!devices)
        fail_msg("%s", error.message);
    return devices;
}

static void play_to_the_end(const char *source, ReportLogWriter *record)
{
    const double until = wall_ms() + PATIENCE_MS;
    Devices *devices = start(source, record);
    while (!devices_ended(devices) && wall_ms() < until)
        pause_ms(2);
    assert_true(devices_ended(devices));
    devices_stop(devices);
}

/* The gyro's x at `time`, in counts. */
static int add_report(char *text, const char *time, int device, int counts)
{
    const Report report = axes_report(LAYOUT_DUALSENSE_USB, (const int[6]){counts, 0, 0, 0, 8192, 0}, false);
    int length = sprintf(text, "%s %d report ", time, device);
    for (size_t i = 0; i < report.size; i++)
        length += sprintf(text + length, "%02x", report.bytes[i]);
    return length + sprintf(text + length, "\n");
}

static void write_recording(const char *path)
{
    static char text[4096];
    int length = sprintf(text, "slosh device recording 1\nprogram 0.1\n"
                               "0 1 plugged dualsense 054c:0ce6 usb DualSense\n"
                               "0 2 plugged spacemouse 046d:c626 usb SpaceNavigator\n");
    length += add_report(text + length, "0.05", 1, 160);
    length += sprintf(text + length, "0.06 2 report 015e0100000000\n0.07 2 report 01\n0.08 1 unplugged\n"
                                     "0.1 3 plugged dualsense 054c:0ce6 usb DualSense\n");
    /* its gyro gives 24 counts per degree/s: 1080 degrees/s over 25920 */
    length += sprintf(text + length, "0.1 3 calibration %s%s\n", "05000000000000a03260cda03260cda03260cd",
                      "1c021c02002000e0002000e0002000e0000000000000");
    length += add_report(text + length, "0.2", 3, 240);
    assert_true(length < (int)sizeof text);
    write_text(path, text);
}

static void events_come_in_time(void **state)
{
    (void)state;
    static const struct {
        DeviceEventKind kind;
        int number;
        double time;
    } expected[] = {{DEVICE_PLUGGED, 1, 0},     {DEVICE_PLUGGED, 2, 0},      {DEVICE_REPORTED, 1, 0.05},
                    {DEVICE_REPORTED, 2, 0.06}, {DEVICE_UNPLUGGED, 1, 0.08}, {DEVICE_PLUGGED, 3, 0.1},
                    {DEVICE_REPORTED, 3, 0.2},  {DEVICE_UNPLUGGED, 2, 0.2},  {DEVICE_UNPLUGGED, 3, 0.2}};
    enum { COUNT = sizeof expected / sizeof *expected };
    write_recording("a.rec");
    const double start_ms = wall_ms();
    play_to_the_end("file:a.rec", NULL);
    assert_int_equal(told_count, COUNT);
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(told[i].kind, expected[i].kind);
        assert_int_equal(told[i].number, expected[i].number);
        assert_true(told[i].ms - start_ms >= 1000 * expected[i].time - 0.01); /* never early */
    }
    assert_true(told[6].state.time == 0.2); /* on the recording's own clock */
    assert_int_equal(told[7].state.refused, 1);
    assert_true(told[7].state.reports == 1 && told[7].state.cap[0] == 1);
}

static void calibrations_are_replayed(void **state)
{
    (void)state;
    write_recording("a.rec");
    play_to_the_end("file:a.rec", NULL);
    /* 160 counts nominal are 10 degrees/s; 240 with its own calibration as well */
    assert_true(fabs(told[2].state.angular_velocity[0] - 10 * M_PI / 180) < 1e-6);
    assert_true(fabs(told[6].state.angular_velocity[0] - told[2].state.angular_velocity[0]) < 1e-6);
}

static void a_stop_does_not_wait_for_the_end(void **state)
{
    (void)state;
    write_text("a.rec", "slosh device recording 1\n0 1 plugged dualsense 054c:0ce6 usb\n1000 1 report 00\n");
    Devices *devices = start("file:a.rec", NULL);
    const double until = wall_ms() + PATIENCE_MS;
    for (int count = 0; count < 1 && wall_ms() < until; pause_ms(2)) {
        pthread_mutex_lock(&told_lock);
        count = told_count;
        pthread_mutex_unlock(&told_lock);
    }
    assert_false(devices_ended(devices));
    devices_stop(devices);           /* with the last report a quarter of an hour off */
    assert_int_equal(told_count, 1); /* the box stays in place: no further targets */
}

static void what_is_no_recording_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *source, *message;
    } cases[] = {
        {"file:none.rec",
         "none.rec: cannot be opened (No such file or directory); name a recording of slosh"},
        {"file:text", "text:1: this is no recording of devices; the first line of one is"},
        {"file:bad", "bad:2: after the family must stand VENDOR:PRODUCT"},
        {"file:", "device 'file:' is unknown; write file:PATH"},
        {"pad", "device 'pad' is unknown; write file:PATH"},
    };
    write_text("text", "hello\n");
    write_text("bad", "slosh device recording 1\n0 1 plugged dualsense sony\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Error error = {{0}};
        const DevicesSetup setup = {.source = cases[i].source, .listener = listen};
        assert_null(devices_start(&setup, &error));
        assert_memory_equal(error.message, cases[i].message, strlen(cases[i].message));
        memset(&error, 0, sizeof error);
        assert_false(devices_check(cases[i].source, &error));
        assert_memory_equal(error.message, cases[i].message, strlen(cases[i].message));
    }
    assert_int_equal(told_count, 0);
    devices_stop(NULL);
}

/* All bytes go through: a recording of a replay says the same. */
static void a_replay_can_be_recorded(void **state)
{
    (void)state;
    Error error = {{0}};
    ReportLog a, b;
    write_recording("a.rec");
    ReportLogWriter *writer = report_log_create("b.rec", &error);
    assert_non_null(writer);
    play_to_the_end("file:a.rec", writer);
    assert_true(report_log_close(writer, &error));
    assert_true(report_log_read("a.rec", &a, &error));
    if (!report_log_read("b.rec", &b, &error))
        fail_msg("%s", error.message);
    assert_int_equal(b.count, a.count + 2); /* devices plugged in at the end */
    assert_int_equal(b.byte_count, a.byte_count);
    assert_memory_equal(a.bytes, b.bytes, a.byte_count);
    for (size_t i = 0; i < a.count; i++) {
        assert_true(a.entries[i].kind == b.entries[i].kind && a.entries[i].device == b.entries[i].device);
        assert_true(b.entries[i].time >= a.entries[i].time - 0.01);
    }
    report_log_destroy(&a);
    report_log_destroy(&b);
}

static void what_is_plugged_in_is_recorded(void **state)
{
    (void)state;
    Error error = {{0}};
    ReportLog log;
    Report feature = {{0x05}, 41};
    seal(CHECKSUM_FEATURE, feature.bytes, feature.size);
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, true);
    STAND_IN_SET(pad->feature, feature);
    const Report rest = rest_report(LAYOUT_DUALSENSE_BLUETOOTH), wrong = {{1, 2, 3}, 3};
    ReportLogWriter *writer = report_log_create("a.rec", &error);
    Devices *devices = start(NULL, writer);
    STAND_IN_SET(pad->lie, REPORT_BYTES_MAX + 1); /* of which no byte is to be trusted */
    push(pad, &rest);
    push(pad, &rest);
    push(pad, &wrong);
    push(pad, &rest);
    const double until = wall_ms() + PATIENCE_MS;
    for (int count = 0; count < 3 && wall_ms() < until; pause_ms(2)) { /* plugged, and two reports */
        pthread_mutex_lock(&told_lock);
        count = told_count;
        pthread_mutex_unlock(&told_lock);
    }
    devices_stop(devices);
    assert_true(report_log_close(writer, &error));
    assert_true(report_log_read("a.rec", &log, &error));
    assert_true(log.devices[0].bluetooth);
    assert_int_equal(log.count, 5); /* plugged, calibration, and every report, including the wrong report */
    assert_int_equal(log.entries[1].kind, REPORT_LOG_CALIBRATION);
    assert_memory_equal(log.bytes + log.entries[1].offset, feature.bytes, feature.size);
    assert_int_equal(log.entries[3].size, 3);
    report_log_destroy(&log);
    told_count = 0;
    play_to_the_end("file:a.rec", NULL);
    assert_int_equal(told_count, 4);
    assert_int_equal(told[3].state.refused, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(events_come_in_time, begin, folder_teardown),
        cmocka_unit_test_setup_teardown(calibrations_are_replayed, begin, folder_teardown),
        cmocka_unit_test_setup_teardown(a_stop_does_not_wait_for_the_end, begin, folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_no_recording_is_refused, begin, folder_teardown),
        cmocka_unit_test_setup_teardown(a_replay_can_be_recorded, begin, folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_plugged_in_is_recorded, begin, folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
