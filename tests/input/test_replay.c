/* A recording of motion devices moves the box of a world without a window: by the angle recorded, to the same
   bits each time, with any threads and across a break. */
#include "tests/app/output_fixture.h"
#include "tests/device/report_fixture.h"
#include "tests/tolerance.h"

#include "app/cli/cli.h"
#include "app/input/input.h"
#include "app/run/session.h"
#include "sim/state.h"

static const double SIZE[3] = {1, 1, 1};
static const double RATE = 250; /* reports a second */

static const char HEAD[] = "slosh device recording 1\n", PAD[] = "0 1 plugged dualsense 054c:0ce6 usb\n",
                  CAP[] = "0 1 plugged spacemouse 046d:c626 usb\n";

static Error error;

static void put_report(FILE *file, double time, const Report *report)
{
    fprintf(file, "%.6f 1 report ", time);
    for (size_t i = 0; i < report->size; i++)
        fprintf(file, "%02x", report->bytes[i]);
    fputc('\n', file);
}

/* A pad tilted by `degrees` about z, at as many degrees a second; at 0 the pad lies still. */
static void put_pad(FILE *file, double *time, double *degrees, double a_second, double seconds, int button)
{
    for (int i = 0; i < (int)lround(seconds * RATE); i++) {
        *degrees += a_second / RATE;
        *time += 1 / RATE;
        const double up = *degrees * M_PI / 180;
        Report report =
            axes_report(LAYOUT_DUALSENSE_USB,
                        (const int[6]){0, 0, (int)lround(16 * a_second), (int)lround(8192 * sin(up)),
                                       (int)lround(8192 * cos(up)), 0},
                        false);
        report.bytes[8] = (uint8_t)(8 | button);
        put_report(file, *time, &report);
    }
}

/* Still, -30 degrees in 0.3 s, still until `end`; then it is unplugged. */
static void write_tilt(const char *path, double end)
{
    double time = 0, degrees = 0;
    FILE *file = fopen(path, "w");
    fprintf(file, "%s%s", HEAD, PAD);
    put_pad(file, &time, &degrees, 0, 0.1, 0);
    put_pad(file, &time, &degrees, -100, 0.3, 0);
    put_pad(file, &time, &degrees, 0, end - time, 0);
    fclose(file);
}

/* A cap pushed to the right once, then silent for a second: the connection is lost. */
static void write_push(const char *path)
{
    const Report report = axes_report(LAYOUT_SPACEMOUSE_W, (const int[6]){350, 0, 0, 0, 0, 0}, false);
    FILE *file = fopen(path, "w");
    fprintf(file, "%s%s", HEAD, CAP);
    put_report(file, 0.5, &report);
    fprintf(file, "1.5 1 unplugged\n");
    fclose(file);
}

static Scene scene_seen_from(const char *from)
{
    Scene scene;
    char text[256];
    const int size = snprintf(text, sizeof text,
                              "box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\n"
                              "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]\n"
                              "solver: {sound_speed: 12, step: {dt: 0.004, substeps: 2}}\n"
                              "view: {camera: {from: %s, to: [0, 0.5, 0]}}\n",
                              from);
    if (!scene_parse("a.yaml", text, (size_t)size, NULL, &scene, NULL, &error))
        fail_msg("%s", error.message);
    return scene;
}

static DeviceReplay *open_replay(const char *source, const char *mapping, const char *from)
{
    const Scene scene = scene_seen_from(from);
    DeviceReplay *replay = device_replay_open(source, mapping, &scene, &error);
    if (!replay)
        fail_msg("%s", error.message);
    return replay;
}

static const char IN_FRONT[] = "[0, 0.5, 4]";

/* Degrees by which the pose is turned, about z to the left and about x towards the front. */
static void check_turn(const double q[4], double about_x, double about_z, double tolerance)
{
    check_near(360 / M_PI * asin(q[0]), about_x, tolerance, "turn about x");
    check_near(360 / M_PI * asin(q[2]), about_z, tolerance, "turn about z");
    check_near(q[1], 0, 0.01, "turn about y");
}

