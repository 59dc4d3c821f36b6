/* The solver's thread, from the thread of the window: time, commands, sessions, ends. The pictures' thread
   takes states meanwhile, as the window does; ThreadSanitizer watches. */
#include "tests/app/output_fixture.h"
#include "tests/patience.h"

#include "app/run/offscreen.h"
#include "app/run/session.h"
#include "app/run/simulator.h"
#include "sim/start/start.h"

#include <math.h>
#include <stdatomic.h>

static const char still[] = "box: {size: [1, 1, 1]}\n"
                            "particles: {spacing: 0.1}\n"
                            "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]\n"
                            "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n";

static Headless *context;
static Error error;

typedef struct Rig {
    Scene scene;
    Recording recording;
    Upload *upload;
    Simulator *simulator;
    SimulatorStatus status;
    ParticleBuffers particles;
} Rig;

static void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

static void rig_open_woken(Rig *rig, const char *setting, bool paused, void (*wake)(void))
{
    SceneSettings settings = {.count = setting ? 1 : 0};
    if (setting)
        settings.set[0] = setting;
    *rig = (Rig){.upload = NULL};
    must(scene_parse("a.yaml", still, strlen(still), &settings, &rig->scene, NULL, &error));
    must(recording_create(&rig->recording, "a.yaml", still, strlen(still), &settings, &error));
    rig->upload = upload_create(seed_count(&rig->scene.world, rig->scene.world.spacing),
                                PARTICLE_SCALAR(SCALAR_SPEED), &error);
    const SimulatorSetup setup = {.scene = &rig->scene,
                                  .recording = &rig->recording,
                                  .upload = rig->upload,
                                  .paused = paused,
                                  .wake = wake};
    rig->simulator = simulator_create(&setup, &error);
    assert_non_null(rig->simulator);
}

static void rig_open(Rig *rig, const char *setting, bool paused)
{
    rig_open_woken(rig, setting, paused, NULL);
}

static void rig_close(Rig *rig)
{
    assert_true(simulator_destroy(rig->simulator, PATIENCE_MS));
    upload_destroy(rig->upload);
    recording_destroy(&rig->recording);
}

/* Draws along until `ready` says so. */
static void wait_for(Rig *rig, bool (*ready)(const Rig *rig))
{
    const double until = wall_ms() + PATIENCE_MS;
    do {
        simulator_status(rig->simulator, &rig->status);
        if (upload_has_new(rig->upload))
            assert_true(upload_take(rig->upload, &rig->particles));
        usleep(200);
    } while (!ready(rig) && wall_ms() < until);
    assert_true(ready(rig));
}

static bool is_ready(const Rig *rig)
{
    return rig->status.ready && rig->particles.count > 0;
}

static bool has_shown_all(const Rig *rig)
{
    return is_ready(rig) && rig->particles.step == rig->status.step;
}

/* Idle, without pending work. */
static bool rests(const Rig *rig)
{
    return has_shown_all(rig) && rig->status.rests;
}

static bool is_at_15(const Rig *rig)
{
    return rig->status.step == 15 && rig->particles.step == 15;
}

static bool is_past_3000(const Rig *rig)
{
    return rig->particles.step > 3000;
}

static bool is_back(const Rig *rig)
{
    return rig->status.step == 0 && rig->particles.step == 0;
}

static bool has_saved(const Rig *rig)
{
    return rig->status.saves == 1;
}

static bool has_failed(const Rig *rig)
{
    return rig->status.failed;
}

static bool has_messages(const Rig *rig)
{
    return rig->status.messages > 0;
}

static void paused_it_steps_by_frames(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, true);
    wait_for(&rig, is_ready);
    wait_for(&rig, rests);
    assert_int_equal(rig.status.step, 0);
    for (int i = 1; i <= 3; i++) {
        simulator_single_step(rig.simulator, false);
        do
            wait_for(&rig, has_shown_all);
        while (rig.status.step < 5 * (uint64_t)i);
    }
    wait_for(&rig, rests);
    assert_true(is_at_15(&rig));
    assert_true(fabs(rig.status.time - 0.03) < 1e-9);
    simulator_reset(rig.simulator);
    wait_for(&rig, is_back);
    rig_close(&rig);
}

/* A press counts though the reset before it, or the frame, is not done yet. */
static void no_press_of_the_step_key_is_lost(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, true);
    wait_for(&rig, is_ready);
    simulator_reset(rig.simulator);
    for (int i = 0; i < 3; i++)
        simulator_single_step(rig.simulator, false);
    wait_for(&rig, is_at_15);
    simulator_single_step(rig.simulator, false); /* what is still asked for when a reset comes is not done */
    simulator_reset(rig.simulator);
    wait_for(&rig, is_back);
    rig_close(&rig);
}

