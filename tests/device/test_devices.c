/* The devices against a stand-in for hidapi: what comes, goes, fails, stalls and lies. */
#include "tests/device/hid_stand_in.h"
#include "tests/scratch.h"

#include "app/input/device/device.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { EVENTS_MAX = 4096, PATIENCE_MS = 5000 };

/* What the listener was told. */
typedef struct Told {
    DeviceEventKind kind;
    int number;
    uint16_t product;
    char name[64], problem[512];
    DeviceState state;
    int looks; /* so often was looked for devices */
} Told;

static pthread_mutex_t told_lock = PTHREAD_MUTEX_INITIALIZER;
static Told told[EVENTS_MAX];
static int told_count;
static atomic_int listening;
static atomic_bool overlapped;

static void listen(void *user, const DeviceEvent *event)
{
    (void)user;
    const int looks = stand_in_get(&stand_in.looks);
    if (atomic_fetch_add(&listening, 1) > 0)
        atomic_store(&overlapped, true);
    pthread_mutex_lock(&told_lock);
    if (told_count < EVENTS_MAX) {
        Told *next = &told[told_count++];
        *next = (Told){event->kind, event->number, event->product, .state = *event->state, .looks = looks};
        snprintf(next->name, sizeof next->name, "%s", event->name);
        snprintf(next->problem, sizeof next->problem, "%s", event->problem);
    }
    pthread_mutex_unlock(&told_lock);
    atomic_fetch_sub(&listening, 1);
}

static int count_told(DeviceEventKind kind, int number)
{
    int count = 0;
    pthread_mutex_lock(&told_lock);
    for (int i = 0; i < told_count; i++)
        count += told[i].kind == kind && (number == 0 || told[i].number == number);
    pthread_mutex_unlock(&told_lock);
    return count;
}

/* The `count`th event of a kind for a device (0: any); the event must exist. */
static Told await(DeviceEventKind kind, int number, int count)
{
    const double until = wall_ms() + PATIENCE_MS;
    while (count_told(kind, number) < count && wall_ms() < until)
        pause_ms(1);
    if (count_told(kind, number) < count)
        fail_msg("event %d of device %d did not come %d times", (int)kind, number, count);
    pthread_mutex_lock(&told_lock);
    int i = -1;
    while (count > 0) {
        i++;
        count -= told[i].kind == kind && (number == 0 || told[i].number == number);
    }
    const Told event = told[i];
    pthread_mutex_unlock(&told_lock);
    return event;
}

static void await_count(const int *field, int least)
{
    const double until = wall_ms() + PATIENCE_MS;
    while (stand_in_get(field) < least && wall_ms() < until)
        pause_ms(1);
    assert_true(stand_in_get(field) >= least);
}

static Devices *start(void)
{
    Error error = {{0}};
    const DevicesSetup setup = {.port = &stand_in_port, .listener = listen};
    Devices *devices = devices_start(&setup, &error);
    assert_non_null(devices);
    return devices;
}

static int begin(void **state)
{
    (void)state;
    memset(stand_in.devices, 0, sizeof stand_in.devices);
    stand_in.answer = stand_in.looks = 0;
    told_count = 0;
    return 0;
}

/* What was opened was closed. */
static void stop(Devices *devices)
{
    devices_stop(devices);
    assert_false(atomic_load(&overlapped)); /* one call at a time */
    for (int i = 0; i < STAND_IN_DEVICES; i++)
        assert_int_equal(stand_in.devices[i].opens, stand_in.devices[i].closes);
}

static Report tilted(ReportLayout layout, int counts)
{
    return axes_report(layout, (const int[6]){counts, 0, 0, 0, 8192, 0}, false);
}

static void two_devices_at_once(void **state)
{
    (void)state;
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false), *cap = plug(1, 0x046d, 0xc626, false);
    const Report turn = tilted(LAYOUT_DUALSENSE_USB, 160), push_right = {{1, 0x5e, 1, 0, 0, 0, 0}, 7};
    const double began = wall_ms() / 1000;
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    const Told second = await(DEVICE_PLUGGED, 2, 1);
    assert_true(second.state.reports == 0 && second.state.time == 0 && !second.state.has_motion);
    for (int i = 0; i < 20; i++) {
        push(pad, &turn);
        push(cap, &push_right);
    }
    for (int number = 1; number <= 2; number++) {
        const Told last = await(DEVICE_REPORTED, number, 20);
        const bool is_pad = last.product == 0x0ce6;
        assert_string_equal(last.name, is_pad ? "DualSense" : "SpaceNavigator");
        assert_int_equal(last.state.reports, 20);
        assert_true(last.state.has_motion == is_pad && last.state.cap[0] == (is_pad ? 0 : 1));
        assert_true((last.state.angular_velocity[0] > 0.17) == is_pad);
        assert_true(last.state.time >= began && last.state.time <= wall_ms() / 1000);
    }
    stop(devices);
    const int count = told_count;
    push(pad, &turn);
    pause_ms(30);
    assert_int_equal(told_count, count); /* nothing comes after the stop */
    assert_int_equal(count_told(DEVICE_UNPLUGGED, 0), 0);
}