static void the_target_is_the_tilt_recorded(void **state)
{
    (void)state;
    write_tilt("tilt", 1);
    DeviceReplay *replay = open_replay("file:tilt", NULL, IN_FRONT);
    check_turn(device_replay_target(replay, SIZE, 0).orientation, 0, 0, 0);
    check_turn(device_replay_target(replay, SIZE, 0.25).orientation, 0, -15, 0.5);
    check_turn(device_replay_target(replay, SIZE, 0.6).orientation, 0, -30, 0.5);
    check_turn(device_replay_target(replay, SIZE, 50).orientation, 0, -30, 0.5); /* unplugged long since */
    device_replay_close(replay);
}

/* Seen from the right, what leans to the right leans towards -z. */
static void right_is_that_of_the_camera(void **state)
{
    (void)state;
    write_tilt("tilt", 1);
    DeviceReplay *replay = open_replay("file:tilt", NULL, "[4, 0.5, 0]");
    check_turn(device_replay_target(replay, SIZE, 1).orientation, -30, 0, 0.5);
    device_replay_close(replay);
}

/* The same bits for any number and order of questions. */
static void the_pose_depends_on_the_time_alone(void **state)
{
    (void)state;
    write_tilt("tilt", 1);
    DeviceReplay *back = open_replay("file:tilt", NULL, IN_FRONT);
    for (int i = 7; i > 0; i--) {
        DeviceReplay *often = open_replay("file:tilt", NULL, IN_FRONT);
        const double time = 0.1 * i;
        for (int k = 0; k < 70 * i; k++)
            device_replay_target(often, SIZE, 0.0014 * k);
        const BoxTarget whole = device_replay_target(back, SIZE, time),
                        parts = device_replay_target(often, SIZE, time);
        assert_memory_equal(&whole, &parts, sizeof whole);
        device_replay_close(often);
    }
    device_replay_close(back);
}

/* A rate, as built in, goes on between two reports, but not without end. */
static void what_is_held_goes_on(void **state)
{
    (void)state;
    write_push("push");
    DeviceReplay *replay = open_replay("file:push", NULL, IN_FRONT);
    check_near(device_replay_target(replay, SIZE, 0.4).position[0], 0, 0, "before");
    check_near(device_replay_target(replay, SIZE, 0.9).position[0], 0.4 * HAND_SPEED, 0.02, "a moment later");
    const double way = device_replay_target(replay, SIZE, 1.4).position[0];
    check_near(way, CONTROL_SILENCE * HAND_SPEED, 0.02, "silent");
    check_near(device_replay_target(replay, SIZE, 9).position[0], way, 1e-6, "unplugged");
    device_replay_close(replay);
}

static void a_mapping_is_obeyed(void **state)
{
    (void)state;
    write_push("push");
    write_text("map.yaml", "spacemouse: {axes: {x: {to: move_y, as: offset}}}\n");
    DeviceReplay *replay = open_replay("file:push", "map.yaml", IN_FRONT);
    check_vector(device_replay_target(replay, SIZE, 1).position, 0, HAND_SWAY, 0, 1e-6, "pushed");
    device_replay_close(replay);
}

/* Cross: the box goes home, upright, and the pad's present pose becomes neutral. */
static void buttons_of_the_box_are_obeyed(void **state)
{
    (void)state;
    double time = 0, degrees = 0;
    FILE *file = fopen("home", "w");
    fprintf(file, "%s%s", HEAD, PAD);
    put_pad(file, &time, &degrees, -100, 0.3, 0);
    put_pad(file, &time, &degrees, 0, 0.2, 0);
    put_pad(file, &time, &degrees, 0, 0.2, 0x20);
    put_pad(file, &time, &degrees, 50, 0.2, 0);
    put_pad(file, &time, &degrees, 0, 0.2, 0);
    fclose(file);
    DeviceReplay *replay = open_replay("file:home", NULL, IN_FRONT);
    check_turn(device_replay_target(replay, SIZE, 0.49).orientation, 0, -30, 0.5);
    check_turn(device_replay_target(replay, SIZE, 0.69).orientation, 0, 0, 0.1);
    check_turn(device_replay_target(replay, SIZE, 1.1).orientation, 0, 10, 0.5);
    device_replay_close(replay);
}