static double wanted_time;

static bool has_come_there(const Rig *rig)
{
    return rig->status.time >= wanted_time;
}

/* Until so many seconds more are simulated; how many passed meanwhile, by the clock. */
static double passed_in(Rig *rig, double seconds)
{
    const double began = wall_ms();
    simulator_status(rig->simulator, &rig->status);
    wanted_time = rig->status.time + seconds;
    wait_for(rig, has_come_there);
    return 1e-3 * (wall_ms() - began);
}

/* In real time, time stays behind the clock times the speed. Exceptions: the tenth of a second for
   catching up, and the current frame, however busy the machine is. At the least speed the next frame is
   due in a minute: earlier frames are not of real time. */
static void time_follows_the_clock(void **state)
{
    (void)state;
    static const double CAUGHT_UP = 0.1, FRAME = 0.01, LEAST = 1.0 / 6000;
    Rig rig;
    rig_open(&rig, NULL, false);
    wait_for(&rig, is_ready);
    assert_true(passed_in(&rig, 0.4) >= 0.4 - CAUGHT_UP - 2 * FRAME);
    simulator_set_speed(rig.simulator, 0.25);
    assert_true(passed_in(&rig, 0.1) >= (0.1 - 2 * FRAME) / 0.25 - CAUGHT_UP);
    simulator_set_speed(rig.simulator, LEAST);
    simulator_set_realtime(rig.simulator, false);
    passed_in(&rig, 5 * FRAME);
    simulator_pause(rig.simulator, true);
    wait_for(&rig, rests);
    const double paused = rig.status.time;
    simulator_set_realtime(rig.simulator, true);
    simulator_set_speed(rig.simulator, 1);
    wait_for(&rig, rests);
    assert_true(rig.status.time == paused);
    simulator_pause(rig.simulator, false);
    passed_in(&rig, 5 * FRAME);
    rig_close(&rig);
}

static uint64_t send_target(Rig *rig, double x)
{
    return simulator_send(rig->simulator,
                          &(SimCommand){.kind = SIM_TARGET, .target = {{x, 0, 0}, {0, 0, 0, 1}}});
}

/* Commands have numbers, and a state names the last applied command. */
static void states_tell_what_they_obey(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, true);
    wait_for(&rig, is_ready);
    assert_int_equal(send_target(&rig, 0.1), 1);
    assert_int_equal(send_target(&rig, 0.2), 2); /* in the place of the first */
    assert_int_equal(simulator_applied(rig.simulator, 0), 0);
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 5);
    assert_int_equal(simulator_applied(rig.simulator, 5), 2);
    assert_int_equal(simulator_applied(rig.simulator, 0), 0);
    assert_true(rig.particles.box.position[0] > 0);
    rig_close(&rig);
}

/* While time stands still all sent commands wait, without limit. `values`: settings as values; a recording
   has their text. */
static void check_what_waits(bool values)
{
    Rig rig;
    uint64_t sent = 0;
    rig_open(&rig, NULL, true);
    wait_for(&rig, is_ready);
    for (int i = 0; i <= 1000; i++) {
        SimCommand set = {.kind = values ? SIM_VALUE : SIM_SET};
        if (values)
            set.value = (SettingValue){.key = scene_key_find("gravity"), .number = {0, -i, 0}};
        else
            snprintf(set.setting, sizeof set.setting, "gravity=[0, %d, 0]", -i);
        assert_int_equal(simulator_send(rig.simulator, &set), ++sent);
        assert_int_equal(send_target(&rig, 1e-3 * i), ++sent);
    }
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 5);
    assert_int_equal(simulator_applied(rig.simulator, 5), sent);
    simulator_save(rig.simulator, "a.rec");
    wait_for(&rig, has_saved);
    rig_close(&rig);
    Recording recording;
    must(recording_read("a.rec", &recording, &error));
    assert_int_equal(recording.count, 2);
    assert_string_equal(recording.commands[0].setting, "gravity=[0, -1000, 0]");
    assert_true(recording.commands[1].target.position[0] == 1);
    recording_destroy(&recording);
}

static void what_waits_is_replaced(void **state)
{
    (void)state;
    check_what_waits(false);
    check_what_waits(true);
}

