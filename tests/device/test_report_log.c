/* Recordings of raw reports: written, read again, cut, and wrong in every way that can be told. */
#include "tests/app/output_fixture.h"

#include "app/input/device/device.h"
#include "sim/world.h"

#include <signal.h>
#include <sys/resource.h>

#define HEAD "slosh device recording 1\nprogram 0.1\n"
#define PLUG "0.5 1 plugged dualsense 054c:0ce6 usb DualSense\n"

static Error error;

static bool parse(const char *text, ReportLog *log)
{
    error.message[0] = 0;
    return report_log_parse("a.rec", text, strlen(text), log, &error);
}

static void refuse(const char *text, const char *message)
{
    ReportLog log;
    if (parse(text, &log))
        fail_msg("accepted: %s", text);
    if (strncmp(error.message, message, strlen(message)) != 0)
        fail_msg("expected '%s'\n     got '%s'", message, error.message);
    assert_null(log.entries);
}

static void lines_become_entries(void **state)
{
    (void)state;
    ReportLog log;
    const char *text = HEAD PLUG "0.5 1 calibration 05FF00\n"
                                 "0.504 1 report 01fe\n"
                                 "0.504 2 plugged spacemouse 046d:C626 bluetooth\n"
                                 "7 1 unplugged\n"
                                 "1000000 2 report 03\n";
    assert_true(parse(text, &log));
    assert_int_equal(log.device_count, 2);
    assert_string_equal(log.devices[0].row->name, "DualSense");
    assert_true(!log.devices[0].bluetooth && log.devices[1].bluetooth);
    assert_true(!log.devices[0].plugged && log.devices[1].plugged);
    assert_int_equal(log.count, 6);
    const ReportLogEntry *report = &log.entries[2];
    assert_true(report->kind == REPORT_LOG_REPORT && report->time == 0.504 && report->device == 0);
    assert_int_equal(report->size, 2);
    assert_memory_equal(log.bytes + report->offset, "\x01\xfe", 2);
    assert_memory_equal(log.bytes + log.entries[1].offset, "\x05\xff\x00", 3);
    assert_true(log.entries[5].time == 1e6 && log.entries[5].device == 1);
    report_log_destroy(&log);
    assert_true(parse("slosh device recording 1\n", &log));
    assert_int_equal(log.count, 0);
    report_log_destroy(&log);
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    refuse("",
           "a.rec:1: this is no recording of devices; the first line of one is 'slosh device recording 1'");
    refuse("slosh recording 1\n", "a.rec:1: this is no recording of devices");
    refuse("slosh device recording 1", "a.rec:1: the recording was cut in its first line");
    refuse("slosh device recording 2\n", "a.rec:1: 'slosh device recording 2' stands where");
    refuse(HEAD "plugged\n", "a.rec:3: the line must begin with a time in s, such as 0.004");
    refuse(HEAD "-1 1 unplugged\n", "a.rec:3: the line must begin with a time");
    refuse(HEAD "1e3 1 unplugged\n", "a.rec:3: the line must begin with a time");
    refuse(HEAD "1.2.3 1 unplugged\n", "a.rec:3: the line must begin with a time");
    refuse(HEAD ". 1 unplugged\n", "a.rec:3: the line must begin with a time");
    refuse(HEAD "\n", "a.rec:3: the line must begin with a time");
    refuse(HEAD "1000001 1 unplugged\n", "a.rec:3: 1000001 s is later than any");
    refuse(HEAD PLUG "0.4 1 unplugged\n", "a.rec:4: 0.4 s is before the line above; put them in order");
    refuse(HEAD "0 x unplugged\n", "a.rec:3: after the time must stand the number of a device");
    refuse(HEAD "0 99999 unplugged\n", "a.rec:3: after the time must stand the number of a device");
    refuse(HEAD "0 0 report 01\n", "a.rec:3: no device 0 was plugged in; the next one is 1");
    refuse(HEAD "0 2 report 01\n", "a.rec:3: no device 2 was plugged in; the next one is 1");
    refuse(HEAD "0 1 report 01\n", "a.rec:3: device 1 is not plugged in here");
    refuse(HEAD "0 1 danced\n",
           "a.rec:3: 'danced' is no event; after the device stands plugged, calibration,");
    refuse(HEAD "0 1\n", "a.rec:3: '' is no event");
    refuse(HEAD "0 1 plugged\n", "a.rec:3: after 'plugged' must stand the family, such as dualsense");
    refuse(HEAD "0 1 plugged dualsense 054c\n", "a.rec:3: after the family must stand VENDOR:PRODUCT");
    refuse(HEAD "0 1 plugged dualsense 054c:xxxx usb\n",
           "a.rec:3: after the family must stand VENDOR:PRODUCT");
    refuse(HEAD "0 1 plugged spacemouse 256f:c650 usb\n",
           "a.rec:3: 256f:c650 is no motion device that this slosh knows");
    refuse(HEAD "0 1 plugged dualsense 046d:c626 usb\n",
           "a.rec:3: 046d:c626 is no 'dualsense'; its family is spacemouse");
    refuse(HEAD "0 1 plugged dualsense 054c:0ce6 wire\n", "a.rec:3: after VENDOR:PRODUCT must stand usb or");
    refuse(HEAD PLUG PLUG, "a.rec:4: device 1 was plugged in before; a new one is 2");
    refuse(HEAD PLUG "1 1 unplugged\n2 1 report 01\n", "a.rec:5: device 1 is not plugged in here");
    refuse(HEAD PLUG "1 1 unplugged now\n", "a.rec:4: something follows 'unplugged'; leave it out");
    refuse(HEAD PLUG "1 1 report\n", "a.rec:4: a report must stand here: 2 to 2048 hexadecimal digits");
    refuse(HEAD PLUG "1 1 report 011\n", "a.rec:4: a report must stand here");
    refuse(HEAD PLUG "1 1 report 01g0\n", "a.rec:4: 'g0' is no byte");
    refuse(HEAD PLUG "1 1 report 01 000\n", "a.rec:4: ' 0' is no byte");
}

