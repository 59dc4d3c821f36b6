/* Back and forth in time: each place has the bits of the straight run, and the recording stays a single
   line. The solver is on a thread or on the GPU; ThreadSanitizer watches. */
#include "tests/history/history_rig.h"
#include "tests/program.h"

#include "sim/step/method.h"

enum { MIB = 1 << 20, FRAMES = 24, JUMPS = 30 };

#define BOX                                                                                                  \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles: {spacing: 0.1}\n"                                                                            \
    "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.6, 0.5]}}]}]\n"

static const char plain[] = BOX "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n";

static const struct {
    const char *name, *text;
} scenes[] = {
    {"mueller", plain},
    {"wcsph", BOX "solver: {method: wcsph, sound_speed: 20, threads: 2, step: {dt: 0.01, substeps: 5}}\n"},
    {"dfsph", BOX "solver: {method: dfsph, threads: 2, step: {dt: 0.01, substeps: 2}}\n"},
    {"pbf", BOX "solver: {method: pbf, threads: 1, step: {dt: 0.01, substeps: 2}}\n"},
    {"cfl", BOX "solver: {sound_speed: 15, threads: 1, step: {mode: cfl, max_dt: 0.004}}\n"},
    {"terms",
     "box: {size: [1, 1, 1]}\n"
     "particles: {spacing: 0.1}\n"
     "fluids: [{viscosity: 20, surface_tension: 0.1, fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.6, 0.5]}}]}]\n"

     "solver: {method: wcsph, sound_speed: 20, threads: 2, viscosity: implicit, surface_tension: cohesion, step: {dt: 0.01, substeps: 10}}\n"},
    {"emitters", "box: {size: [1, 1, 1]}\n"
                 "particles: {spacing: 0.08, most: 900}\n"
                 "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}}],\n"
                 "  emit: [{disk: {centre: [0, 0.6, 0], direction: [0, -1, 0], radius: 0.25}, speed: 2}]}]\n"
                 "drains: [{block: {min: [-0.5, 0, -0.5], max: [-0.3, 0.05, 0.5]}}]\n"
                 "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n"},
    {"compute", BOX "solver: {backend: compute, reproducible: true, sound_speed: 15,\n"
                    "  step: {dt: 0.01, substeps: 5}}\n"},
    {"compute dfsph",
     BOX "solver: {method: dfsph, backend: compute, reproducible: true, step: {dt: 0.01, substeps: 2}}\n"},
    {"compute pbf",
     BOX "solver: {method: pbf, backend: compute, reproducible: true, step: {dt: 0.01, substeps: 2}}\n"},
    {"compute emitters",
     "box: {size: [1, 1, 1]}\n"
     "particles: {spacing: 0.08, most: 900}\n"
     "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}}],\n"
     "  emit: [{disk: {centre: [0, 0.6, 0], direction: [0, -1, 0], radius: 0.25}, speed: 2}]}]\n"
     "drains: [{block: {min: [-0.5, 0, -0.5], max: [-0.3, 0.05, 0.5]}}]\n"
     "solver: {backend: compute, reproducible: true, sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n"},
    {"fragment", BOX "solver: {backend: fragment, sound_speed: 15, step: {dt: 0.01, substeps: 5}}\n"},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static uint32_t dice = 1;

static int roll(int sides)
{
    dice = dice * 1664525u + 1013904223u;
    return (int)((dice >> 8) % (uint32_t)sides);
}

/* A straight run with commands now and then: time and hash at each place. */
typedef struct Straight {
    double time[FRAMES + 1];
    uint64_t hash[FRAMES + 1];
    size_t particles[FRAMES + 1];
} Straight;

static void note(Rig *rig, Straight *run, int i)
{
    run->hash[i] = rig_hash(rig);
    run->time[i] = rig->status.time;
    run->particles[i] = rig->status.particles;
}

static void run_straight(Rig *rig, Straight *run)
{
    rig_ready(rig);
    note(rig, run, 0);
    for (int i = 1; i <= FRAMES; i++) {
        if (i % 5 == 0)
            rig_target(rig, 0.1 * roll(5));
        if (i % 11 == 0)
            rig_carry(rig, 0.05 * roll(5));
        if (i % 7 == 0)
            rig_set(rig, roll(2) ? "gravity=[0, -5, 0]" : "gravity=[1, -9, 0]");
        rig_step(rig);
        note(rig, run, i);
        assert_true(run->time[i] > run->time[i - 1]);
    }
}

static void look(Rig *rig, const Straight *run, int i, const char *name)
{
    if (rig_hash(rig) != run->hash[i])
        fail_msg("%s: other bits at place %d", name, i);
    assert_true(rig->status.time == run->time[i]);
    assert_int_equal(rig->status.particles, run->particles[i]);
    assert_int_equal(rig->status.timeline.rewound, i < FRAMES);
}

/* Jumps, steps back and on, at random. */
static void wander(Rig *rig, const Straight *run, const char *name)
{
    int at = FRAMES;
    for (int k = 0; k < JUMPS; k++) {
        const int way = roll(4);
        if (way == 0 && at > 0) {
            rig_back(rig);
            at--;
        } else if (way == 1 && at < FRAMES) {
            rig_step(rig);
            at++;
        } else {
            at = roll(FRAMES + 1);
            rig_go(rig, run->time[at] + (at < FRAMES ? 0.5 * (run->time[at + 1] - run->time[at]) : 1));
        }
        look(rig, run, at, name);
    }
}

static void each_place_has_its_bits(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        Rig rig;
        Straight run;
        rig_open(&rig, scenes[s].text, 64 * MIB);
        run_straight(&rig, &run);
        rig_save(&rig, "before.rec");
        wander(&rig, &run, scenes[s].name);
        rig_save(&rig, "behind.rec"); /* anywhere: of all commands */
        rig_go(&rig, INFINITY);
        look(&rig, &run, FRAMES, scenes[s].name);
        rig_save(&rig, "after.rec");
        assert_int_equal(rig.status.messages, 0);
        rig_close(&rig);
        Recording saved[3];
        must(recording_read("before.rec", &saved[0], &error) &&
             recording_read("behind.rec", &saved[1], &error) &&
             recording_read("after.rec", &saved[2], &error));
        const uint64_t steps = saved[0].steps;
        const size_t count = saved[0].count;
        for (int i = 0; i < 3; i++) {
            if (saved[i].hash != run.hash[FRAMES] || saved[i].steps != steps)
                fail_msg("%s: save %d: %llu steps, %d", scenes[s].name, i, (unsigned long long)saved[i].steps,
                         saved[i].hash == run.hash[FRAMES]);
            assert_int_equal(saved[i].count, count);
            recording_destroy(&saved[i]);
        }
        assert_true(replay("after.rec") > 0);
    }
}