/* Waiting box commands belong to the old session; settings stay. */
static void a_reset_forgets_poses(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, true);
    wait_for(&rig, is_ready);
    SimCommand set = {.kind = SIM_SET, .setting = "gravity=[0, -3, 0]"};
    assert_true(simulator_send(rig.simulator, &set) > 0);
    send_target(&rig, 0.5);
    simulator_reset(rig.simulator);
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 5);
    assert_true(rig.particles.box.position[0] == 0);
    simulator_save(rig.simulator, "a.rec");
    wait_for(&rig, has_saved);
    rig_close(&rig);
    Recording recording;
    must(recording_read("a.rec", &recording, &error));
    assert_int_equal(recording.count, 1);
    assert_string_equal(recording.commands[0].setting, set.setting);
    recording_destroy(&recording);
}

/* A save is of the session at the request, and completes even if all ends at once. */
static void a_save_keeps_its_place(void **state)
{
    (void)state;
    Rig rig;
    Recording recording;
    rig_open(&rig, NULL, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 20);
    assert_true(simulator_save(rig.simulator, "before.rec"));
    assert_false(simulator_save(rig.simulator, "none.rec")); /* in sequence */
    simulator_reset(rig.simulator);
    wait_for(&rig, has_saved);
    simulator_pause(rig.simulator, true);
    simulator_reset(rig.simulator);
    assert_true(simulator_save(rig.simulator, "after.rec"));
    rig_close(&rig);
    must(recording_read("before.rec", &recording, &error));
    assert_true(recording.steps >= 20);
    recording_destroy(&recording);
    must(recording_read("after.rec", &recording, &error));
    assert_true(recording.steps == 0);
    recording_destroy(&recording);
    assert_false(exists("none.rec"));
}

/* A session of random commands in a running simulation gives the same bits in a replay; a reset keeps
   settings. */
static void a_saved_session_gives_the_same_bits(void **state)
{
    (void)state;
    Rig rig;
    static Session session;
    Recording recording;
    rig_open(&rig, NULL, false);
    wait_for(&rig, is_ready);
    SimCommand set = {.kind = SIM_SET, .setting = "gravity=[0, -3, 0]"};
    const uint64_t sent = simulator_send(rig.simulator, &set);
    assert_true(sent > 0);
    do
        wait_for(&rig, is_ready);
    while (simulator_applied(rig.simulator, rig.status.step) < sent);
    simulator_reset(rig.simulator);
    simulator_set_realtime(rig.simulator, false); /* always within a frame */
    wait_for(&rig, is_ready);
    for (int i = 0; !is_past_3000(&rig) && i < 100000; i++) {
        send_target(&rig, 0.2 * sin(i));
        wait_for(&rig, is_ready);
    }
    assert_true(is_past_3000(&rig));
    simulator_save(rig.simulator, "a.rec");
    wait_for(&rig, has_saved);
    assert_true(rig.status.saved);
    rig_close(&rig);

    must(recording_read("a.rec", &recording, &error));
    assert_true(recording.count > 10 && recording.steps > 3000 && !recording.cut);
    assert_int_equal(recording.commands[0].kind, SIM_SET);
    RecordingPlay play = {.path = "a.rec", .recording = &recording};
    must(recording_play_open(&play, NULL, HEADLESS_GPU_AUTO, false, &session, &error) == 0);
    bool within_a_frame = false;
    while (recording_play_apply(&play, &session, &error) && !recording_play_ended(&play, &session)) {
        within_a_frame |= play.next > 0 && recording.commands[play.next - 1].step % 5 != 0;
        must(session_substep(&session, &error));
    }
    assert_true(within_a_frame);
    assert_true(world_hash(session.run.world) == recording.hash);
    session_close(&session);
    recording_destroy(&recording);
}

static void saving_may_fail(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, false);
    wait_for(&rig, is_ready);
    simulator_save(rig.simulator, "none/a.rec");
    wait_for(&rig, has_saved);
    assert_false(rig.status.saved);
    assert_non_null(strstr(rig.status.save_message, "none"));
    rig_close(&rig);
}

/* A wrong setting is reported without effect; a blow-up stops, and a reset restarts. */
static void trouble_is_told(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, false);
    wait_for(&rig, is_ready);
    SimCommand set = {.kind = SIM_SET, .setting = "particles.spacing=0.05"};
    assert_true(simulator_send(rig.simulator, &set) > 0);
    wait_for(&rig, has_messages);
    assert_false(rig.status.failed);
    assert_non_null(strstr(rig.status.message, "particles.spacing"));
    rig_close(&rig);

    rig_open(&rig, "solver.step.dt=1", false);
    wait_for(&rig, has_failed);
    assert_non_null(strstr(rig.status.message, "blew up"));
    simulator_reset(rig.simulator);
    rig.status.failed = false;
    wait_for(&rig, has_failed); /* the same again */
    rig_close(&rig);
}