static void what_is_plugged_in_later_is_noticed(void **state)
{
    (void)state;
    Devices *devices = start();
    await_count(&stand_in.looks, 2);
    StandInDevice *pad = plug(0, 0x054c, 0x09cc, false);
    await(DEVICE_PLUGGED, 1, 1);
    const Report rest = rest_report(LAYOUT_DUALSHOCK4_USB);
    push(pad, &rest);
    await(DEVICE_REPORTED, 1, 1);
    STAND_IN_SET(pad->present, false); /* drawn: the read fails */
    STAND_IN_SET(pad->broken, true);
    const Told gone = await(DEVICE_UNPLUGGED, 1, 1);
    assert_int_equal(gone.state.reports, 1);
    await_count(&pad->closes, 1);
    plug(0, 0x054c, 0x09cc, false);
    const Told again = await(DEVICE_PLUGGED, 2, 1); /* a different number */
    assert_int_equal(again.state.reports, 0);
    stop(devices);
}

/* The system blocks the read of a removed device: the removal is reported all the same, and the stop does
   not wait for the read. */
static void a_stalled_read_holds_nothing_up(void **state)
{
    (void)state;
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false), *cap = plug(1, 0x046d, 0xc626, false);
    const Report push_right = {{1, 0x5e, 1, 0, 0, 0, 0}, 7};
    STAND_IN_SET(pad->stalled, true);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    await(DEVICE_PLUGGED, 2, 1);
    await_count(&pad->reads, 1);
    push(cap, &push_right);
    await(DEVICE_REPORTED, 2, 1);
    STAND_IN_SET(pad->present, false);
    await(DEVICE_UNPLUGGED, 1, 1);
    STAND_IN_SET(pad->present, true); /* plugged in again at the same path */
    await(DEVICE_PLUGGED, 3, 1);
    devices_stop(devices); /* without waiting for an endless read */
    const int count = told_count;
    STAND_IN_SET(pad->stalled, false);
    await_count(&pad->closes, 2); /* the threads end by themselves */
    assert_int_equal(told_count, count);
}

static void a_device_that_fails_is_tried_again_at_each_look(void **state)
{
    (void)state;
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false);
    STAND_IN_SET(pad->broken, true);
    Devices *devices = start();
    await(DEVICE_UNPLUGGED, 2, 1);
    STAND_IN_SET(pad->broken, false);
    const Report rest = rest_report(LAYOUT_DUALSENSE_USB);
    push(pad, &rest);
    await(DEVICE_REPORTED, 0, 1);
    stop(devices);
    assert_true(pad->opens <= stand_in.looks);
}

static void lengths_that_lie_change_nothing(void **state)
{
    (void)state;
    static const int lies[] = {REPORT_BYTES_MAX + 1, 100000, 63, 65, 1};
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false);
    const Report turn = tilted(LAYOUT_DUALSENSE_USB, 160), rest = tilted(LAYOUT_DUALSENSE_USB, 0);
    STAND_IN_SET(pad->feature, ((Report){{0x05}, 41}));
    STAND_IN_SET(pad->feature_lie, 5000);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    push(pad, &turn);
    await(DEVICE_REPORTED, 1, 1);
    for (size_t i = 0; i < sizeof lies / sizeof *lies; i++) {
        STAND_IN_SET(pad->lie, lies[i]);
        push(pad, &rest);
        const int left = 0;
        while (stand_in_get(&pad->queued) > left)
            pause_ms(1);
    }
    push(pad, &turn);
    const Told last = await(DEVICE_REPORTED, 1, 2);
    assert_int_equal(last.state.reports, 2);
    assert_int_equal(last.state.refused, 5);
    assert_true(last.state.angular_velocity[0] > 0.17);
    stop(devices);
}

/* A read that returns at once without data causes no busy loop. */
static void a_hasty_read_is_slowed_down(void **state)
{
    (void)state;
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false);
    STAND_IN_SET(pad->hasty, true);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    const double began = wall_ms();
    const int before = stand_in_get(&pad->reads);
    pause_ms(100);
    const int reads = stand_in_get(&pad->reads) - before;
    assert_true(reads <= (wall_ms() - began) / 10 + 2);
    stop(devices);
}