/* Sizes that a file may not have. */
static void sizes_are_bounded(void **state)
{
    (void)state;
    enum { SIZE = 2 * REPORT_LOG_REPORT_MAX };
    static char text[8192];
    ReportLog log;
    int length = snprintf(text, sizeof text, HEAD PLUG "1 1 report ");
    memset(text + length, 'a', SIZE);
    snprintf(text + length + SIZE, 8, "\n");
    assert_true(parse(text, &log));
    assert_int_equal(log.entries[1].size, REPORT_LOG_REPORT_MAX);
    report_log_destroy(&log);
    snprintf(text + length + SIZE, 8, "aa\n");
    refuse(text, "a.rec:4: a report must stand here");
    length = snprintf(text, sizeof text, HEAD);
    for (int i = 1; i <= REPORT_LOG_DEVICES_MAX + 1; i++)
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "0 %d plugged dualsense 054c:0ce6 usb\n", i);
    refuse(text, "a.rec:67: more than 64 devices");
}

/* A killed writer: at any byte, all complete lines are present. */
static void a_cut_file_is_read_as_far_as_it_is_whole(void **state)
{
    (void)state;
    const char *text = HEAD PLUG "0.504 1 report 01fe\n1 1 unplugged\n";
    for (size_t size = strlen("slosh device recording 1\n"); size <= strlen(text); size++) {
        ReportLog log;
        size_t lines = 0;
        for (size_t i = strlen(HEAD); i < size; i++)
            lines += text[i] == '\n';
        if (!report_log_parse("a.rec", text, size, &log, &error))
            fail_msg("%zu bytes: %s", size, error.message);
        assert_int_equal(log.count, lines);
        report_log_destroy(&log);
    }
}