/* Frames that the sentinel did again with half the step. */
static void trouble_is_gone_through_again(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    rig_open(&rig, BOX "solver: {sound_speed: 15, threads: 1, step: {dt: 0.03, substeps: 2}}\n", 64 * MIB);
    run_straight(&rig, &run);
    assert_true(rig.status.messages > 0 && strstr(rig.status.message, "of the step"));
    wander(&rig, &run, "trouble");
    rig_go(&rig, INFINITY);
    rig_save(&rig, "trouble.rec");
    rig_close(&rig);
    assert_true(replay("trouble.rec") > 2 * FRAMES);
}

/* Emitters: there are fewer particles then. */
static void emitters_take_back_what_they_sent(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    rig_open(&rig, scenes[6].text, 64 * MIB);
    run_straight(&rig, &run);
    assert_true(run.particles[FRAMES] > run.particles[0] + 20);
    rig_go(&rig, 0);
    look(&rig, &run, 0, "emitters");
    rig_close(&rig);
}

/* User actions in the past: later states are cut off, and the recording follows the new line. */
static void a_command_in_the_past_cuts_the_rest_off(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    rig_open(&rig, plain, 64 * MIB);
    run_straight(&rig, &run);
    rig_go(&rig, run.time[10]);
    rig_target(&rig, -0.3);
    look(&rig, &run, 10, "waiting"); /* it applies with the next step */
    rig_step(&rig);
    assert_true(rig.status.messages == 1 && strstr(rig.status.message, "cut off"));
    assert_false(rig.status.timeline.rewound);
    assert_true(rig_hash(&rig) != run.hash[11] && rig.status.timeline.to == rig.status.time);
    rig_step(&rig);
    const uint64_t hash = rig_hash(&rig);
    rig_go(&rig, run.time[3]);
    look(&rig, &run, 3, "before the cut");
    rig_go(&rig, run.time[FRAMES]); /* as far as it goes now */
    assert_true(rig_hash(&rig) == hash && !rig.status.timeline.rewound);
    assert_int_equal(rig.status.messages, 1);
    rig_save(&rig, "cut.rec");
    rig_close(&rig);
    assert_int_equal(replay("cut.rec"), 12 * 5);
}

