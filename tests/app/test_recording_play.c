/* A recorded session gives the same bits in a second simulation. */
#include "tests/app/output_fixture.h"

#include "app/run/session.h"

#include <math.h>

static const char scene_text[] =
    "box: {size: [1, 1, 1]}\r\n"
    "particles: {spacing: 0.1}\n"
    "fluids:\n"
    "  - fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.5, 0.5]}}]\n"
    "  - {density: 900, fill: [{block: {min: [0, 0, -0.5], max: [0.5, 0.5, 0.5]}}]}\n"
    "solver: {sound_speed: 12}\n"
    "motion: [{rock: {axis: [0, 0, 1], angle: 10, frequency: 1}}]";

static Error error;

/* A session as the window has it: commands are applied between substeps, and recorded. */
typedef struct Live {
    Scene scene;
    World *world;
    Recording recording;
} Live;

static void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

static void live_open(Live *live)
{
    SceneSettings settings = {
        .count = 3,
        .set = {"solver.threads=1", "solver.step.dt=0.004", "gravity=[0,\n -9, 0]"},
        .particles = 400,
    };
    must(scene_parse("a.yaml", scene_text, strlen(scene_text), &settings, &live->scene, NULL, &error));
    must(recording_create(&live->recording, "a.yaml", scene_text, strlen(scene_text), &settings, &error));
    live->world = world_create(&live->scene.world, &error);
    assert_non_null(live->world);
}

static void live_do(Live *live, SimCommand command)
{
    WorldInfo info;
    world_info(live->world, &info);
    command.step = info.step;
    assert_true(recording_add(&live->recording, &command));
    must(sim_command_apply(&command, &live->world, &live->scene, &error));
}

static void live_target(Live *live, SimCommandKind kind, double x, double angle)
{
    live_do(live, (SimCommand){.kind = kind, .target = {{x, 0.1 * x, 0}, {0, 0, sin(angle), cos(angle)}}});
}

static void live_set(Live *live, const char *setting)
{
    SimCommand command = {.kind = SIM_SET};
    snprintf(command.setting, sizeof command.setting, "%s", setting);
    live_do(live, command);
}

static void live_frames(Live *live, int frames)
{
    for (int i = 0; i < frames; i++)
        must(world_step(live->world, NULL, &error));
}

static void live_substep(Live *live)
{
    must(world_substep(live->world, NULL, &error));
}

/* Some hundred steps with every kind of command, at a frame's end and within one, written to a.rec. */
static void record(uint64_t *hash)
{
    static Live live;
    WorldInfo info;
    live_open(&live);
    for (int i = 0; i < 20; i++) {
        live_target(&live, SIM_TARGET, 0.1 * sin(0.7 * i + 0.5), 0.05 * i);
        live_frames(&live, 1);
        live_substep(&live);
    }
    live_set(&live, "gravity=[0, -3,\n 0.5]");
    live_set(&live, "fluids[1].viscosity=50");
    live_set(&live, "view.range=[0, 1]");
    live_frames(&live, 10);
    live_set(&live, "solver.step.substeps=3");
    live_set(&live, "solver.step.dt=0.003");
    live_frames(&live, 10);
    live_target(&live, SIM_CARRY, -0.2, 0.3);
    live_substep(&live);
    live_set(&live, "solver.step.substeps=5");
    live_frames(&live, 10);
    live_target(&live, SIM_TARGET, 0, 0);
    world_info(live.world, &info);
    *hash = world_hash(live.world);
    assert_true(info.step > 200);
    must(recording_write(&live.recording, info.step, *hash, "a.rec", &error));
    world_destroy(live.world);
    recording_destroy(&live.recording);
}

/* Simulates the recording; false where it cannot be. */
static bool play(const Recording *recording, const SceneSettings *more, uint64_t *hash, int *threads)
{
    static Session session;
    RecordingPlay play = {.path = "a.rec", .recording = recording};
    bool ok = recording_play_open(&play, more, HEADLESS_GPU_AUTO, false, &session, &error) == 0;
    while (ok && (ok = recording_play_apply(&play, &session, &error)) &&
           !recording_play_ended(&play, &session))
        ok = session_substep(&session, &error);
    if (ok) {
        *hash = world_hash(session.run.world);
        *threads = session.run.info.threads;
        assert_true(session.run.info.step == recording->steps);
    }
    session_close(&session);
    return ok;
}