static void what_is_written_is_read(void **state)
{
    (void)state;
    const uint8_t calibration[3] = {5, 0, 255}, report[2] = {1, 0xab};
    uint8_t huge[REPORT_LOG_REPORT_MAX + 1] = {1};
    ReportLog log;
    ReportLogWriter *writer = report_log_create("a.rec", &error);
    assert_non_null(writer);
    assert_int_equal(report_log_plugged(writer, device_row(0x054c, 0x0ce6), true), 1);
    report_log_calibration(writer, 1, calibration, sizeof calibration);
    const double now = wall_ms() / 1000;
    report_log_report(writer, 1, now + 1, report, sizeof report);
    report_log_report(writer, 1, now, report, sizeof report); /* a race with a second thread */
    report_log_report(writer, 1, now, huge, sizeof huge);
    report_log_report(writer, 0, now, report, sizeof report); /* of an extra */
    assert_int_equal(report_log_plugged(writer, device_row(0x046d, 0xc626), false), 2);
    /* as before the end: state after a killed program */
    assert_true(report_log_read("a.rec", &log, &error));
    assert_int_equal(log.count, 5);
    report_log_destroy(&log);
    report_log_unplugged(writer, 1);
    assert_false(report_log_broken(writer));
    assert_true(report_log_close(writer, &error));
    if (!report_log_read("a.rec", &log, &error))
        fail_msg("%s", error.message);
    assert_int_equal(log.count, 6);
    assert_true(log.devices[0].bluetooth && !log.devices[0].plugged && log.devices[1].plugged);
    assert_true(log.entries[2].time > 0.9 && log.entries[2].time < 1.5 &&
                log.entries[3].time == log.entries[2].time);
    assert_memory_equal(log.bytes + log.entries[1].offset, calibration, sizeof calibration);
    assert_memory_equal(log.bytes + log.entries[3].offset, report, sizeof report);
    report_log_destroy(&log);
}

static void an_older_file_stays(void **state)
{
    (void)state;
    write_text("a.rec", HEAD PLUG);
    assert_null(report_log_create("a.rec", &error));
    assert_string_equal(error.message, "a.rec: is there already, and stays as it is; name a new file");
    FILE *file = fopen("a.rec", "r");
    char text[sizeof HEAD PLUG] = "";
    assert_non_null(file);
    assert_int_equal(fread(text, 1, sizeof text, file), strlen(HEAD PLUG));
    fclose(file);
    assert_string_equal(text, HEAD PLUG);
    assert_int_equal(count_files("."), 1);
}

/* It would be waited for, and the second time in vain. */
static void a_pipe_is_no_recording(void **state)
{
    (void)state;
    ReportLog log;
    assert_int_equal(mkfifo("pipe", 0600), 0);
    assert_false(report_log_read("pipe", &log, &error));
    assert_string_equal(error.message, "pipe: not a plain file; save the recording as one and name that");
}

static void carriage_returns_do_not_count(void **state)
{
    (void)state;
    ReportLog log;
    if (!parse("slosh device recording 1\r\nprogram 0.1\r\n0 1 plugged dualsense 054c:0ce6 usb\r\n"
               "0 1 report 01fe\r\n1 1 unplugged\r\n",
               &log))
        fail_msg("%s", error.message);
    assert_int_equal(log.count, 3);
    assert_int_equal(log.entries[1].size, 2);
    report_log_destroy(&log);
}

static void files_are_refused_in_words(void **state)
{
    ReportLog log;
    assert_false(report_log_read("none.rec", &log, &error));
    assert_string_equal(error.message,
                        "none.rec: cannot be opened (No such file or directory); name a recording of slosh");
    assert_false(report_log_read(*state, &log, &error));
    assert_non_null(strstr(error.message, ": a directory; name a recording in it"));
    assert_null(report_log_create("none/a.rec", &error));
    assert_non_null(strstr(error.message, "none/a.rec"));
    assert_true(report_log_close(NULL, &error));
}

/* A limit on the size of files in place of a disk that is full. */
static void a_full_disk_is_told(void **state)
{
    (void)state;
    struct rlimit before, small;
    ReportLog log;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    ReportLogWriter *writer = report_log_create("a.rec", &error);
    assert_non_null(writer);
    report_log_plugged(writer, device_row(0x054c, 0x0ce6), false);
    assert_false(report_log_broken(writer));
    small = before;
    small.rlim_cur = 100;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (int i = 0; i < 4; i++)
        report_log_unplugged(writer, 1);
    const bool broken = report_log_broken(writer), closed = report_log_close(writer, &error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_true(broken && !closed);
    assert_string_equal(error.message,
                        "a.rec: cannot be written (File too large); what came before is whole");
    assert_true(report_log_read("a.rec", &log, &error));
    assert_true(log.count >= 1);
    report_log_destroy(&log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_become_entries),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(sizes_are_bounded),
        cmocka_unit_test(a_cut_file_is_read_as_far_as_it_is_whole),
        cmocka_unit_test_setup_teardown(what_is_written_is_read, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(an_older_file_stays, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(a_pipe_is_no_recording, folder_setup, folder_teardown),
        cmocka_unit_test(carriage_returns_do_not_count),
        cmocka_unit_test_setup_teardown(files_are_refused_in_words, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(a_full_disk_is_told, folder_setup, folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
