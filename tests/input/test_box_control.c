/* From a device's report to the resulting command: at once, while the window draws, and in step with
   mouse and keys. */
#define _GNU_SOURCE /* syscall */
#include "tests/device/hid_stand_in.h"
#include "tests/patience.h"
#include "tests/tolerance.h"

#include "app/input/input.h"
#include "sim/world.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const double size[3] = {1, 1, 1};
static const double g = 9.80665;
enum { PAD = 1, CAP = 2, SECOND_PAD = 101 /* with the same content as the first */ };

static _Thread_local double turned_ms; /* by hand, in this thread; 0: the real clock */

/* In the C library's place. */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    if (clock != CLOCK_MONOTONIC || turned_ms == 0)
        return (int)syscall(SYS_clock_gettime, clock, now);
    now->tv_sec = (time_t)(turned_ms / 1000);
    now->tv_nsec = (long)(1e6 * (turned_ms - 1e3 * (double)now->tv_sec));
    return 0;
}

/* The receiver of commands. */
typedef struct Sent {
    uint64_t count;
    BoxTarget last;
} Sent;

static uint64_t take(void *user, const BoxTarget *target)
{
    Sent *sent = user;
    sent->last = *target;
    return ++sent->count;
}

/* A window that looks along -z, and devices. */
typedef struct Room {
    BoxControl *control;
    Sent sent;
    HandInput own;
    BoxControlNews news;
    DeviceState pad, cap;
} Room;

static _Atomic int woken;

static void wake(void)
{
    woken++;
}

static void look(Room *room)
{
    box_control_update(room->control, &room->own, size, &room->news);
}

static void sleep_ms(double ms)
{
    const struct timespec time = {.tv_nsec = (long)(1e6 * ms)};
    nanosleep(&time, NULL);
}

static void tell(Room *room, DeviceEventKind kind, int number, const char *problem)
{
    const bool pad = number == PAD || number == SECOND_PAD;
    const DeviceEvent event = {.kind = kind,
                               .number = number,
                               .family = pad ? DEVICE_DUALSENSE : DEVICE_SPACEMOUSE,
                               .vendor = pad ? 0x054c : 0x256f,
                               .product = pad ? 0x0ce6 : 0xc635,
                               .name = pad ? "DualSense" : "SpaceMouse Compact",
                               .problem = problem,
                               .state = pad ? &room->pad : &room->cap};
    box_control_device_event(room->control, &event);
}

static void report(Room *room, int number)
{
    DeviceState *state = number == CAP ? &room->cap : &room->pad;
    state->reports++;
    state->time += 0.004;
    tell(room, DEVICE_REPORTED, number, "");
}

static Room room_open(void)
{
    Mapping mapping;
    mapping_default(&mapping);
    woken = 0;
    Room room = {.control = box_control_create(&mapping, wake)};
    assert_non_null(room.control);
    room.own.right[0] = 1, room.own.up[1] = 1, room.own.away[2] = -1;
    room.pad.has_motion = true;
    room.pad.acceleration[1] = g;
    return room;
}

/* From now on `room` stays in place: sent commands go to `room`. */
static void room_begin(Room *room)
{
    box_control_open(room->control, take, &room->sent);
    look(room);
}

static void room_close(Room *room)
{
    box_control_destroy(room->control);
}

/* The pad is turned about z by so many degrees, and says so in 0.1 s. */
static void turn_pad(Room *room, double degrees)
{
    const double rate = degrees * M_PI / 180 / 0.1;
    double angle = atan2(room->pad.acceleration[0], room->pad.acceleration[1]);
    room->pad.angular_velocity[2] = rate;
    for (int i = 0; i < 25; i++) {
        angle += rate * 0.004;
        room->pad.acceleration[0] = g * sin(angle);
        room->pad.acceleration[1] = g * cos(angle);
        report(room, PAD);
    }
    room->pad.angular_velocity[2] = 0;
    for (int i = 0; i < 25; i++)
        report(room, PAD);
}

static void check_tilt(const Room *room, double degrees)
{
    const double half = degrees * M_PI / 360;
    check_vector(room->sent.last.orientation, 0, 0, sin(half), 0.004, "orientation"); /* half a degree */
}