static void what_is_wrong_is_told(void **state)
{
    (void)state;
    const Scene scene = scene_seen_from(IN_FRONT);
    write_tilt("tilt", 0.5);
    write_text("text", "hello\n");
    write_text("map.yaml", "spacemouse: {axes: {q: {to: move_x}}}\n");
    assert_null(device_replay_open("file:none", NULL, &scene, &error));
    assert_contains(error.message, "none: cannot be opened");
    assert_null(device_replay_open("file:text", NULL, &scene, &error));
    assert_contains(error.message, "text:1: this is no recording of devices");
    assert_null(device_replay_open("file:tilt", "map.yaml", &scene, &error));
    assert_contains(error.message, "map.yaml:1:");
    device_replay_close(NULL);
}

/* As the command line opens it. */
static void open_session(Session *session, const char *threads)
{
    static Args args;
    char *argv[] = {"slosh",    "run",       "a.yaml",    "-o",           "a.h5part",
                    "--device", "file:tilt", "--threads", (char *)threads};
    args_free(&args);
    if (!args_parse(cli_commands, (int)(sizeof argv / sizeof *argv), argv, &args, &error) ||
        session_open(session, &args, false, &error) != 0)
        fail_msg("%s", error.message);
}

static void go_to(Session *session, double time)
{
    while (!session_reached(session, time))
        if (!session_step(session, &error))
            fail_msg("%s", error.message);
}

static void the_box_follows_to_the_same_bits(void **state)
{
    (void)state;
    Session one = {.run.world = NULL}, other = one, resumed = one;
    WorldState middle = {.count = 0};
    write_tilt("tilt", 0.8);
    write_text("a.yaml", "box: {size: [1, 1, 1]}\nparticles: {spacing: 0.12}\n"
                         "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]\n"
                         "solver: {sound_speed: 12, step: {dt: 0.01, substeps: 3}}\n"
                         "view: {camera: {from: [0, 0.5, 4], to: [0, 0.5, 0]}}\n");
    open_session(&one, "1");
    open_session(&other, "2");
    open_session(&resumed, "1");
    go_to(&one, 0.25); /* during the turn */
    assert_true(world_save(one.run.world, &middle, &error));
    assert_true(fabs(one.run.info.box.orientation[2]) > 0.005);
    assert_true(world_load(resumed.run.world, &middle, &error));
    world_info(resumed.run.world, &resumed.run.info);
    go_to(&one, 1.5);
    go_to(&other, 1.5);
    go_to(&resumed, 1.5);
    check_turn(one.run.info.box.orientation, 0, -30, 1);
    assert_true(world_hash(one.run.world) == world_hash(other.run.world));
    assert_true(world_hash(one.run.world) == world_hash(resumed.run.world));
    assert_memory_equal(&one.run.info.box, &resumed.run.info.box, sizeof one.run.info.box);
    world_state_free(&middle);
    session_close(&one);
    session_close(&other);
    session_close(&resumed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_target_is_the_tilt_recorded, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(right_is_that_of_the_camera, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(the_pose_depends_on_the_time_alone, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_held_goes_on, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(a_mapping_is_obeyed, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(buttons_of_the_box_are_obeyed, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_wrong_is_told, folder_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(the_box_follows_to_the_same_bits, folder_setup, folder_teardown),
    };
    setenv("XDG_CONFIG_HOME", "/nowhere", 1); /* no mapping of the user's own */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
