/* Fluid poured in a session, in scenes that have no emitter: recorded, replayed, undone; a full world says so
   once. */
#include "tests/history/history_rig.h"

#define POOL(size, deep)                                                                                     \
    "box: {size: " size "}\n"                                                                                \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -" deep "], max: [0.5, 0.2, " deep "]}}]},\n"                  \
    "  {density: 800, fill: [{block: {min: [-0.5, 0.2, -" deep "], max: [-0.3, 0.4, " deep "]}}]}]\n"
#define STEPS "sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"

#define LARGE POOL("[1, 1, 1]", "0.5") "particles: {spacing: 0.1, most: 260}\n"
#define FLAT  POOL("[1, 1]", "0") "particles: {spacing: 0.05, most: 150}\n"

static const char *const scenes[] = {
    LARGE "solver: {threads: 1, " STEPS,
    LARGE "solver: {method: dfsph, threads: 2, " STEPS,
    LARGE "solver: {backend: compute, reproducible: true, " STEPS,
    FLAT "solver: {threads: 1, " STEPS,
};
enum { SCENES = sizeof scenes / sizeof *scenes, FRAMES = 10, MIB = 1 << 20 };

static Finger pour_of(int fluid, double x)
{
    return (Finger){.way = FINGER_POUR + fluid, .at = {x, 0.7, 0}, .radius = 0.15, .strength = 2};
}

static void pour(Rig *rig, int fluid, double x)
{
    const SimCommand command = {.kind = SIM_TOUCH, .finger = pour_of(fluid, x)};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

static void stop(Rig *rig)
{
    const SimCommand command = {.kind = SIM_TOUCH};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

static WorldInfo info_of(Rig *rig)
{
    WorldInfo info;
    rig_turn(rig);
    world_info(rig->simulator->run.world, &info);
    return info;
}

/* From frame 2 to frame 6 from a moving place, first of the first fluid, then of the second. */
static void stroke(Rig *rig, uint64_t hash[FRAMES + 1])
{
    rig_ready(rig);
    hash[0] = rig_hash(rig);
    for (int i = 1; i <= FRAMES; i++) {
        if (i >= 2 && i < 6)
            pour(rig, i / 4, 0.05 * i);
        if (i == 6)
            stop(rig);
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
        rig_open(&rig, scenes[s], 64 * MIB);
        stroke(&rig, hash);
        const uint64_t came = info_of(&rig).emitted;
        assert_true(came > 0);
        rig_save(&rig, "a.rec");
        for (int i = FRAMES - 1; i >= 0; i--) {
            rig_back(&rig);
            if (rig_hash(&rig) != hash[i] || info_of(&rig).touched != (i >= 2 && i <= 5))
                fail_msg("scene %d: frame %d is another one", s, i);
        }
        assert_true(info_of(&rig).emitted == 0);
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == hash[FRAMES] && info_of(&rig).emitted == came);
        rig_close(&rig);
        assert_true(replay("a.rec") > 0);
    }
}

/* Among commands waiting for a step the last place wins; a stroke that begins and ends before the step is
   void; a new start has no finger. */
static void commands_of_one_step(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0], 64 * MIB);
    rig_ready(&rig);
    pour(&rig, 0, 0); /* while paused, as all here */
    stop(&rig);
    rig_step(&rig);
    assert_true(!info_of(&rig).touched && info_of(&rig).emitted == 0);
    pour(&rig, 0, 0);
    pour(&rig, 1, 0.1);
    pour(&rig, 0, 0.2);
    rig_step(&rig);
    assert_true(info_of(&rig).touched && info_of(&rig).emitted > 0);
    simulator_reset(rig.simulator);
    do
        rig_turn(&rig);
    while (rig.status.frames > 0);
    rig_step(&rig);
    assert_true(!info_of(&rig).touched && info_of(&rig).emitted == 0);
    pour(&rig, 0, 0);
    rig_step(&rig);
    assert_true(info_of(&rig).emitted > 0);
    rig_save(&rig, "a.rec");
    rig_close(&rig);
    assert_true(replay("a.rec") > 0);
}

static void a_full_world_says_it_once(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0], 64 * MIB);
    rig_ready(&rig);
    unsigned said = rig.status.messages;
    for (int i = 0; i < 40; i++) {
        pour(&rig, 0, 0.02 * i - 0.4);
        rig_step(&rig);
    }
    rig_turn(&rig);
    assert_int_equal(info_of(&rig).count, 260);
    assert_int_equal(rig.status.messages, said + 1);
    assert_non_null(strstr(rig.status.message, "as many as particles.most allows"));
    rig_close(&rig);
}

/* A fluid that is not there is none. */
static void a_fluid_that_is_not_there(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, scenes[0], 64 * MIB);
    rig_ready(&rig);
    pour(&rig, 2, 0);
    rig_step(&rig);
    assert_true(!info_of(&rig).touched && info_of(&rig).emitted == 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_replayed_and_undone),
        cmocka_unit_test(commands_of_one_step),
        cmocka_unit_test(a_full_world_says_it_once),
        cmocka_unit_test(a_fluid_that_is_not_there),
    };
    return cmocka_run_group_tests(tests, rig_setup, rig_teardown);
}