static void a_report_is_a_command_at_once(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, CAP, "");
    look(&room);
    assert_string_equal(room.news.words[0].text, "SpaceMouse Compact is in your hand");
    room.cap.cap[0] = 1;
    sleep_ms(1);
    report(&room, CAP);
    assert_int_equal(room.sent.count, 1);
    assert_true(room.sent.last.position[0] > 0);
    assert_int_equal(woken, 1); /* for the words on the screen, not for a pose */
    look(&room);
    assert_int_equal(room.news.sent_count, 1);
    assert_int_equal(room.news.sent[0].number, 1);
    assert_int_equal(box_control_reports(room.control), 1);
    look(&room);
    assert_int_equal(room.news.words_count + room.news.sent_count, 0);
    room_close(&room);
}

static void the_box_is_tilted_as_the_pad_is(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    turn_pad(&room, -30);
    check_tilt(&room, -30);

    /* Seen from +x the picture's right is -z: so is the way of its tilt. */
    room.own = (HandInput){.right = {0, 0, -1}, .up = {0, 1, 0}, .away = {-1, 0, 0}};
    look(&room);
    check_vector(room.sent.last.orientation, -sin(M_PI / 12), 0, 0, 0.004, "orientation");
    room_close(&room);
}

/* No reads for a fifth of a second, then a burst: a turn about the vertical, measured by the gyro only. */
static void late_reports_turn_as_they_were_measured(void **state)
{
    (void)state;
    enum { LATE = 50 };
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    room.pad.angular_velocity[1] = M_PI / 6 / (LATE * 0.004);
    room.pad.time += LATE * 0.004;
    for (int i = 1; i <= LATE; i++) {
        room.pad.late = (LATE - i) * 0.004;
        room.pad.reports++;
        tell(&room, DEVICE_REPORTED, PAD, "");
    }
    check_vector(room.sent.last.orientation, 0, sin(M_PI / 12), 0, 0.004, "orientation");
    room_close(&room);
}

static void unplugged_the_box_stays(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    room.pad.left[0] = 1;
    turn_pad(&room, 0);
    turn_pad(&room, 20);
    const Sent before = room.sent;
    assert_true(before.last.position[0] > 0.4);
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    for (int i = 0; i < 10; i++)
        look(&room);
    assert_int_equal(room.sent.count, before.count);
    report(&room, PAD); /* of a removed device */
    assert_int_equal(room.sent.count, before.count);
    box_control_home(room.control);
    look(&room);
    assert_int_equal(room.sent.count, before.count + 1);
    check_vector(room.sent.last.position, 0, 0, 0, 0, "position");
    check_tilt(&room, 0);
    room_close(&room);
}

/* A loose cable: the last pose and the device's pose are the same. */
static void plugged_in_again_it_does_not_count_twice(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    turn_pad(&room, 20);
    for (int i = 0; i < 2; i++) {
        tell(&room, DEVICE_UNPLUGGED, PAD, "");
        look(&room);
        tell(&room, DEVICE_PLUGGED, PAD, "");
        look(&room);
        check_tilt(&room, 20); /* until the first pose */
        turn_pad(&room, 0);
        check_tilt(&room, 20);
    }
    turn_pad(&room, -20);
    check_tilt(&room, 0);
    room_close(&room);
}

static void of_two_one_is_back(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    turn_pad(&room, 10);
    tell(&room, DEVICE_PLUGGED, SECOND_PAD, "");
    report(&room, SECOND_PAD);
    check_tilt(&room, 20);
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    tell(&room, DEVICE_UNPLUGGED, SECOND_PAD, "");
    look(&room);
    check_tilt(&room, 20);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    report(&room, PAD);
    check_tilt(&room, 10);
    room_close(&room);
}

/* What the user has turned since then stays. */
static void turned_meanwhile_it_stays_so(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    turn_pad(&room, 10);
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    room.own.turn_drag[0] = 0.2;
    look(&room);
    room.own.turn_drag[0] = 0;
    const BoxTarget left = room.sent.last;
    assert_true(fabs(left.orientation[1]) > 0.09);
    turn_pad(&room, -10); /* level, and unheard of */
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    look(&room);
    check_vector(room.sent.last.orientation, left.orientation[0], left.orientation[1], left.orientation[2],
                 0.004, "orientation");
    room_close(&room);
}