static BoxTarget hand_of(const Rig *rig)
{
    WorldInfo info;
    world_info(rig->simulator->run.world, &info);
    return info.hand;
}

/* The follower with a setting of its own. */
static void open_pair(Rig *leader, Rig *follower, double until, void (*wake)(void))
{
    rig_start(follower,
              BOX "gravity: [0, -3, 0]\n"
                  "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n",
              (SimulatorSetup){.history_bytes = 64 * MIB, .follows = true, .until = until});
    rig_start(
        leader, plain,
        (SimulatorSetup){
            .history_bytes = 64 * MIB, .wake = wake, .follower_count = 1, .followers = &follower->simulator});
    rig_ready(leader);
}

/* By a setting that reaches the leader alone: later commands to both are gone for both. */
static void what_follows_is_cut_too(void **state)
{
    (void)state;
    Rig leader, follower;
    open_pair(&leader, &follower, 0, NULL);
    for (int i = 0; i < 8; i++) {
        rig_target(&follower, 0.02 * i);
        rig_target(&leader, 0.02 * i);
        rig_step(&leader);
    }
    rig_go(&leader, 0.02);
    rig_set(&leader, "gravity=[0, -5, 0]");
    for (int i = 0; i < 4; i++) {
        rig_step(&leader);
        const BoxTarget one = hand_of(&leader), other = hand_of(&follower);
        assert_memory_equal(one.position, other.position, sizeof one.position);
    }
    assert_int_equal(follower.simulator->recording.count, 2);
    rig_close(&leader);
    rig_close(&follower);
}

/* A panel with a time of its own: there the follower waits, also when the leader comes back from before. */
static void what_follows_stays_at_its_time(void **state)
{
    (void)state;
    Rig leader, follower;
    const double *now;
    open_pair(&leader, &follower, 0.035, NULL);
    now = &follower.simulator->run.info.time;
    for (int i = 1; i <= 8; i++) {
        rig_step(&leader);
        assert_true(fabs(*now - fmin(0.01 * i, 0.04)) < 1e-9);
    }
    rig_go(&leader, 0.02);
    rig_step(&leader);
    assert_true(fabs(*now - 0.03) < 1e-9);
    rig_go(&leader, INFINITY);
    rig_step(&leader);
    assert_true(fabs(*now - 0.04) < 1e-9 && leader.status.time > 0.08);
    rig_close(&leader);
    rig_close(&follower);
}

static Rig leads, follows;
static int apart; /* wakes at which states of two times were shown; of the solver's thread */

static void look_at_both(void)
{
    const Simulator *one = leads.simulator, *other = follows.simulator;
    apart += one && fabs(one->status.time - other->status.time) > 1e-6;
}

/* The leader is at its start some time before the follower is. */
static void a_reset_is_shown_of_all_at_once(void **state)
{
    (void)state;
    open_pair(&leads, &follows, 0, look_at_both);
    for (int i = 0; i < 3; i++)
        rig_step(&leads);
    simulator_reset(leads.simulator);
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(&leads);
    while (leads.status.time > 0 && wall_ms() < until);
    rig_step(&leads);
    rig_close(&leads);
    rig_close(&follows);
    assert_true(leads.status.step == 5 && apart == 0);
}

