/* The ring of states alone: memory limit, order of removal, and resulting jump lengths. */
#include "tests/app/output_fixture.h"

#include "app/run/simulator_private.h"
#include "sim/state.h"
#include "sim/step/world.h"

#include <math.h>

static const char text[] = "box: {size: [1, 1, 1]}\n"
                           "particles: {spacing: 0.1}\n"
                           "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0, 0.6, 0.5]}}]}]\n"
                           "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 1}}\n";
static const double DT = 0.01;

typedef struct Bench {
    Scene scene;
    World *world;
    History *timeline;
} Bench;

static void bench_open_text(Bench *bench, const char *said, size_t bytes)
{
    Error error = {{0}};
    WorldInfo info;
    SceneSettings none = {.count = 0};
    assert_true(scene_parse("a.yaml", said, strlen(said), &none, &bench->scene, NULL, &error));
    bench->world = world_create(&bench->scene.world, &error);
    bench->timeline = history_create(bytes);
    assert_non_null(bench->world);
    assert_non_null(bench->timeline);
    world_info(bench->world, &info);
    history_begin(bench->timeline, &info);
}

static void bench_open(Bench *bench, size_t bytes)
{
    bench_open_text(bench, text, bytes);
}

static void bench_close(Bench *bench)
{
    history_destroy(bench->timeline);
    world_destroy(bench->world);
}

/* A number of frames with a frame time each; the states are empty: the world's numbers count. */
static void frames(Bench *bench, int count, double ms)
{
    WorldInfo info;
    world_info(bench->world, &info);
    for (int i = 0; i < count; i++) {
        history_keep(bench->timeline, bench->world, &bench->scene, 0, false);
        const HistoryFigures figures = history_figures(bench->timeline);
        assert_true(figures.bytes <= figures.bytes_most);
        const HistoryPlace last = history_place(bench->timeline, history_last(bench->timeline));
        info.step = last.step + 1;
        info.time = DT * (double)info.step;
        history_add_place(bench->timeline, &info, ms);
    }
}

/* Frames that a jump takes at most. */
static uint64_t longest_jump(const History *timeline)
{
    uint64_t longest = 0;
    for (uint64_t place = history_first(timeline); place < history_last(timeline); place++) {
        const uint64_t jump = place - history_state_before(timeline, place);
        longest = jump > longest ? jump : longest;
    }
    return longest;
}

static void states_are_kept_by_the_time_that_frames_take(void **state)
{
    (void)state;
    Bench bench;
    bench_open(&bench, 1 << 26);
    frames(&bench, 1, 100); /* slow: each */
    frames(&bench, 20, 100);
    assert_int_equal(longest_jump(bench.timeline), 0);
    frames(&bench, 1000, 10); /* fast: every fifth */
    assert_int_equal(longest_jump(bench.timeline), (uint64_t)(HISTORY_GAP_MS / 10) - 1);
    const HistoryFigures figures = history_figures(bench.timeline);
    assert_true(figures.states > 200 && figures.states < 230 && !figures.dropped);
    assert_int_equal(history_first(bench.timeline), 0);
    bench_close(&bench);
}

/* When the memory is full it is first thinned out, and then the oldest go; jumps stay short. */
static void it_thins_out_before_it_forgets(void **state)
{
    (void)state;
    Bench bench;
    bench_open(&bench, 4 << 20);
    frames(&bench, 1500, 12);
    const HistoryFigures figures = history_figures(bench.timeline);
    assert_true(figures.state_bytes > 6000 && figures.state_bytes < 20000); /* of 300 particles */
    frames(&bench, 20000, 12);
    const History *timeline = bench.timeline;
    const double reach = history_place(timeline, history_last(timeline)).time -
                         history_place(timeline, history_first(timeline)).time;
    assert_true(history_first(timeline) > 0 && reach > 20); /* s; 14 without */
    assert_true((double)longest_jump(timeline) * 12 < HISTORY_GAP_MOST_MS);
    assert_false(history_figures(timeline).dropped); /* more than ten seconds are left */
    bench_close(&bench);
}