static void two_devices_at_once(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    tell(&room, DEVICE_PLUGGED, CAP, "");
    turn_pad(&room, 0);
    room.cap.cap[1] = 1;
    turn_pad(&room, 20);
    report(&room, CAP);
    sleep_ms(2);
    report(&room, CAP);
    check_tilt(&room, 20);
    const double up = room.sent.last.position[1];
    assert_true(up > 0);
    tell(&room, DEVICE_UNPLUGGED, CAP, ""); /* the pad goes on */
    turn_pad(&room, 10);
    check_tilt(&room, 30);
    check_near(room.sent.last.position[1], up, 1e-9, "how far up");
    room_close(&room);
}

static void buttons_are_commands_once(void **state)
{
    (void)state;
    enum { TRIANGLE = 1 << 7, OPTIONS = 1 << 13 };
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    room.pad.buttons = TRIANGLE | OPTIONS;
    report(&room, PAD);
    report(&room, PAD);
    look(&room);
    assert_int_equal(room.news.action_count, 2);
    assert_ptr_equal(room.news.actions[0], &action_neutral);
    assert_ptr_equal(room.news.actions[1], &action_pause);
    look(&room);
    assert_int_equal(room.news.action_count, 0);
    assert_true(woken >= 2);
    room_close(&room);
}

static void neutral_and_home(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 0);
    turn_pad(&room, 25);
    box_control_neutral(room.control);
    look(&room);
    check_tilt(&room, 0);
    turn_pad(&room, -10);
    check_tilt(&room, -10);
    room.own.turn_drag[0] = 1, room.own.move_drag[0] = 0.2;
    look(&room);
    box_control_home(room.control);
    room.own.turn_drag[0] = room.own.move_drag[0] = 0;
    look(&room);
    check_tilt(&room, 0);
    check_vector(room.sent.last.position, 0, 0, 0, 1e-12, "position");
    room_close(&room);
}

static void what_may_not_be_opened_is_told(void **state)
{
    (void)state;
    BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_REFUSED, PAD, "permission denied; install the rule");
    look(&room);
    assert_true(room.news.words[0].wrong);
    assert_string_equal(room.news.words[0].text, "DualSense: permission denied; install the rule");
    assert_int_equal(box_control_devices(room.control, devices), 1);
    assert_string_equal(devices[0].problem, "permission denied; install the rule");
    assert_false(box_control_uses(room.control, 0x054c, 0x0ce6)); /* the window may have it */
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    assert_int_equal(box_control_devices(room.control, devices), 0);
    look(&room);
    assert_string_equal(room.news.words[0].text, "DualSense is gone");
    tell(&room, DEVICE_REFUSED, PAD, "permission denied; install the rule");
    tell(&room, DEVICE_PLUGGED, PAD, "");
    assert_int_equal(box_control_devices(room.control, devices), 1);
    assert_string_equal(devices[0].problem, "");
    assert_true(box_control_uses(room.control, 0x054c, 0x0ce6));
    assert_false(box_control_uses(room.control, 0x054c, 0x09cc));
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    assert_false(box_control_uses(room.control, 0x054c, 0x0ce6));
    assert_int_equal(box_control_devices(room.control, devices), 0);
    room_close(&room);
}

static void more_than_there_is_room_for(void **state)
{
    (void)state;
    BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
    Room room = room_open();
    room_begin(&room);
    for (int number = 1; number < 30; number++)
        tell(&room, DEVICE_PLUGGED, number, "");
    assert_int_equal(box_control_devices(room.control, devices), BOX_CONTROL_DEVICES_MAX);
    for (int number = 1; number < 30; number += 2)
        tell(&room, DEVICE_UNPLUGGED, number, "");
    assert_int_equal(box_control_devices(room.control, devices), BOX_CONTROL_DEVICES_MAX / 2);
    for (int i = 0; i < BOX_CONTROL_DEVICES_MAX / 2; i++)
        assert_int_equal(devices[i].number, 2 * (i + 1)); /* in the order of coming */
    room_close(&room);
}

static void tuned_in_the_panel(void **state)
{
    (void)state;
    BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    box_control_tune(room.control, PAD, 0.5, 0.4);
    turn_pad(&room, 0);
    turn_pad(&room, 20);
    check_tilt(&room, 10);
    tell(&room, DEVICE_UNPLUGGED, PAD, "");
    tell(&room, DEVICE_PLUGGED, PAD, ""); /* the same again */
    assert_int_equal(box_control_devices(room.control, devices), 1);
    check_near(devices[0].map.gain, 0.5, 0, "gain");
    check_near(devices[0].map.dead_zone, 0.4, 0, "dead zone");
    room_close(&room);
}