/* Display commands do not cut the history: sent, and by simulator_move as in the window. */
static void accelerations_wished_in_the_past_cut_nothing(void **state)
{
    (void)state;
    for (int moves = 0; moves < 2; moves++) {
        Rig rig;
        Straight run;
        char backend[NAME_SIZE];
        SimCommand keep = {.kind = SIM_SET, .setting = "solver.acceleration=true"};
        rig_open(&rig, plain, 64 * MIB);
        run_straight(&rig, &run);
        rig_go(&rig, run.time[10]);
        if (moves)
            must(simulator_move(rig.simulator, &keep, rig.upload, backend, &error));
        else
            rig_set(&rig, keep.setting);
        for (int i = 11; i < 14; i++) {
            rig_step(&rig);
            look(&rig, &run, i, "after the wish");
            assert_true(rig.simulator->run.scene.world.acceleration);
        }
        rig_go(&rig, run.time[3]);
        look(&rig, &run, 3, "further back");
        rig_go(&rig, INFINITY);
        look(&rig, &run, FRAMES, "the newest");
        assert_true(rig.simulator->run.scene.world.acceleration && rig.status.messages == 0);
        rig_save(&rig, "kept.rec");
        rig_close(&rig);
        assert_int_equal(replay("kept.rec"), FRAMES * 5);
    }
}

/* Within a frame of the past too. */
static void time_runs_on_in_the_past_as_it_did(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    rig_open(&rig, plain, 64 * MIB);
    run_straight(&rig, &run);
    rig_go(&rig, run.time[5]);
    simulator_pause(rig.simulator, false);
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(&rig);
    while (rig.status.time < run.time[FRAMES] && wall_ms() < until);
    simulator_pause(rig.simulator, true);
    rig_rest(&rig);
    assert_false(rig.status.timeline.rewound);
    assert_int_equal(rig.status.messages, 0);
    for (int k = 0; k < 3; k++) { /* later work is kept as before */
        const double now = rig.status.time;
        const uint64_t hash = rig_hash(&rig);
        rig_go(&rig, run.time[7 + k]);
        look(&rig, &run, 7 + k, "again");
        rig_go(&rig, now);
        assert_true(rig_hash(&rig) == hash && !rig.status.timeline.rewound);
    }
    simulator_pause(rig.simulator, false);
    rig_go(&rig, run.time[4]);
    rig_target(&rig, 0.4); /* during the run */
    do
        rig_turn(&rig);
    while (rig.status.messages == 0 && wall_ms() < until);
    simulator_pause(rig.simulator, true);
    rig_save(&rig, "ran.rec");
    rig_close(&rig);
    assert_true(replay("ran.rec") > 0);
}

/* Presses add up; the past has a begin. */
static void steps_back_add_up(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    rig_open(&rig, plain, 64 * MIB);
    run_straight(&rig, &run);
    for (int i = 0; i < 4; i++)
        simulator_step_back(rig.simulator, false);
    rig_arrive(&rig);
    look(&rig, &run, FRAMES - 4, "four back");
    simulator_go_by(rig.simulator, -1000);
    rig_arrive(&rig);
    rig_back(&rig);
    look(&rig, &run, 0, "the begin");
    assert_true(rig.status.timeline.from == 0 && rig.status.timeline.to == run.time[FRAMES]);
    rig_close(&rig);
}

/* What waits: settings were given before the jump and apply there, poses are forgotten. */
static void what_waits_applies_before_the_jump(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    WorldDef def;
    rig_open(&rig, plain, 64 * MIB);
    run_straight(&rig, &run);
    rig_set(&rig, "gravity=[0, -1, 0]");
    rig_target(&rig, 0.5);
    rig_go(&rig, run.time[2]);
    look(&rig, &run, 2, "back");
    simulator_settings(rig.simulator, &def);
    assert_true(def.gravity[1] == -9.81);
    rig_step(&rig);
    look(&rig, &run, 3, "on"); /* no cut */
    rig_go(&rig, INFINITY);
    simulator_settings(rig.simulator, &def);
    assert_true(def.gravity[1] == -1 && def.gravity[0] == 0);
    rig_step(&rig);
    assert_true(rig.status.messages == 0);
    rig_save(&rig, "waited.rec");
    rig_close(&rig);
    assert_int_equal(replay("waited.rec"), (FRAMES + 1) * 5);
}

