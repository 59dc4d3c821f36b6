/* Gates of emitters and drains: closed gates stop the flow, open gates continue; recorded, replayed and
   undone. */
#include "tests/history/history_rig.h"

#define FLOWS                                                                                                \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles: {spacing: 0.1, most: 600}\n"                                                                 \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}}],\n"                             \
    "  emit: [{disk: {centre: [0, 0.6, 0], direction: [0, -1, 0], radius: 0.25}, speed: 2}]}]\n"             \
    "drains: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.04, 0.5]}}]\n"

static const char *const scenes[] = {
    FLOWS "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n",
    FLOWS "solver: {backend: compute, reproducible: true, sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n",
};

enum { MIB = 1 << 20, FRAMES = 18 };

static const uint64_t EMITTER = 1, DRAIN = 1ULL << EMITTERS_MAX;

static void shut(Rig *rig, uint64_t gates)
{
    const SimCommand command = {.kind = SIM_GATES, .closed_gates = gates};
    assert_true(simulator_send(rig->simulator, &command) > 0);
}

static void restart(Rig *rig)
{
    const double until = wall_ms() + PATIENCE_MS;
    simulator_reset(rig->simulator);
    do
        rig_turn(rig);
    while (rig->status.frames > 0 && wall_ms() < until);
}

static WorldInfo frames(Rig *rig, int count)
{
    WorldInfo info;
    for (int i = 0; i < count; i++)
        rig_step(rig);
    rig_turn(rig);
    world_info(rig->simulator->run.world, &info);
    return info;
}

static void they_hold_and_let_go(void **state)
{
    (void)state;
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        Rig rig;
        rig_open(&rig, scenes[s], 64 * MIB);
        rig_ready(&rig);
        shut(&rig, DRAIN | EMITTER | 1ULL << 39); /* the last gate does not exist in this scene */
        const WorldInfo held = frames(&rig, 6);
        assert_true(held.emitted == 0 && held.drained == 0 && rig.status.closed_gates == (DRAIN | EMITTER));
        shut(&rig, 0);
        shut(&rig, DRAIN); /* the last command of a step wins */
        const WorldInfo filling = frames(&rig, 6);
        assert_true(filling.emitted > 0 && filling.drained == 0);
        const uint64_t hash = rig_hash(&rig);
        shut(&rig, EMITTER);
        const WorldInfo draining = frames(&rig, 6);
        assert_true(draining.emitted == filling.emitted && draining.drained > 0);
        const uint64_t end = rig_hash(&rig);
        rig_save(&rig, "a.rec");
        rig_go(&rig, 0.12);
        assert_true(rig_hash(&rig) == hash && rig.status.closed_gates == DRAIN);
        rig_go(&rig, INFINITY);
        assert_true(rig_hash(&rig) == end && rig.status.closed_gates == EMITTER);
        restart(&rig);
        assert_true(frames(&rig, 4).emitted > 0); /* as the scene has it */
        rig_close(&rig);
        assert_true(replay("a.rec") >= FRAMES);
    }
}

/* A full world takes no more, says it once, and the gate is of no account then. */
static void a_full_world_says_it_once(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             "box: {size: [1, 1, 1]}\n"
             "particles: {spacing: 0.1, most: 120}\n"
             "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}}],\n"
             "  emit: [{disk: {centre: [0, 0.6, 0], direction: [0, -1, 0], radius: 0.25}, speed: 2}]}]\n"
             "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n",
             0);
    rig_ready(&rig);
    const WorldInfo full = frames(&rig, 12);
    assert_true(full.full && full.count == 120 && rig.status.messages == 1);
    shut(&rig, EMITTER);
    frames(&rig, 2);
    shut(&rig, 0);
    frames(&rig, 4);
    assert_int_equal(rig.status.messages, 1);
    rig_close(&rig);
}

/* A scene may begin with some shut; a new start has them so again. */
static void shut_by_the_scene(void **state)
{
    (void)state;
    char text[1024];
    const char *drains = strstr(scenes[0], "speed: 2");
    Rig rig;
    snprintf(text, sizeof text, "%.*sshut: true, %s", (int)(drains - scenes[0]), scenes[0], drains);
    rig_open(&rig, text, 64 * MIB);
    rig_ready(&rig);
    assert_true(rig.status.closed_gates == EMITTER && frames(&rig, 4).emitted == 0);
    shut(&rig, 0);
    assert_true(frames(&rig, 4).emitted > 0);
    restart(&rig);
    assert_true(frames(&rig, 4).emitted == 0);
    rig_close(&rig);
}

static void a_line_of_a_recording(void **state)
{
    (void)state;
    static const char head[] = "slosh recording 1\nprogram 0.1\nscene a.yaml\ntext\n| box:\ncommands\n";
    static const struct {
        const char *line;
        uint64_t shut;
        bool ok;
    } lines[] = {{"3 shut", 0, true},
                 {"3 shut fluids[1].emit[2] drains[7]", 1ULL << 6 | 1ULL << 39, true},
                 {"3 shut drains[8]", 0, false},
                 {"3 shut fluids[0]", 0, false},
                 {"3 shut ", 0, false},
                 {"3 shutter", 0, false}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        Recording out;
        char text[256];
        snprintf(text, sizeof text, "%s%s\nend 8 0123456789abcdef\n", head, lines[i].line);
        const bool ok = recording_parse("a.rec", text, strlen(text), &out, &error);
        if (ok != lines[i].ok || (!ok && !strstr(error.message, "a.rec:7: ")))
            fail_msg("%s: %d %s", lines[i].line, ok, error.message);
        if (!ok)
            continue;
        assert_true(out.commands[0].kind == SIM_GATES && out.commands[0].closed_gates == lines[i].shut);
        must(recording_write(&out, out.steps, out.hash, "b.rec", &error));
        recording_destroy(&out);
        must(recording_read("b.rec", &out, &error));
        assert_true(out.commands[0].closed_gates == lines[i].shut);
        recording_destroy(&out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_hold_and_let_go),
        cmocka_unit_test(a_full_world_says_it_once),
        cmocka_unit_test(shut_by_the_scene),
        cmocka_unit_test(a_line_of_a_recording),
    };
    return cmocka_run_group_tests(tests, rig_setup, rig_teardown);
}
