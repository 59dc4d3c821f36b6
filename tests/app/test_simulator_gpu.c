/* The solver on the window's thread with a GPU backend; and changes of backend. */
#include "tests/app/output_fixture.h"
#include "tests/patience.h"

#include "app/run/compare/compare.h"
#include "app/run/offscreen.h"
#include "app/run/session.h"
#include "app/run/simulator.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

static const char still[] = "box: {size: [1, 1, 1]}\n"
                            "particles: {spacing: 0.1}\n"
                            "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}]\n"
                            "solver: {backend: compute, reproducible: true, sound_speed: 15, threads: 1,\n"
                            "  step: {dt: 0.01, substeps: 5}}\n";

static Headless *context;
static Error error;

static void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

typedef struct Rig {
    Scene scene;
    Recording recording;
    Upload *upload;
    Simulator *simulator;
    SimulatorStatus status;
} Rig;

static void rig_open_text(Rig *rig, const char *text, bool paused)
{
    SceneSettings settings = {.count = 0};
    *rig = (Rig){.upload = NULL};
    must(scene_parse("a.yaml", text, strlen(text), &settings, &rig->scene, NULL, &error));
    must(recording_create(&rig->recording, "a.yaml", text, strlen(text), &settings, &error));
    const SimulatorSetup setup = {.scene = &rig->scene, .recording = &rig->recording, .paused = paused};
    rig->simulator = simulator_create(&setup, &error);
    assert_non_null(rig->simulator);
    rig->upload =
        upload_create(400, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_SCALAR(SCALAR_ACCELERATION_Y), &error);
}

static void rig_open(Rig *rig, bool paused)
{
    rig_open_text(rig, still, paused);
}

static void rig_close(Rig *rig)
{
    assert_true(simulator_destroy(rig->simulator, PATIENCE_MS));
    upload_destroy(rig->upload);
    recording_destroy(&rig->recording);
}

/* Works until the step or, on a thread, waits for the step. */
static void until_step(Rig *rig, uint64_t step)
{
    const double until = wall_ms() + PATIENCE_MS;
    do {
        simulator_work(rig->simulator, 1);
        usleep(200);
        simulator_status(rig->simulator, &rig->status);
    } while (rig->status.step < step && wall_ms() < until);
    assert_true(rig->status.step >= step);
}

static void it_works_when_asked(void **state)
{
    (void)state;
    Rig rig;
    ParticleBuffers particles;
    rig_open(&rig, true);
    simulator_status(rig.simulator, &rig.status);
    assert_true(rig.status.ready && simulator_on_gpu(rig.simulator) && simulator_fresh(rig.simulator));
    assert_true(isinf(simulator_work(rig.simulator, 5))); /* paused: no step due */
    assert_true(simulator_share(rig.simulator, PARTICLE_SCALAR(SCALAR_SPEED), &particles));
    assert_true(particles.count == 400 && particles.position.buffer && particles.step == 0);
    assert_false(simulator_fresh(rig.simulator));
    simulator_single_step(rig.simulator, false);
    simulator_single_step(rig.simulator, true); /* automatic, while waiting: not counted */
    until_step(&rig, 5);
    assert_true(isinf(simulator_work(rig.simulator, 5)) && simulator_fresh(rig.simulator));
    simulator_status(rig.simulator, &rig.status);
    assert_int_equal(rig.status.step, 5);
    simulator_pause(rig.simulator, false);
    until_step(&rig, 10);
    const double wait = simulator_work(rig.simulator, 1000); /* in real time there is no further work */
    assert_true(wait >= 0 && wait <= 10);
    rig_close(&rig);
}

static void move(Rig *rig, const char *backend)
{
    SimCommand command = {.kind = SIM_SET};
    snprintf(command.setting, sizeof command.setting, "solver.backend=%s", backend);
    char now[NAME_SIZE];
    must(simulator_move(rig->simulator, &command, rig->upload, now, &error));
    assert_string_equal(now, backend);
    assert_int_equal(simulator_on_gpu(rig->simulator), strcmp(backend, "cpu") != 0);
}

/* Of the first particle, m/s2. */
static double acceleration(Rig *rig)
{
    ParticleBuffers particles;
    float a;
    if (simulator_on_gpu(rig->simulator)) {
        must(simulator_share(rig->simulator, PARTICLE_SCALAR(SCALAR_ACCELERATION_Y), &particles));
    } else {
        must(upload_take(rig->upload, &particles));
    }
    const ParticleAttribute *from = &particles.scalar[SCALAR_ACCELERATION_Y];
    assert_true(from->buffer);
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, sizeof a, &a);
    return (double)a;
}