/* Settings and hand are shown as they were. */
static void settings_and_hand_are_what_they_were(void **state)
{
    (void)state;
    Rig rig;
    WorldDef def;
    rig_open(&rig, plain, 64 * MIB);
    rig_ready(&rig);
    rig_step(&rig);
    const double before = rig.status.time;
    rig_target(&rig, 0.25);
    rig_set(&rig, "gravity=[0, -2, 0]");
    rig_step(&rig);
    rig_step(&rig);
    rig_go(&rig, before);
    simulator_settings(rig.simulator, &def);
    assert_true(def.gravity[1] == -9.81 && rig.status.timeline.target.position[0] == 0);
    const unsigned travels = rig.status.timeline.travels;
    rig_step(&rig); /* applies the commands again */
    simulator_settings(rig.simulator, &def);
    assert_true(def.gravity[1] == -2 && rig.status.timeline.target.position[0] == 0.25);
    assert_true(rig.status.timeline.travels > travels);
    rig_close(&rig);
}

static void a_reset_keeps_what_was_set_until_then(void **state)
{
    (void)state;
    Rig rig;
    char backend[NAME_SIZE];
    SimCommand keep = {.kind = SIM_SET, .setting = "solver.acceleration=true"};
    rig_open(&rig, plain, 64 * MIB);
    rig_ready(&rig);
    rig_set(&rig, "gravity=[0, -2, 0]");
    rig_step(&rig);
    const double before = rig.status.time;
    rig_set(&rig, "gravity=[0, -3, 0]");
    rig_step(&rig);
    rig_go(&rig, before);
    must(simulator_move(rig.simulator, &keep, rig.upload, backend, &error)); /* not recorded: no cut */
    simulator_reset(rig.simulator);
    const double until = wall_ms() + PATIENCE_MS;
    do
        rig_turn(&rig);
    while (rig.status.step > 0 && wall_ms() < until);
    rig_step(&rig);
    assert_true(rig.simulator->run.scene.world.acceleration);
    assert_true(rig.status.timeline.from == 0 && rig.status.timeline.to == rig.status.time);
    rig_save(&rig, "reset.rec");
    rig_close(&rig);
    Recording recording;
    must(recording_read("reset.rec", &recording, &error));
    assert_int_equal(recording.count, 1);
    assert_string_equal(recording.commands[0].setting, "gravity=[0, -2, 0]");
    recording_destroy(&recording);
    assert_int_equal(replay("reset.rec"), 5);
}

/* Plots end at the present, and go on from there. */
static void plots_are_cut_to_the_past(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             BOX "probes: [{name: a, point: {at: [-0.2, 0.1, 0]}, average: 0.05}]\n"
                 "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n",
             64 * MIB);
    rig_ready(&rig);
    simulator_watch(rig.simulator, true, true);
    for (int i = 0; i < 4; i++) {
        usleep(60000);
        rig_step(&rig);
    }
    usleep(60000);
    rig_turn(&rig);
    assert_true(rig.status.gauge_count >= 4 && rig.status.probe_count >= 4);
    rig_go(&rig, 0.02);
    for (int i = 0; i < rig.status.gauge_count; i++)
        assert_true(rig.status.gauges[i].gauge.time <= rig.status.time);
    for (int i = 0; i < rig.status.probe_count; i++)
        assert_true(rig.status.probes[i].time <= rig.status.time);
    assert_true(rig.status.gauge_count >= 2 && rig.status.probe_count >= 2);
    rig_close(&rig);
}

/* A blown-up state is an ordinary state: going back and returning work. */
static void one_goes_back_from_a_failure(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, plain, 64 * MIB);
    rig_ready(&rig);
    for (int i = 0; i < 3; i++)
        rig_step(&rig);
    const uint64_t sound = rig_hash(&rig);
    rig_set(&rig, "solver.step.dt=1");
    for (int i = 0; i < 20 && !rig.status.failed; i++)
        rig_step(&rig);
    rig_turn(&rig);
    assert_true(rig.status.failed);
    const uint64_t broken = rig_hash(&rig);
    rig_go(&rig, 0.03);
    assert_true(!rig.status.failed && rig_hash(&rig) == sound);
    rig_go(&rig, INFINITY);
    assert_true(rig.status.failed && rig_hash(&rig) == broken);
    rig_go(&rig, 0.03);
    rig_set(&rig, "solver.step.dt=0.01");
    rig_step(&rig);
    rig_step(&rig);
    assert_false(rig.status.failed);
    rig_save(&rig, "mended.rec");
    rig_close(&rig);
    assert_int_equal(replay("mended.rec"), 25);
}