static atomic_bool holds, held;

/* Keeps the solver's thread within a frame, as a step without an end would. */
static void hold(void)
{
    while (atomic_load(&holds)) {
        atomic_store(&held, true);
        usleep(200);
    }
}

static bool is_held(const Rig *rig)
{
    (void)rig;
    return atomic_load(&held);
}

/* A step longer than the patience: the thread is abandoned, and ends later. */
static void an_end_does_not_wait_for_ever(void **state)
{
    (void)state;
    Rig rig;
    atomic_store(&holds, true);
    rig_open_woken(&rig, NULL, false, hold);
    wait_for(&rig, is_held);
    assert_false(simulator_destroy(rig.simulator, 1));
    atomic_store(&holds, false);
    assert_true(simulator_destroy(rig.simulator, PATIENCE_MS));
    upload_destroy(rig.upload);
    recording_destroy(&rig.recording);
}

static bool has_a_gauge_of_now(const Rig *rig)
{
    const int count = rig->status.gauge_count;
    return count > 0 && rig->status.gauges[count - 1].gauge.time == rig->status.time;
}

/* Gauges are taken while somebody looks, after a frame, and begin anew with the scene. */
static void gauges_are_for_who_looks(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, NULL, true);
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 5);
    assert_int_equal(rig.status.gauge_count, 0);
    simulator_watch(rig.simulator, true, true);
    for (int i = 2; i <= 4; i++) {
        usleep(60000); /* more than there is between two */
        simulator_single_step(rig.simulator, false);
        do
            wait_for(&rig, has_a_gauge_of_now);
        while (rig.status.step < 5 * (uint64_t)i);
        assert_int_equal(rig.status.gauge_count, i - 1);
    }
    const GaugeSample *samples = rig.status.gauges;
    assert_true(samples[0].gauge.time < samples[1].gauge.time && samples[1].courant > 0);
    assert_true(samples[1].gauge.potential_energy > 0 && samples[1].limit == STEP_LIMIT_DT);
    simulator_reset(rig.simulator);
    wait_for(&rig, is_back);
    wait_for(&rig, has_a_gauge_of_now);
    assert_int_equal(rig.status.gauge_count, 1);
    rig_close(&rig);
}

/* So are the numbers of probes; a scene without any has none. */
static void probes_are_for_who_looks(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "probes=[{name: a, point: {at: [0, 0, 0]}}, {name: b, height: {at: [0, 0, 0]}}]", true);
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_shown_all);
    while (rig.status.step < 5);
    assert_int_equal(rig.status.probe_count, 0);
    simulator_watch(rig.simulator, true, true);
    usleep(60000);
    simulator_single_step(rig.simulator, false);
    do
        wait_for(&rig, has_a_gauge_of_now);
    while (rig.status.step < 10);
    while (rig.status.probe_count == 0)
        wait_for(&rig, has_shown_all);
    const ProbeSample *sample = rig.status.probes;
    assert_int_equal(rig.status.probe_count, 1);
    assert_true(sample->time == rig.status.time);
    assert_true(sample->value[0] > 0 && sample->value[1] > 0.05F && sample->value[1] < 1);
    rig_close(&rig);
}

static int setup(void **state)
{
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    return context ? folder_setup(state) : -1;
}

static int teardown(void **state)
{
    headless_destroy(context);
    return folder_teardown(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paused_it_steps_by_frames),
        cmocka_unit_test(no_press_of_the_step_key_is_lost),
        cmocka_unit_test(time_follows_the_clock),
        cmocka_unit_test(states_tell_what_they_obey),
        cmocka_unit_test(what_waits_is_replaced),
        cmocka_unit_test(a_reset_forgets_poses),
        cmocka_unit_test(a_save_keeps_its_place),
        cmocka_unit_test(a_saved_session_gives_the_same_bits),
        cmocka_unit_test(saving_may_fail),
        cmocka_unit_test(trouble_is_told),
        cmocka_unit_test(gauges_are_for_who_looks),
        cmocka_unit_test(probes_are_for_who_looks),
        cmocka_unit_test(an_end_does_not_wait_for_ever),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