static void the_camera_is_the_windows(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    room.pad.right[0] = 1, room.pad.triggers[1] = 1;
    for (int i = 0; i < 10; i++)
        report(&room, PAD);
    look(&room);
    assert_true(room.news.camera[0] > 0 && room.news.camera[1] == 0);
    check_near(room.news.camera[2], room.news.camera[0], 1e-12, "zoom");
    assert_true(woken > 1 && room.sent.count == 0);
    room_close(&room);
}

/* A key that is held moves the box by the clock, however many reports come in between. */
static void keys_go_on_between_reports(void **state)
{
    (void)state;
    enum { COUNT = 50 };
    Room room = room_open();
    turned_ms = floor(wall_ms());
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    room.own.move_rate[0] = 0.5;
    look(&room);
    for (int i = 0; i < COUNT; i++) {
        turned_ms++;
        report(&room, PAD);
    }
    look(&room);
    turned_ms = 0;
    check_near(room.sent.last.position[0], 0.5e-3 * HAND_SPEED * COUNT, 1e-6, "way");
    room_close(&room);
}

/* Mouse motion since the last picture is sent with the picture, and not again with each report. */
static void a_drag_counts_once(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    room.own.move_drag[0] = 0.25;
    room.own.turn_drag[0] = 0.2;
    look(&room);
    const BoxTarget sent = room.sent.last;
    check_near(sent.position[0], 0.25, 1e-9, "x");
    check_near(sent.orientation[1], sin(0.1), 1e-9, "turned");
    for (int i = 0; i < 5; i++)
        report(&room, PAD);
    assert_memory_equal(&room.sent.last, &sent, sizeof sent);
    room_close(&room);
}

/* Command numbers restart with a scene: the meter of the scene must ignore earlier numbers. */
static void a_new_scene_knows_no_older_commands(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 10);
    assert_true(room.sent.count > 0);
    box_control_open(room.control, take, &room.sent);
    look(&room);
    assert_int_equal(room.news.sent_count, 0);
    room_close(&room);
}

static void closed_it_sends_nothing(void **state)
{
    (void)state;
    Room room = room_open();
    tell(&room, DEVICE_PLUGGED, CAP, "");
    room.cap.cap[0] = 1;
    report(&room, CAP); /* before any scene */
    box_control_open(room.control, take, &room.sent);
    report(&room, CAP); /* before the first picture: the correct state is unknown */
    assert_int_equal(room.sent.count, 0);
    look(&room);
    sleep_ms(1);
    report(&room, CAP);
    assert_true(room.sent.count > 0);
    const uint64_t count = room.sent.count;
    box_control_close(room.control);
    sleep_ms(1);
    report(&room, CAP);
    look(&room);
    assert_int_equal(room.sent.count, count);
    room_close(&room);
}

enum { REPORTS = 4000 };

static _Atomic bool drawing;
static _Atomic int commands;
static _Thread_local int own_commands; /* of this thread */

static uint64_t count_command(void *user, const BoxTarget *target)
{
    (void)user, (void)target;
    own_commands++;
    return (uint64_t)++commands;
}

/* The window's thread: repeated looks, and requests of the panel. */
static void *draw_on(void *user)
{
    Room *room = user;
    while (drawing) {
        BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX];
        look(room);
        box_control_devices(room->control, devices);
    }
    return NULL;
}

/* A report that turns the box is a command when the call returns, and none is lost, whatever the window does
 * meanwhile. */
static void none_is_lost_while_the_window_draws(void **state)
{
    (void)state;
    pthread_t window;
    int late = 0;
    Room room = room_open();
    box_control_open(room.control, count_command, NULL);
    look(&room);
    tell(&room, DEVICE_PLUGGED, PAD, "");
    drawing = true;
    assert_int_equal(pthread_create(&window, NULL, draw_on, &room), 0);
    for (int i = 0; i < REPORTS; i++) {
        const int before = own_commands;
        room.pad.angular_velocity[2] = i % 200 < 100 ? 1 : -1;
        report(&room, PAD);
        late += i > 1 && own_commands == before; /* the first two have no turn between them */
    }
    drawing = false;
    pthread_join(window, NULL);
    assert_int_equal(box_control_reports(room.control), REPORTS);
    assert_int_equal(late, 0);
    assert_true(box_control_latency(room.control, 0.5) > 0);
    assert_true(box_control_latency(room.control, 0.99) >= box_control_latency(room.control, 0.5));
    room_close(&room);
}

