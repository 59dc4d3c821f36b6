/* Touch in a session: its commands apply in their order, a recording has the same bits again, going back
   undoes, a new start forgets. */
#include "tests/history/history_rig.h"

#define BOX                                                                                                  \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles: {spacing: 0.1}\n"                                                                            \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.6, 0.5]}}]}]\n"

static const struct {
    const char *name, *text;
} scenes[] = {
    {"cpu", BOX "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n"},
    {"dfsph", BOX "solver: {method: dfsph, threads: 2, step: {dt: 0.01, substeps: 2}}\n"},
    {"compute",
     BOX "solver: {backend: compute, reproducible: true, sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"},
    {"fragment", BOX "solver: {backend: fragment, sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"},
};
enum { SCENES = sizeof scenes / sizeof *scenes, FRAMES = 10, MIB = 1 << 20 };

static void touch(Rig *rig, FingerWay way, double x)
{
    const SimCommand command = {.kind = SIM_TOUCH,
                                .finger = {.way = way, .at = {x, 0.4, 0}, .radius = 1.0 / 3, .strength = 30}};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

static bool touched(Rig *rig)
{
    WorldInfo info;
    rig_turn(rig);
    world_info(rig->simulator->run.world, &info);
    return info.touched;
}

/* A stroke from frame 2 to frame 6, by which the states differ from those without. */
static void stroke(Rig *rig, uint64_t hash[FRAMES + 1])
{
    rig_ready(rig);
    hash[0] = rig_hash(rig);
    for (int i = 1; i <= FRAMES; i++) {
        if (i >= 2 && i <= 6)
            touch(rig, i == 6 ? FINGER_NONE : FINGER_STIR, 0.05 * i);
        rig_step(rig);
        hash[i] = rig_hash(rig);
    }
}

static void it_is_replayed_and_undone(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        uint64_t hash[FRAMES + 1];
        Rig rig;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        stroke(&rig, hash);
        rig_save(&rig, "a.rec");
        for (int i = FRAMES - 1; i >= 0; i--) {
            rig_back(&rig);
            if (rig_hash(&rig) != hash[i] || touched(&rig) != (i >= 2 && i <= 5))
                fail_msg("%s: frame %d is another one", scenes[s].name, i);
        }
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == hash[FRAMES]);
        rig_close(&rig);
        assert_true(replay("a.rec") > 0);
    }
}

/* The recording moves the fluid: without touch the bits differ. */
static void the_recording_has_it(void **state)
{
    (void)state;
    uint64_t hash[FRAMES + 1];
    Recording saved;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    stroke(&rig, hash);
    rig_save(&rig, "a.rec");
    rig_close(&rig);
    must(recording_read("a.rec", &saved, &error));
    assert_int_equal(saved.count, 5);
    for (size_t i = 0; i < saved.count; i++) {
        assert_int_equal(saved.commands[i].kind, SIM_TOUCH);
        assert_true(saved.commands[i].finger.way == (double)(i < 4 ? FINGER_STIR : FINGER_NONE));
    }
    assert_true(saved.commands[0].finger.at[0] == 0.05 * 2 && saved.commands[0].finger.strength == 30 &&
                saved.commands[0].finger.radius == 1.0 / 3);
    recording_destroy(&saved);
    Rig plain;
    rig_open(&plain, scenes[0].text, 64 * MIB);
    rig_ready(&plain);
    for (int i = 0; i < FRAMES; i++)
        rig_step(&plain);
    assert_true(rig_hash(&plain) != hash[FRAMES]);
    rig_close(&plain);
}

static size_t commands_of(Rig *rig)
{
    rig_turn(rig);
    return rig->simulator->recording.count;
}

/* Among commands waiting for a step: the last place wins, a stroke that ends before the step leaves no
   trace, and a finger returning elsewhere does not draw fluid along the way. */