/* From the next step on, over a reset and on another backend too. */
static void accelerations_are_kept_from_when_they_are_asked_for(void **state)
{
    (void)state;
    const SimCommand command = {.kind = SIM_SET, .setting = "solver.acceleration=true"};
    char now[NAME_SIZE];
    Rig rig;
    rig_open(&rig, true);
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    must(simulator_move(rig.simulator, &command, rig.upload, now, &error));
    assert_string_equal(now, "compute");
    assert_true(isnan(acceleration(&rig)));
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 10);
    const double was = acceleration(&rig);
    assert_true(isfinite(was));
    move(&rig, "cpu");
    assert_true(acceleration(&rig) == was);
    simulator_reset(rig.simulator);
    simulator_single_step(rig.simulator, false);
    do {
        usleep(1000);
        simulator_status(rig.simulator, &rig.status);
    } while (rig.status.step != 5);
    assert_true(isfinite(acceleration(&rig)));
    rig_close(&rig);
}

static double height(Rig *rig)
{
    ParticleBuffers particles;
    if (simulator_on_gpu(rig->simulator)) {
        must(simulator_share(rig->simulator, 0, &particles));
    } else {
        must(upload_take(rig->upload, &particles));
    }
    float x[4];
    glGetNamedBufferSubData(particles.position.buffer, (GLintptr)particles.position.offset, sizeof x, x);
    return (double)x[1];
}

/* The state is kept, time goes on, and the recorded session does it all again to the bit. */
static void the_backend_changes_while_it_runs(void **state)
{
    (void)state;
    Rig rig;
    static Session session;
    Recording recording;
    rig_open(&rig, true);
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    const double before = height(&rig);
    move(&rig, "cpu");
    simulator_status(rig.simulator, &rig.status);
    assert_int_equal(rig.status.step, 5);
    assert_true(height(&rig) == before && before > 0);
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 10);
    move(&rig, "compute");
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 15);
    simulator_save(rig.simulator, "moved.rec");
    rig_close(&rig);

    must(recording_read("moved.rec", &recording, &error));
    assert_int_equal(recording.count, 2);
    assert_true(recording.commands[0].step == 5 && recording.commands[1].step == 10);
    RecordingPlay play = {.path = "moved.rec", .recording = &recording};
    headless_destroy(context); /* the session makes its own */
    must(recording_play_open(&play, NULL, HEADLESS_GPU_AUTO, false, &session, &error) == 0);
    while (recording_play_apply(&play, &session, &error) && !recording_play_ended(&play, &session))
        must(session_substep(&session, &error));
    assert_true(world_hash(session.run.world) == recording.hash);
    session_close(&session);
    recording_destroy(&recording);
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    assert_non_null(context);
}

/* A reset begins anew on the backend at hand. */
static void a_reset_stays_on_its_backend(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, true);
    move(&rig, "cpu");
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    simulator_reset(rig.simulator);
    do {
        usleep(1000);
        simulator_status(rig.simulator, &rig.status);
    } while (rig.status.step != 0);
    assert_false(rig.status.failed || simulator_on_gpu(rig.simulator));
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    rig_close(&rig);
}

static void a_backend_that_is_none_changes_nothing(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, true);
    const SimCommand command = {.kind = SIM_SET, .setting = "solver.backend=abacus"};
    char now[NAME_SIZE];
    must(simulator_move(rig.simulator, &command, rig.upload, now, &error));
    simulator_status(rig.simulator, &rig.status);
    assert_string_equal(now, "compute");
    assert_true(rig.status.messages == 1 && strstr(rig.status.message, "abacus") && !rig.status.failed);
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    rig_close(&rig);
}

/* The backend cannot run the scene: the user takes a different backend, and the recording names that
   backend. */
static void a_failed_start_goes_on_elsewhere(void **state)
{
    (void)state;
    static const char solid[] = "box: {size: [1, 1, 1]}\n"
                                "particles: {spacing: 0.1}\n"
                                "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.4, 0.5]}}]}]\n"
                                "solids: [{sphere: {centre: [0.3, 0.2, 0], radius: 0.1}}]\n"
                                "solver: {backend: fragment, threads: 1}\n";
    Rig rig;
    Recording recording;
    static Session session;
    rig_open_text(&rig, solid, true);
    simulator_status(rig.simulator, &rig.status);
    assert_true(rig.status.failed && strstr(rig.status.message, "no solids"));
    move(&rig, "cpu");
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 1);
    simulator_save(rig.simulator, "cpu.rec");
    rig_close(&rig);
    must(recording_read("cpu.rec", &recording, &error));
    RecordingPlay play = {.path = "cpu.rec", .recording = &recording};
    must(recording_play_open(&play, NULL, HEADLESS_GPU_AUTO, false, &session, &error) == 0);
    session_close(&session);
    recording_destroy(&recording);
}

/* Into a copy, the source of later reads. */
static void break_shader(const char *name)
{
    char command[512];
    snprintf(command, sizeof command,
             "rm -rf shaders && cp -r '" SLOSH_SOURCE_DIR "/shaders' . && echo 'float x = ;' >> shaders/%s",
             name);
    assert_int_equal(system(command), 0);
    shader_source_set_directory("shaders");
}