enum { PUSHES = 200 };

/* From the system's bytes to the command: a thread wakes up, parses, and turns the box for each report
   before the next report, while a second thread draws. */
static void each_is_a_command_from_the_bytes_on(void **state)
{
    (void)state;
    pthread_t window;
    Error error = {{0}};
    Room room = room_open();
    commands = 0;
    box_control_open(room.control, count_command, NULL);
    look(&room);
    StandInDevice *pad = plug(0, 0x054c, 0x0ce6, false);
    const DevicesSetup setup = {
        .port = &stand_in_port, .listener = box_control_device_event, .user = room.control};
    const Report turning = axes_report(LAYOUT_DUALSENSE_USB, (const int[6]){0, 640, 0, 0, 8192, 0}, false);
    Devices *devices = devices_start(&setup, &error);
    assert_non_null(devices);
    drawing = true;
    assert_int_equal(pthread_create(&window, NULL, draw_on, &room), 0);
    for (int i = 0; i < PUSHES; i++) {
        const double until = wall_ms() + PATIENCE_MS;
        const int before = commands;
        push(pad, &turning);
        while (box_control_reports(room.control) <= (uint64_t)i && wall_ms() < until)
            sleep_ms(0.05);
        assert_int_equal(box_control_reports(room.control), i + 1);
        while (i > 0 && commands == before &&
               wall_ms() < until) /* the first report has no time span for a turn */
            sleep_ms(0.05);
        assert_true(i == 0 || commands > before);
    }
    drawing = false;
    pthread_join(window, NULL);
    devices_stop(devices);
    room_close(&room);
}

/* The simulation is at a different time: the box is at the target of the time, without news, and
   continues from the target. A device with a pose keeps the present turn. */
static void at_another_time_it_goes_on_from_there(void **state)
{
    (void)state;
    Room room = room_open();
    room_begin(&room);
    room.own.move_drag[0] = 0.1;
    look(&room);
    room.own.move_drag[0] = 0;
    assert_true(room.sent.count == 1 && room.sent.last.position[0] == 0.1);
    box_control_set_target(room.control, &(BoxTarget){{0.5, 0.2, 0}, {0, 0, 0, 1}});
    look(&room);
    look(&room);
    assert_int_equal(room.sent.count, 1);
    room.own.move_drag[1] = 0.1;
    look(&room);
    room.own.move_drag[1] = 0;
    assert_int_equal(room.sent.count, 2);
    check_vector(room.sent.last.position, 0.5, 0.3, 0, 1e-12, "position");

    tell(&room, DEVICE_PLUGGED, PAD, "");
    turn_pad(&room, 20);
    check_tilt(&room, 20);
    const uint64_t sent = room.sent.count;
    box_control_set_target(room.control, &(BoxTarget){{0, 0, 0}, {0, 0, 0, 1}});
    look(&room);
    assert_int_equal(room.sent.count, sent); /* with the device held as before, the box is as before */
    turn_pad(&room, 10);
    assert_true(room.sent.count > sent);
    check_tilt(&room, 10);
    room_close(&room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_report_is_a_command_at_once),
        cmocka_unit_test(the_box_is_tilted_as_the_pad_is),
        cmocka_unit_test(unplugged_the_box_stays),
        cmocka_unit_test(plugged_in_again_it_does_not_count_twice),
        cmocka_unit_test(of_two_one_is_back),
        cmocka_unit_test(turned_meanwhile_it_stays_so),
        cmocka_unit_test(two_devices_at_once),
        cmocka_unit_test(buttons_are_commands_once),
        cmocka_unit_test(neutral_and_home),
        cmocka_unit_test(what_may_not_be_opened_is_told),
        cmocka_unit_test(more_than_there_is_room_for),
        cmocka_unit_test(tuned_in_the_panel),
        cmocka_unit_test(the_camera_is_the_windows),
        cmocka_unit_test(keys_go_on_between_reports),
        cmocka_unit_test(late_reports_turn_as_they_were_measured),
        cmocka_unit_test(a_drag_counts_once),
        cmocka_unit_test(a_new_scene_knows_no_older_commands),
        cmocka_unit_test(closed_it_sends_nothing),
        cmocka_unit_test(at_another_time_it_goes_on_from_there),
        cmocka_unit_test(none_is_lost_while_the_window_draws),
        cmocka_unit_test(each_is_a_command_from_the_bytes_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