static void commands_of_one_step(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    rig_ready(&rig);
    touch(&rig, FINGER_STIR, 0); /* while paused, as all here */
    touch(&rig, FINGER_STIR, 0.1);
    touch(&rig, FINGER_STIR, 0.2);
    rig_step(&rig);
    assert_true(touched(&rig) && commands_of(&rig) == 1);
    touch(&rig, FINGER_NONE, 0);
    touch(&rig, FINGER_STIR, -0.4);
    rig_step(&rig);
    assert_true(touched(&rig) && commands_of(&rig) == 3);
    WorldState saved = {.count = 0};
    must(world_save(rig.simulator->run.world, &saved, &error));
    assert_true(saved.numbers.finger.point[0] == -0.4);
    world_state_free(&saved);
    touch(&rig, FINGER_STIR, 0.3);
    touch(&rig, FINGER_PULL, 0.3);
    touch(&rig, FINGER_NONE, 0);
    rig_target(&rig, 0.1);
    rig_step(&rig);
    assert_true(!touched(&rig) && commands_of(&rig) == 5);
    rig_save(&rig, "a.rec");
    rig_close(&rig);
    assert_true(replay("a.rec") > 0);
}

static void restart(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    simulator_reset(rig->simulator);
    do
        rig_turn(rig);
    while (rig->status.frames > 0 && wall_ms() < until);
}

static void a_new_start_has_no_finger(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    rig_ready(&rig);
    const uint64_t begin = rig_hash(&rig);
    touch(&rig, FINGER_PUSH, 0);
    rig_step(&rig);
    touch(&rig, FINGER_PUSH, 0.1); /* waits, and is of the session before */
    restart(&rig);
    rig_step(&rig);
    assert_false(touched(&rig));
    assert_int_equal(commands_of(&rig), 0);
    rig_go(&rig, 0);
    assert_true(rig_hash(&rig) == begin);
    rig_close(&rig);
}

/* A jump with the finger in the fluid lifts the finger, and user actions in the middle of an old stroke
   too: the stroke's end is cut off. */
static void no_finger_stays_behind(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    rig_ready(&rig);
    touch(&rig, FINGER_STIR, 0);
    for (int i = 0; i < 4; i++)
        rig_step(&rig);
    rig_back(&rig);
    assert_true(touched(&rig));
    rig_go(&rig, INFINITY);
    assert_false(touched(&rig));
    rig_back(&rig);
    assert_true(touched(&rig));
    rig_set(&rig, "gravity=[0, -5, 0]");
    rig_step(&rig);
    assert_true(!touched(&rig) && strstr(rig.status.message, "cut off"));
    rig_step(&rig);
    rig_save(&rig, "a.rec");
    rig_close(&rig);
    assert_true(replay("a.rec") > 0);
}

/* A replayed stroke is completed, also after a look back; user actions in the middle leave no foreign
   finger in the fluid. */
static void a_session_that_is_done_again(void **state)
{
    (void)state;
    uint64_t hash[FRAMES + 1];
    Recording script;
    Rig rig;
    rig_open(&rig, scenes[0].text, 64 * MIB);
    stroke(&rig, hash);
    rig_save(&rig, "a.rec");
    rig_close(&rig);
    must(recording_read("a.rec", &script, &error));
    rig_start(&rig, scenes[0].text, (SimulatorSetup){.history_bytes = 64 * MIB, .script = &script});
    rig_ready(&rig);
    for (int i = 1; i <= 4; i++)
        rig_step(&rig);
    rig_back(&rig);
    rig_go(&rig, INFINITY);
    assert_true(touched(&rig) && rig_hash(&rig) == hash[4]);
    for (int i = 5; i <= FRAMES + 1; i++)
        rig_step(&rig);
    assert_true(rig.status.script == SCRIPT_SAME && !touched(&rig));
    rig_close(&rig);
    rig_start(&rig, scenes[0].text, (SimulatorSetup){.history_bytes = 64 * MIB, .script = &script});
    rig_ready(&rig);
    for (int i = 1; i <= 4; i++)
        rig_step(&rig);
    assert_true(touched(&rig));
    rig_target(&rig, 0.1);
    rig_step(&rig);
    assert_true(rig.status.script == SCRIPT_LEFT && !touched(&rig));
    rig_close(&rig);
    recording_destroy(&script);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_replayed_and_undone), cmocka_unit_test(the_recording_has_it),
        cmocka_unit_test(commands_of_one_step),      cmocka_unit_test(a_new_start_has_no_finger),
        cmocka_unit_test(no_finger_stays_behind),    cmocka_unit_test(a_session_that_is_done_again),
    };
    return cmocka_run_group_tests(tests, rig_setup, rig_teardown);
}