static const char *rules_command(void)
{
    static char command[DEVICE_COMMAND_SIZE];
    device_rules_command(command);
    return command;
}

static void permission_denied_is_told_once_with_the_command(void **state)
{
    (void)state;
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false), *cap = plug(1, 0x046d, 0xc626, false);
    StandInDevice *shock = plug(2, 0x054c, 0x09cc, false);
    STAND_IN_SET(pad->refusal, HID_DENIED);
    STAND_IN_SET(cap->refusal, HID_BUSY);
    STAND_IN_SET(shock->refusal, HID_FAILED);
    Devices *devices = start();
    assert_int_equal(await(DEVICE_REFUSED, 0, 3).looks, 1); /* what was there before is refused at once */
    await_count(&stand_in.looks, 5);
    assert_int_equal(count_told(DEVICE_REFUSED, 0), 3);
    const Told denied = await(DEVICE_REFUSED, 1, 1), busy = await(DEVICE_REFUSED, 2, 1);
    assert_non_null(strstr(denied.problem, "this user may not open it; `"));
    assert_non_null(strstr(denied.problem, rules_command()));
    assert_non_null(strstr(busy.problem, "another program holds it"));
    assert_string_equal(await(DEVICE_REFUSED, 3, 1).problem,
                        "it cannot be opened (out of order); unplug it and plug it in again");
    STAND_IN_SET(pad->refusal, -1); /* the rule was installed */
    const Told plugged = await(DEVICE_PLUGGED, 1, 1);
    assert_string_equal(plugged.problem, "");
    STAND_IN_SET(cap->present, false); /* and a refused device is unplugged: no further reports */
    await(DEVICE_UNPLUGGED, 2, 1);
    await_count(&stand_in.looks, stand_in_get(&stand_in.looks) + 3);
    assert_int_equal(count_told(DEVICE_UNPLUGGED, 0), 1);
    stop(devices);
}

/* udev grants access a moment after a device appears. */
static void a_new_device_is_given_a_moment(void **state)
{
    (void)state;
    Devices *devices = start();
    await_count(&stand_in.looks, 2);
    pthread_mutex_lock(&stand_in.lock);
    stand_in.devices[0] =
        (StandInDevice){.info = {.path = "/dev/hidraw0", .vendor = 0x054c, .product = 0x0ce6},
                        .present = true,
                        .refusal = HID_DENIED};
    const int looks = stand_in.looks;
    pthread_mutex_unlock(&stand_in.lock);
    await(DEVICE_REFUSED, 1, 1);
    assert_true(stand_in_get(&stand_in.looks) >= looks + 2);
    stop(devices);
}

static void what_is_no_motion_device_is_left_alone(void **state)
{
    (void)state;
    StandInDevice *mouse = plug(0, 0x256f, 0xc650, false), *part = plug(1, 0x256f, 0xc652, false);
    StandInDevice *pad = plug(2, 0x054c, 0x0ce6, false);
    STAND_IN_SET(part->info.usage_page, 1);
    STAND_IN_SET(part->info.usage, 2); /* the mouse in a receiver */
    STAND_IN_SET(pad->info.usage_page, 1);
    STAND_IN_SET(pad->info.usage, 5);
    STAND_IN_SET(pad->twice, true);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    await_count(&stand_in.looks, 3);
    stop(devices);
    assert_true(mouse->opens == 0 && part->opens == 0 && pad->opens == 1);
    assert_int_equal(told_count, 1);
}

/* A failed look has no effect: no device counts as unplugged. */
static void a_look_that_fails_changes_nothing(void **state)
{
    (void)state;
    static const int answers[] = {-1, 1000000};
    plug(0, 0x054c, 0x0ce6, false);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    for (int i = 0; i < 2; i++) {
        STAND_IN_SET(stand_in.answer, answers[i]);
        await_count(&stand_in.looks, stand_in_get(&stand_in.looks) + 3);
    }
    STAND_IN_SET(stand_in.answer, 0);
    await_count(&stand_in.looks, stand_in_get(&stand_in.looks) + 2);
    stop(devices);
    assert_int_equal(told_count, 1);
}

static void another_device_may_get_the_path(void **state)
{
    (void)state;
    StandInDevice *place = plug(0, 0x054c, 0x0ce6, false);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    STAND_IN_SET(place->info.product, 0x09cc);
    await(DEVICE_UNPLUGGED, 1, 1);
    assert_int_equal(await(DEVICE_PLUGGED, 2, 1).product, 0x09cc);
    stop(devices);
}

/* Bluetooth controllers send short reports until a feature report is read; the calibration may arrive
 * damaged. */
