/* A recorded run played by a clock that the test turns. */
#include "tests/patience.h"
#include "tests/playback/recorded_fixture.h"

#include "app/run/playback/playback.h"
#include "sim/world.h"

enum { STEPS = 20 };

static Error error;
static double now_ms;

/* Steps 0.1 s apart from `first` on, of 1 + k particles. */
static Player *open_player(bool paused)
{
    size_t counts[STEPS];
    Recorded recorded;
    for (size_t k = 0; k < STEPS; k++)
        counts[k] = 1 + k;
    write_file("a.h5part", counts, STEPS, 0.1);
    open_recorded(&recorded, "a.h5part", NULL);
    Player *player = player_create(&recorded, NULL, paused, &error);
    must(player, &error);
    return player;
}

/* What is shown when the clock stands and all is done. */
static size_t shown(Player *player)
{
    PlayerStatus status;
    ParticleBuffers particles;
    const double until = wall_ms() + PATIENCE_MS;
    for (int k = 0; k < 4; k++) { /* waiting steps: processed in sequence */
        do {
            player_work(player, now_ms);
            player_status(player, &status);
            usleep(500);
            assert_true(wall_ms() < until);
        } while (!status.prefetch.answered || (k == 0 && !player_take(player, &particles)));
    }
    assert_true(player_take(player, &particles));
    assert_int_equal(particles.count, status.prefetch.index + 1);
    return status.prefetch.index;
}

/* So many seconds of the clock, in pictures. */
static void run(Player *player, double seconds)
{
    for (int k = 0; k < 100; k++) {
        now_ms += 10 * seconds;
        player_work(player, now_ms);
    }
}

static void rest_is_neither_played_nor_polled(void **state)
{
    (void)state;
    PlayerStatus status;
    const size_t one = 3;
    Recorded recorded;
    Player *player = open_player(false);
    shown(player);
    player_set_speed(player, 64);
    run(player, 2);
    shown(player);
    player_status(player, &status);
    assert_true(fabs(status.played_s - 1.9) < 1e-9);
    assert_true(isinf(player_work(player, now_ms)));
    player_go_to(player, 0.55);
    player_set_speed(player, 1);
    const double due_ms = player_work(player, now_ms); /* the step was asked for just now */
    assert_true(due_ms >= 40);
    player_destroy(player);
    write_file("b.h5part", &one, 1, 0.1);
    open_recorded(&recorded, "b.h5part", NULL);
    player = player_create(&recorded, NULL, false, &error);
    must(player, &error);
    player_set_loop(player, true);
    do {
        player_work(player, now_ms += 10);
        player_status(player, &status);
        usleep(500);
    } while (!status.prefetch.answered);
    run(player, 2);
    assert_true(isinf(player_work(player, now_ms)));
    player_status(player, &status);
    assert_true(status.played_s == 0);
    player_destroy(player);
}

static void time_follows_the_clock(void **state)
{
    (void)state;
    Player *player = open_player(false);
    assert_int_equal(shown(player), 0);
    run(player, 0.55);
    assert_int_equal(shown(player), 5);
    player_set_speed(player, 2);
    run(player, 0.2);
    assert_int_equal(shown(player), 9);
    player_set_speed(player, 1.0 / 64);
    run(player, 1);
    assert_int_equal(shown(player), 9);
    player_pause(player, true);
    run(player, 5);
    assert_int_equal(shown(player), 9);
    player_pause(player, false);
    player_set_speed(player, 64);
    run(player, 1);
    assert_int_equal(shown(player), STEPS - 1); /* it rests at the end */
    assert_true(isinf(player_work(player, now_ms)));
    player_destroy(player);
}

static void a_stall_is_left_out(void **state)
{
    (void)state;
    Player *player = open_player(false);
    assert_int_equal(shown(player), 0);
    now_ms += 10000;
    player_work(player, now_ms);
    assert_int_equal(shown(player), 2); /* a quarter of a second */
    player_destroy(player);
}

static void it_says_when_the_next_step_is_due(void **state)
{
    (void)state;
    Player *player = open_player(false);
    assert_int_equal(shown(player), 0);
    assert_true(fabs(player_work(player, now_ms) - 100) < 1e-6);
    now_ms += 30;
    assert_true(fabs(player_work(player, now_ms) - 70) < 1e-6);
    player_set_speed(player, 0.5);
    assert_true(fabs(player_work(player, now_ms) - 140) < 1e-6);
    player_pause(player, true);
    assert_true(isinf(player_work(player, now_ms)));
    player_destroy(player);
}

static void it_begins_anew(void **state)
{
    (void)state;
    PlayerStatus status;
    Player *player = open_player(false);
    player_set_loop(player, true);
    assert_int_equal(shown(player), 0);
    run(player, 1.9 + 0.35); /* the file lasts 1.9 s */
    assert_int_equal(shown(player), 3);
    player_status(player, &status);
    assert_true(status.loop && fabs(status.played_s - 2.25) < 1e-9);
    player_destroy(player);
}

static void steps_and_jumps(void **state)
{
    (void)state;
    PlayerStatus status;
    Player *player = open_player(false);
    assert_int_equal(shown(player), 0);
    player_step(player, 1, false);
    assert_int_equal(shown(player), 1);
    player_status(player, &status);
    assert_true(status.paused);
    player_step(player, 1, false); /* each counts */
    player_step(player, 1, false);
    player_step(player, 1, true); /* but of a key that is held */
    assert_int_equal(shown(player), 3);
    player_step(player, -1, false);
    assert_int_equal(shown(player), 2);
    for (int k = 0; k < 2; k++) {
        player_step(player, -1, false);
        shown(player);
    }
    player_step(player, -1, false);
    assert_int_equal(shown(player), 0);
    player_go_to(player, 1.55);
    assert_int_equal(shown(player), 15);
    player_go_by(player, -1);
    assert_int_equal(shown(player), 5);
    player_go_by(player, -1);
    assert_int_equal(shown(player), 0);
    player_go_to(player, INFINITY);
    assert_int_equal(shown(player), STEPS - 1);
    player_step(player, 1, false);
    assert_int_equal(shown(player), STEPS - 1);
    player_go_to(player, -INFINITY);
    assert_int_equal(shown(player), 0);
    player_destroy(player);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, folder_setup, folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(time_follows_the_clock), TEST(rest_is_neither_played_nor_polled),
        TEST(a_stall_is_left_out),    TEST(it_says_when_the_next_step_is_due),
        TEST(it_begins_anew),         TEST(steps_and_jumps),
    };
    return cmocka_run_group_tests(tests, context_begin, context_end);
}