/* Less than wanted: jumps get longer, and the history is reported as short. */
static void what_is_short_is_known(void **state)
{
    (void)state;
    Bench bench;
    bench_open(&bench, sizeof(Scene) + 236000);
    frames(&bench, 100, 60);
    assert_true(history_first(bench.timeline) == 0 && !history_figures(bench.timeline).dropped);
    assert_true(longest_jump(bench.timeline) > 2);
    frames(&bench, 1000, 60);
    assert_true(history_first(bench.timeline) > 0 && history_figures(bench.timeline).dropped);
    assert_true((double)longest_jump(bench.timeline) * 60 < HISTORY_GAP_SHORT_MS);
    bench_close(&bench);
}

/* Less than one state: there is no past, and all else works. */
static void a_state_may_be_too_large(void **state)
{
    (void)state;
    Bench bench;
    Error error = {{0}};
    size_t next;
    bench_open(&bench, 10000);
    frames(&bench, 1000, 60);
    assert_int_equal(history_figures(bench.timeline).states, 0);
    assert_true(history_figures(bench.timeline).dropped);
    assert_int_equal(history_first(bench.timeline), history_last(bench.timeline));
    assert_int_equal(history_find(bench.timeline, 0), history_last(bench.timeline));
    assert_false(history_load(bench.timeline, history_last(bench.timeline), &bench.world, &bench.scene, &next,
                              &error));
    bench_close(&bench);
}

static void places_are_found_by_their_time(void **state)
{
    (void)state;
    Bench bench;
    bench_open(&bench, 1 << 24);
    frames(&bench, 100, 60);
    assert_int_equal(history_find(bench.timeline, -1), 0);
    assert_int_equal(history_find(bench.timeline, 0.305), 30);
    assert_int_equal(history_find(bench.timeline, history_place(bench.timeline, 77).time), 77);
    assert_int_equal(history_find(bench.timeline, 1e9), 100);
    history_cut(bench.timeline, 40);
    assert_int_equal(history_last(bench.timeline), 40);
    assert_int_equal(history_find(bench.timeline, 1e9), 40);
    assert_int_equal(history_state_before(bench.timeline, 40), 40);
    frames(&bench, 10, 60);
    assert_true(history_last(bench.timeline) == 50 && history_place(bench.timeline, 50).step == 50);
    bench_close(&bench);
}

/* The scene as it was set, and the number of commands, come back with the state. */
static void settings_come_with_the_state(void **state)
{
    (void)state;
    Bench bench;
    Error error = {{0}};
    size_t next = 99;
    bench_open(&bench, 1 << 24);
    history_keep(bench.timeline, bench.world, &bench.scene, 3, true);
    const size_t one = history_figures(bench.timeline).bytes;
    WorldInfo info;
    world_info(bench.world, &info);
    history_add_place(bench.timeline, &info, 60);
    history_keep(bench.timeline, bench.world, &bench.scene, 4, true); /* the same settings, once */
    const size_t two = history_figures(bench.timeline).bytes;
    assert_true(two - one < sizeof(Scene));
    history_add_place(bench.timeline, &info, 60);
    const Scene before = bench.scene;
    bench.scene.world.gravity[1] = -3;
    bench.scene.view.background[2] = 0.25;
    ((unsigned char *)&bench.scene)[sizeof(Scene) - 1] ^= 1; /* its last byte: of no account to the world */
    const Scene changed = bench.scene;
    history_keep(bench.timeline, bench.world, &bench.scene, 5, true);
    assert_in_range(history_figures(bench.timeline).bytes - two, 1,
                    two - one + 400); /* what differs, no whole scene */
    assert_true(history_load(bench.timeline, 1, &bench.world, &bench.scene, &next, &error));
    assert_int_equal(next, 4);
    assert_memory_equal(&bench.scene, &before, sizeof before);
    assert_true(history_load(bench.timeline, 2, &bench.world, &bench.scene, &next, &error));
    assert_int_equal(next, 5);
    assert_memory_equal(&bench.scene, &changed, sizeof changed);
    history_begin(bench.timeline, &info);
    assert_int_equal(history_figures(bench.timeline).bytes, sizeof(HistoryPlace));
    bench_close(&bench);
}