/* Broken shaders during a run: an error, and the last good shaders stay. */
static void broken_shaders_leave_the_last_good_ones(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, true);
    break_shader("sim/compute/kick.comp");
    assert_false(simulator_reload(rig.simulator, &error));
    assert_non_null(strstr(error.message, "sim/compute/kick.comp:"));
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    assert_false(rig.status.failed);
    assert_int_equal(system("cp '" SLOSH_SOURCE_DIR "/shaders/sim/compute/kick.comp' shaders/sim/compute/"),
                     0);
    must(simulator_reload(rig.simulator, &error));
    shader_source_set_directory(NULL);
    rig_close(&rig);
}

/* A gauge is asked for behind the steps, and there some frames later. */
static void gauges_come_late(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, false);
    until_step(&rig, 10);
    assert_int_equal(rig.status.gauge_count, 0);
    simulator_watch(rig.simulator, true, true);
    for (uint64_t step = 20; rig.status.gauge_count < 2 && step < 2000; step += 10)
        until_step(&rig, step);
    assert_true(rig.status.gauge_count >= 2);
    const GaugeSample *samples = rig.status.gauges;
    assert_true(samples[0].gauge.time < samples[1].gauge.time);
    assert_true(samples[1].gauge.potential_energy > 0 && samples[1].courant > 0);
    rig_close(&rig);
}

/* A follower on the GPU that cannot restart shows an empty picture, without freed memory. */
static void what_follows_and_fails_is_empty(void **state)
{
    (void)state;
    static Scene scene;
    char text[sizeof still + 80];
    Notes notes = {.count = 0};
    SceneSettings settings = {.count = 0};
    CompareRuns *compared;
    Simulator *followers[SIMULATOR_FOLLOWERS];
    ParticleBuffers particles;
    Rig rig = {.upload = NULL};
    snprintf(text, sizeof text, "%sviews: [{}, {set: {solver.method: dfsph}}]\n", still);
    must(scene_parse("a.yaml", text, strlen(text), &settings, &scene, NULL, &error) &&
         recording_create(&rig.recording, "a.yaml", text, strlen(text), &settings, &error));
    const CompareSetup reads = {.scene = &scene, .text = text, .size = strlen(text), .settings = &settings};
    must(compare_read(&reads, &compared, &notes, &error));
    SimulatorSetup setup = {.scene = &scene, .recording = &rig.recording, .paused = true};
    must(compare_start(compared, &setup, &error));
    setup.followers = followers;
    setup.follower_count = compare_followers(compared, followers);
    assert_int_equal(setup.follower_count, 1);
    rig.simulator = simulator_create(&setup, &error);
    assert_non_null(rig.simulator);
    simulator_single_step(rig.simulator, false);
    until_step(&rig, 5);
    const ParticleBuffers *shown = compare_state(compared, &scene.views[1]);
    assert_true(compare_take(compared, rig.status.time));
    assert_true(shown->count == 400 && shown->position.buffer);
    must(simulator_share(rig.simulator, PARTICLE_SCALAR(SCALAR_SPEED), &particles));
    simulator_step_back(rig.simulator, false); /* without a past nothing is new */
    do {
        simulator_work(rig.simulator, 1);
        simulator_status(rig.simulator, &rig.status);
    } while (rig.status.timeline.travelling);
    assert_true(!simulator_fresh(rig.simulator) && !compare_has_new(compared));
    break_shader("sim/dfsph/force.comp");
    simulator_reset(rig.simulator);
    do {
        simulator_work(rig.simulator, 1);
        simulator_status(rig.simulator, &rig.status);
    } while (rig.status.step != 0);
    shader_source_set_directory(NULL);
    compare_take(compared, rig.status.time);
    assert_true(shown->count == 0 && !shown->position.buffer && !shown->births);
    assert_true(compare_message(compared, (char[1280]){0}));
    assert_false(rig.status.failed);
    assert_true(simulator_destroy(rig.simulator, PATIENCE_MS));
    compare_destroy(compared);
    recording_destroy(&rig.recording);
}

static int setup(void **state)
{
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    backends_add();
    return context && folder_setup(state) == 0 ? 0 : -1;
}

static int teardown(void **state)
{
    headless_destroy(context);
    return folder_teardown(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_works_when_asked),
        cmocka_unit_test(the_backend_changes_while_it_runs),
        cmocka_unit_test(accelerations_are_kept_from_when_they_are_asked_for),
        cmocka_unit_test(a_reset_stays_on_its_backend),
        cmocka_unit_test(a_backend_that_is_none_changes_nothing),
        cmocka_unit_test(a_failed_start_goes_on_elsewhere),
        cmocka_unit_test(gauges_come_late),
        cmocka_unit_test(broken_shaders_leave_the_last_good_ones),
        cmocka_unit_test(what_follows_and_fails_is_empty),
    };
    return cmocka_run_group_tests_name("app.simulator_gpu", tests, setup, teardown);
}