static void the_same_bits_come_out(void **state)
{
    (void)state;
    uint64_t recorded, hash;
    int threads;
    Recording recording;
    const SceneSettings one = {.count = 1, .set = {"solver.threads=1"}};
    const SceneSettings two = {.count = 1, .set = {"solver.threads=2"}};
    record(&recorded);
    must(recording_read("a.rec", &recording, &error));
    assert_true(recording.hash == recorded);
    must(play(&recording, &one, &hash, &threads));
    assert_true(hash == recorded && threads == 1);
    must(play(&recording, &two, &hash, &threads));
    assert_true(hash == recorded && threads == 2);
    recording_destroy(&recording);
}

/* Each command counts, except commands ignored by solvers. */
static void other_commands_give_other_bits(void **state)
{
    (void)state;
    uint64_t recorded, hash;
    int threads;
    Recording recording;
    record(&recorded);
    must(recording_read("a.rec", &recording, &error));
    for (size_t i = 0; i < recording.count; i++) {
        const SimCommand kept = recording.commands[i];
        const char *setting = kept.kind == SIM_SET ? kept.setting : "";
        const bool counts = i + 1 < recording.count && !strstr(setting, "view.");
        recording.commands[i] = (SimCommand){kept.step, SIM_SET, {.setting = "title=none"}};
        must(play(&recording, NULL, &hash, &threads));
        assert_true((hash != recorded) == counts);
        recording.commands[i] = kept;
    }
    recording_destroy(&recording);
}

static Recording with_command(uint64_t steps, SimCommand command)
{
    Recording recording;
    must(recording_create(&recording, "a.yaml", scene_text, strlen(scene_text), NULL, &error));
    recording.steps = steps;
    recording.command_line = 20;
    assert_true(recording_add(&recording, &command));
    return recording;
}

static void refuse(uint64_t steps, SimCommand command, const char *message)
{
    uint64_t hash;
    int threads;
    Recording recording = with_command(steps, command);
    assert_false(play(&recording, NULL, &hash, &threads));
    if (strncmp(error.message, message, strlen(message)) != 0)
        fail_msg("expected '%s'\n     got '%s'", message, error.message);
    recording_destroy(&recording);
}

static void slips_are_named(void **state)
{
    (void)state;
    refuse(0, (SimCommand){0, SIM_SET, {.setting = "gravty=0"}},
           "a.rec:20: --set gravty=0: unknown key 'gravty'; did you mean 'gravity'?");

    Recording recording = with_command(0, (SimCommand){0, SIM_SET, {.setting = "title=a"}});
    const SceneSettings bad = {.count = 1, .set = {"solver.threads=-1"}};
    RecordingPlay play = {.path = "a.rec", .recording = &recording};
    static Session session;
    assert_int_equal(recording_play_open(&play, &bad, HEADLESS_GPU_AUTO, false, &session, &error), 2);
    assert_contains(error.message, "a.rec: its scene: --set solver.threads=-1: solver.threads must be ");
    recording_destroy(&recording);
}

/* A setting that is refused changes neither world nor scene. */
static void a_refused_setting_changes_nothing(void **state)
{
    (void)state;
    static Live live;
    static Scene before;
    live_open(&live);
    const uint64_t hash = world_hash(live.world);
    memcpy(&before, &live.scene, sizeof before);
    const SimCommand command = {0, SIM_SET, {.setting = "particles.spacing=0.1"}};
    assert_false(sim_command_apply(&command, &live.world, &live.scene, &error));
    assert_contains(error.message, "particles.spacing cannot change while the simulation runs");
    assert_memory_equal(&before, &live.scene, sizeof before);
    assert_true(hash == world_hash(live.world));
    world_destroy(live.world);
    recording_destroy(&live.recording);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bits_come_out),
        cmocka_unit_test(other_commands_give_other_bits),
        cmocka_unit_test(slips_are_named),
        cmocka_unit_test(a_refused_setting_changes_nothing),
    };
    return cmocka_run_group_tests(tests, folder_setup, folder_teardown);
}