/* Without memory for it: said once, and all else goes on. */
static void without_a_past_it_says_so(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, plain, 0);
    rig_ready(&rig);
    rig_step(&rig);
    rig_back(&rig);
    rig_back(&rig);
    assert_true(rig.status.messages == 1 && strstr(rig.status.message, "--past"));
    assert_true(rig.status.step == 5 && !rig.status.timeline.enabled);
    rig_close(&rig);
}

/* Memory is short: the limit holds, and the remaining states are unchanged. */
static void little_memory_holds_little(void **state)
{
    (void)state;
    enum { LIMIT = sizeof(Scene) + 100000 }; /* a history begins with a scene */
    Rig rig;
    Straight run;
    rig_open(&rig, BOX "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 1000}}\n", LIMIT);
    run_straight(&rig, &run);
    if (rig.status.timeline.bytes > LIMIT || rig.status.timeline.states < 2)
        fail_msg("%zu states, %zu bytes", rig.status.timeline.states, rig.status.timeline.bytes);
    for (int i = 0; i < FRAMES; i += 5) {
        rig_go(&rig, run.time[i]);
        const int reached = (int)round(rig.status.time / 0.01);
        assert_true(reached == i || run.time[reached] == rig.status.timeline.from);
        assert_int_equal(rig.status.messages, rig.status.timeline.from > 0); /* reported */
        look(&rig, &run, reached, "what is left");
    }
    rig_close(&rig);
}

/* Another backend: the past begins there. */
static void another_backend_begins_a_past(void **state)
{
    (void)state;
    Rig rig;
    Straight run;
    char now[NAME_SIZE];
    rig_open(&rig, plain, 64 * MIB);
    run_straight(&rig, &run);
    rig_go(&rig, run.time[10]);
    SimCommand command = {.kind = SIM_SET, .setting = "solver.backend=compute"};
    must(simulator_move(rig.simulator, &command, rig.upload, now, &error));
    rig_turn(&rig);
    assert_true(rig.status.messages == 1 && strstr(rig.status.message, "cut off"));
    rig_step(&rig);
    rig_step(&rig);
    rig_go(&rig, 0);
    assert_true(rig.status.time == run.time[10] && rig.status.timeline.from == run.time[10]);
    assert_true(rig_hash(&rig) == run.hash[10]);
    rig_go(&rig, INFINITY);
    command = (SimCommand){.kind = SIM_SET, .setting = "solver.backend=cpu"};
    must(simulator_move(rig.simulator, &command, rig.upload, now, &error));
    rig_step(&rig);
    rig_save(&rig, "moved.rec");
    rig_close(&rig);
    Recording recording;
    must(recording_read("moved.rec", &recording, &error));
    assert_int_equal(recording.steps, 13 * 5);
    recording_destroy(&recording);
}

/* A history of a world on the GPU, a frame at a time. */
typedef struct Kept {
    Scene scene;
    World *world;
    History *history;
} Kept;

static void kept_begin(const Kept *kept)
{
    WorldInfo info;
    world_info(kept->world, &info);
    history_begin(kept->history, &info);
}

static void kept_open(Kept *kept, const char *method)
{
    static const char scene[] =
        "box: {size: [1, 1, 1]}\n"
        "particles: {spacing: 0.03}\n"
        "fluids: [{viscosity: 1, fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.6, 0.5]}}]}]\n"
        "solver: {method: %s, backend: compute, sound_speed: 15, step: {dt: 0.001, substeps: 1}}\n";
    SceneSettings none = {.count = 0};
    char text[512];
    snprintf(text, sizeof text, scene, method);
    *kept = (Kept){.history = history_create((size_t)512 * MIB)};
    assert_non_null(kept->history);
    must(scene_parse("a.yaml", text, strlen(text), &none, &kept->scene, NULL, &error));
    must((kept->world = world_create(&kept->scene.world, &error)) != NULL);
    kept_begin(kept);
}

static void kept_frame(Kept *kept)
{
    WorldInfo info;
    must(world_step(kept->world, NULL, &error));
    world_info(kept->world, &info);
    history_add_place(kept->history, &info, 0);
}

static void kept_close(Kept *kept)
{
    history_destroy(kept->history);
    world_destroy(kept->world);
}