/* Across an added solid, from an invalid state; after a failed load there is no change. */
static void a_state_with_other_solids_comes_back(void **state)
{
    (void)state;
    Bench bench;
    Error error = {{0}};
    size_t next = 99;
    WorldInfo info;
    bench_open(&bench, 1 << 24);
    history_keep(bench.timeline, bench.world, &bench.scene, 3, true);
    const uint64_t hash = world_hash(bench.world);
    bench.scene.world.solids[0] =
        (SolidDef){.kind = SOLID_SPHERE, .radius = 0.1, .centre = {0.3, 0.8, 0}, .axis = {0, 1, 0}};
    bench.scene.world.solid_count = 1;
    assert_true(world_set_shapes(&bench.world, &bench.scene.world, &error));
    world_info(bench.world, &info);
    history_add_place(bench.timeline, &info, 60);
    bench.world->seen = STEP_TROUBLE_SOLID; /* as where it blew up */
    assert_false(world_is_valid(bench.world));

    World *const now = bench.world;
    const Scene with_it = bench.scene;
    now->initial++; /* lacks a particle, so that the state does not match the particles */
    assert_false(history_load(bench.timeline, 0, &bench.world, &bench.scene, &next, &error));
    now->initial--;
    assert_true(bench.world == now && next == 99 && now->def.solid_count == 1);
    assert_memory_equal(&bench.scene, &with_it, sizeof with_it);

    if (!history_load(bench.timeline, 0, &bench.world, &bench.scene, &next, &error))
        fail_msg("%s", error.message);
    assert_int_equal(next, 3);
    assert_int_equal(bench.scene.world.solid_count, 0);
    assert_true(world_hash(bench.world) == hash && world_is_valid(bench.world));
    bench_close(&bench);
}

/* Estimated size of a state before the first state, births of emitted particles included. */
static void a_state_needs_what_it_takes(void **state)
{
    (void)state;
    static const char jet[] =
        "box: {size: [1, 1, 1]}\n"
        "particles: {spacing: 0.05, most: 2000}\n"
        "fluids: [{emit: [{disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.06}, "
        "speed: 4}]}]\n"
        "solver: {sound_speed: 15, threads: 1, step: {dt: 0.01, substeps: 5}}\n";
    Bench bench;
    Error error = {{0}};
    bench_open_text(&bench, jet, 1 << 24);
    history_keep(bench.timeline, bench.world, &bench.scene, 0, true); /* the settings, once */
    for (int i = 0; i < 20; i++) {
        WorldInfo info;
        assert_true(world_step(bench.world, NULL, &error));
        world_info(bench.world, &info);
        const size_t before = history_figures(bench.timeline).bytes;
        history_add_place(bench.timeline, &info, 60);
        history_keep(bench.timeline, bench.world, &bench.scene, 0, true);
        const HistoryFigures now = history_figures(bench.timeline);
        assert_int_equal(now.bytes - before, now.state_bytes + sizeof(HistoryPlace));
    }
    assert_true(world_births_bytes(bench.world) >= 10 * sizeof(Birth));
    bench_close(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_are_kept_by_the_time_that_frames_take),
        cmocka_unit_test(it_thins_out_before_it_forgets),
        cmocka_unit_test(what_is_short_is_known),
        cmocka_unit_test(a_state_may_be_too_large),
        cmocka_unit_test(places_are_found_by_their_time),
        cmocka_unit_test(settings_come_with_the_state),
        cmocka_unit_test(a_state_with_other_solids_comes_back),
        cmocka_unit_test(a_state_needs_what_it_takes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