static void bluetooth_is_woken_and_calibrated(void **state)
{
    (void)state;
    StandInDevice *shock = plug(0, 0x054c, 0x09cc, true), *sense = plug(1, 0x054c, 0x0ce6, true);
    Report feature = {{0x05}, 41};
    put_i16(feature.bytes + 23, 8192 + 100); /* the accelerometer's x is 100 too much */
    put_i16(feature.bytes + 25, -8192 + 100);
    seal(CHECKSUM_FEATURE, feature.bytes, feature.size);
    STAND_IN_SET(shock->feature, feature);
    STAND_IN_SET(sense->feature, feature);
    STAND_IN_SET(sense->damaged, 2);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 0, 2);
    assert_true(shock->asked_count == 2 && shock->asked[0] == 0x02 && shock->asked[1] == 0x05);
    assert_true(sense->asked_count == 3 && sense->asked[0] == 0x05 && sense->asked[2] == 0x05);
    const int counts[6] = {0, 0, 0, 100, 8192, 0};
    const Report a = axes_report(LAYOUT_DUALSHOCK4_BLUETOOTH, counts, false),
                 b = axes_report(LAYOUT_DUALSENSE_BLUETOOTH, counts, false);
    push(shock, &a);
    push(sense, &b);
    for (int number = 1; number <= 2; number++)
        assert_true(await(DEVICE_REPORTED, number, 1).state.acceleration[0] == 0);
    stop(devices);
}

/* Not when the next one comes. */
static void a_report_is_told_at_once(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, true);
    const Report turn = tilted(LAYOUT_DUALSENSE_BLUETOOTH, 160);
    Devices *devices = start();
    await(DEVICE_PLUGGED, 1, 1);
    for (int i = 0; i < COUNT; i++) {
        push(pad, &turn);
        await(DEVICE_REPORTED, 1, i + 1);
    }
    stop(devices);
    assert_int_equal(told_count, COUNT + 1);
}

static void a_survey_tells_what_may_be_opened(void **state)
{
    (void)state;
    static DeviceListing found[DEVICE_LIST_MAX];
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, true), *cap = plug(1, 0x046d, 0xc626, false);
    plug(2, 0x256f, 0xc650, false);
    STAND_IN_SET(cap->refusal, HID_DENIED);
    STAND_IN_SET(pad->twice, true);
    assert_int_equal(device_list(&stand_in_port, found), 2);
    assert_string_equal(found[0].row->name, "DualSense");
    assert_true(found[0].info.bluetooth && found[0].problem[0] == 0);
    assert_non_null(strstr(found[1].problem, rules_command()));
    assert_true(pad->opens == 1 && pad->closes == 1);
    STAND_IN_SET(stand_in.answer, -1);
    assert_int_equal(device_list(&stand_in_port, found), -1);
}

static void a_process_is_found_by_its_name(void **state)
{
    (void)state;
    char folder[SCRATCH_SIZE], path[SCRATCH_PATH];
    scratch_folder(folder);
    assert_int_equal(device_process(folder, "spacenavd"), 0);
    static const char *const names[] = {"17", "432", "self"};
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        assert_int_equal(mkdir(path, 0700), 0);
        snprintf(path, sizeof path, "%s/%s/comm", folder, names[i]);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fputs(i == 1 ? "spacenavd\n" : "bash\n", file);
        fclose(file);
    }
    assert_int_equal(device_process(folder, "spacenavd"), 432);
    assert_int_equal(device_process(folder, "spacenav"), 0);
    assert_int_equal(device_process("/nowhere", "spacenavd"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(two_devices_at_once, begin),
        cmocka_unit_test_setup(what_is_plugged_in_later_is_noticed, begin),
        cmocka_unit_test_setup(a_stalled_read_holds_nothing_up, begin),
        cmocka_unit_test_setup(a_device_that_fails_is_tried_again_at_each_look, begin),
        cmocka_unit_test_setup(lengths_that_lie_change_nothing, begin),
        cmocka_unit_test_setup(a_hasty_read_is_slowed_down, begin),
        cmocka_unit_test_setup(permission_denied_is_told_once_with_the_command, begin),
        cmocka_unit_test_setup(a_new_device_is_given_a_moment, begin),
        cmocka_unit_test_setup(what_is_no_motion_device_is_left_alone, begin),
        cmocka_unit_test_setup(a_look_that_fails_changes_nothing, begin),
        cmocka_unit_test_setup(another_device_may_get_the_path, begin),
        cmocka_unit_test_setup(bluetooth_is_woken_and_calibrated, begin),
        cmocka_unit_test_setup(a_report_is_told_at_once, begin),
        cmocka_unit_test_setup(a_survey_tells_what_may_be_opened, begin),
        cmocka_unit_test(a_process_is_found_by_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