/* Each saved column of each particle, whatever the order. */
static bool same_particles(const WorldDef *def, WorldState *a, WorldState *b)
{
    const ColumnRows rows = columns_saved(def);
    size_t *at = calloc(a->count + 1, sizeof *at);
    bool same = a->count == b->count;
    assert_non_null(at);
    for (size_t i = 0; i < b->count; i++)
        at[b->particles.id[i]] = i;
    for (int r = 0; r < rows.count; r++)
        for (int k = 0; k < rows.row[r]->components; k++) {
            const size_t size = column_size(rows.row[r]);
            const char *one = *column_array(&a->particles, rows.row[r], k);
            const char *other = *column_array(&b->particles, rows.row[r], k);
            for (size_t i = 0; i < a->count && same; i++)
                same = memcmp(one + size * i, other + size * at[a->particles.id[i]], size) == 0;
        }
    free(at);
    return same;
}

/* Loaded after some frames: parts of the state are still under way, then none. */
static void particles_of_a_gpu_come_a_part_at_a_time(void **state)
{
    static const int later[] = {0, 1, 4}; /* frames */
    static const char *const methods[] = {"wcsph", "dfsph, viscosity: implicit"};
    (void)state;
    for (int m = 0; m < 2; m++) {
        Kept kept;
        size_t next;
        kept_open(&kept, methods[m]);
        WorldState then = {.count = 0}, now = {.count = 0};
        kept_frame(&kept);
        must(world_save(kept.world, &then, &error));
        for (int k = 0; k < 3; k++) {
            kept_begin(&kept);
            const GlCalls before = gl_calls();
            history_keep(kept.history, kept.world, &kept.scene, 0, true);
            for (int i = 0; i < later[k]; i++) {
                kept_frame(&kept);
                history_keep(kept.history, kept.world, &kept.scene, 0, false);
            }
            assert_int_equal(gl_calls_since(&before).readbacks, 0);
            assert_int_equal(history_figures(kept.history).states, 1);
            must(history_load(kept.history, 0, &kept.world, &kept.scene, &next, &error));
            must(world_save(kept.world, &now, &error));
            if (!same_particles(&kept.scene.world, &then, &now))
                fail_msg("%s: other bits %d frames later", methods[m], later[k]);
            assert_true(gl_calls_since(&before).readbacks > 0); /* of the last save: the count counts */
        }
        world_state_free(&then);
        world_state_free(&now);
        kept_close(&kept);
    }
}

/* The world goes, or the place does, while the state is under way. */
static void a_state_under_way_needs_no_world(void **state)
{
    (void)state;
    Kept kept;
    size_t next;
    kept_open(&kept, "wcsph");
    const uint64_t first = world_hash(kept.world);
    history_keep(kept.history, kept.world, &kept.scene, 0, true);
    kept_frame(&kept);
    world_destroy(kept.world);
    must((kept.world = world_create(&kept.scene.world, &error)) != NULL);
    kept_frame(&kept);
    must(history_load(kept.history, 0, &kept.world, &kept.scene, &next, &error));
    assert_true(world_hash(kept.world) == first);
    history_cut(kept.history, 0);

    kept_frame(&kept);
    history_keep(kept.history, kept.world, &kept.scene, 0, true);
    history_cut(kept.history, 0); /* forgets the state that is under way */
    assert_int_equal(history_figures(kept.history).states, 1);
    kept_frame(&kept);
    const uint64_t second = world_hash(kept.world);
    history_keep(kept.history, kept.world, &kept.scene, 0, true);
    kept_frame(&kept);
    must(history_load(kept.history, 1, &kept.world, &kept.scene, &next, &error));
    assert_true(world_hash(kept.world) == second);
    kept_frame(&kept);
    history_keep(kept.history, kept.world, &kept.scene, 0, true);
    kept_close(&kept); /* with a state under way */
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* What a copy of the state costs, ms. */
static double time_of_a_state(Rig *rig)
{
    enum { COPIES = 50 };
    WorldState state = {.count = 0};
    double ms[COPIES];
    for (int i = 0; i < COPIES; i++) {
        const double began = wall_ms();
        must(world_save(rig->simulator->run.world, &state, &error));
        ms[i] = wall_ms() - began;
    }
    world_state_free(&state);
    qsort(ms, COPIES, sizeof *ms, ascending);
    return ms[COPIES / 2];
}

/* test_history travel --time SCENE: so many seconds of it, then jumps; the figures of docs/labbook/window.md.
 */
static void time_it(const char *scene)
{
    enum { TIMES = 41 };
    static const double SECONDS = 12;
    Rig rig;
    double ms[TIMES];
    size_t size;
    char *file = scene_file_read(scene, &size, &error);
    if (!file) {
        fprintf(stderr, "%s\n", error.message);
        return;
    }
    rig_open(&rig, file, (size_t)256 * MIB);
    rig_ready(&rig);
    simulator_set_realtime(rig.simulator, false);
    simulator_pause(rig.simulator, false);
    const double began = wall_ms();
    while (rig.status.time < SECONDS && !rig.status.failed)
        rig_turn(&rig);
    simulator_pause(rig.simulator, true);
    rig_rest(&rig);
    const double frame = (wall_ms() - began) / (double)rig.status.frames;
    const SimulatorHistory *timeline = &rig.status.timeline;
    const double copy = time_of_a_state(&rig), end = timeline->to;
    const double each = (double)rig.status.frames / (double)timeline->states;
    printf("%zu particles, %.0f s: frames of %.1f ms, %zu states in %.1f MiB, one in %.1f frames\n",
           rig.status.particles, end, frame, timeline->states, (double)timeline->bytes / MIB, each);
    printf("a state is copied in %.3f ms: %.2f %% of the frames' time\n", copy, 100 * copy / (each * frame));
    for (int i = 0; i < TIMES; i++) {
        rig_go(&rig, i % 2 ? end - 10 + 0.1 * i / TIMES : INFINITY);
        ms[i] = i % 2 ? timeline->last_jump_ms : 0;
    }
    qsort(ms, TIMES, sizeof *ms, ascending);
    printf("10 s back: %.1f ms in the median, %.1f at most\n", ms[(TIMES + TIMES / 2) / 2 + 1],
           ms[TIMES - 1]);
    for (int i = 0; i < TIMES; i++) {
        rig_go(&rig, end * (double)roll(1000) / 1000);
        ms[i] = timeline->last_jump_ms;
    }
    qsort(ms, TIMES, sizeof *ms, ascending);
    printf("anywhere: %.1f ms in the median, %.1f at most\n", ms[TIMES / 2], ms[TIMES - 1]);
    rig_close(&rig);
    free(file);
}

int main(void)
{
    if (test_argc == 2 && strcmp(test_argv[0], "--time") == 0) {
        if (!(context = headless_create(HEADLESS_GPU_AUTO, &error)))
            return 1;
        backends_add();
        time_it(test_argv[1]);
        headless_destroy(context);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_place_has_its_bits),
        cmocka_unit_test(trouble_is_gone_through_again),
        cmocka_unit_test(emitters_take_back_what_they_sent),
        cmocka_unit_test(a_command_in_the_past_cuts_the_rest_off),
        cmocka_unit_test(what_follows_is_cut_too),
        cmocka_unit_test(what_follows_stays_at_its_time),
        cmocka_unit_test(a_reset_is_shown_of_all_at_once),
        cmocka_unit_test(accelerations_wished_in_the_past_cut_nothing),
        cmocka_unit_test(time_runs_on_in_the_past_as_it_did),
        cmocka_unit_test(steps_back_add_up),
        cmocka_unit_test(what_waits_applies_before_the_jump),
        cmocka_unit_test(settings_and_hand_are_what_they_were),
        cmocka_unit_test(a_reset_keeps_what_was_set_until_then),
        cmocka_unit_test(plots_are_cut_to_the_past),
        cmocka_unit_test(one_goes_back_from_a_failure),
        cmocka_unit_test(without_a_past_it_says_so),
        cmocka_unit_test(little_memory_holds_little),
        cmocka_unit_test(another_backend_begins_a_past),
        cmocka_unit_test(particles_of_a_gpu_come_a_part_at_a_time),
        cmocka_unit_test(a_state_under_way_needs_no_world),
    };
    return cmocka_run_group_tests_name("history.travel", tests, rig_setup, rig_teardown);
}
