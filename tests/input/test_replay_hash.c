/* The hash of a recording, mapping and camera: equal for equal inputs, on any machine and for any user. */
#include "tests/app/output_fixture.h"

#include "app/input/input.h"

#define HEAD "slosh device recording 1\n0 1 plugged dualsense 054c:0ce6 usb\n"

static const char plain[] = HEAD "0.1 1 report 01fe\n";

/* Of the recording with the mapping file ("": built in), viewed along `away_z`. */
static void mark_of(const char *recording, const char *yaml, double away_z,
                    char mark[DEVICE_REPLAY_HASH_SIZE])
{
    Error error = {{0}};
    ReportLog log;
    Mapping mapping;
    const HandInput axes = {.right = {1, 0, 0}, .up = {0, 1, 0}, .away = {0, 0, away_z}};
    mapping_default(&mapping);
    if (!report_log_parse("a.rec", recording, strlen(recording), &log, &error) ||
        (*yaml && !mapping_parse("m.yaml", yaml, strlen(yaml), &mapping, &error)))
        fail_msg("%s", error.message);
    assert_true(device_replay_hash(&log, &mapping, &axes, mark));
    assert_int_equal(strlen(mark), DEVICE_REPLAY_HASH_SIZE - 1);
    report_log_destroy(&log);
}

static void any_difference_that_moves_the_box_tells(void **state)
{
    (void)state;
    static const struct {
        const char *recording, *yaml;
        double away_z;
    } others[] = {
        {HEAD "0.1 1 report 01ff\n", "", -1},
        {HEAD "0.2 1 report 01fe\n", "", -1},
        {HEAD "0.1 1 report 01\n", "", -1},
        {HEAD "0.1 1 report 01fe\n0.2 1 unplugged\n", "", -1},
        {plain, "dualsense: {gain: 1.5}\n", -1},
        {plain, "dualsense: {axes: {left_x: {invert: true}}}\n", -1},
        {plain, "", 1},
    };
    char mark[DEVICE_REPLAY_HASH_SIZE], other[DEVICE_REPLAY_HASH_SIZE];
    mark_of(plain, "", -1, mark);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        mark_of(others[i].recording, others[i].yaml, others[i].away_z, other);
        if (strcmp(mark, other) == 0)
            fail_msg("number %zu has the same mark", i);
    }
}

/* A run is resumed on a different machine, by a different user. */
static void the_same_at_another_home(void **state)
{
    (void)state;
    char mark[DEVICE_REPLAY_HASH_SIZE], other[DEVICE_REPLAY_HASH_SIZE];
    assert_int_equal(setenv("XDG_CONFIG_HOME", "/home/a/config", 1), 0);
    mark_of(plain, "", -1, mark);
    assert_int_equal(setenv("XDG_CONFIG_HOME", "/srv/b", 1), 0);
    mark_of(plain, "dualsense: {gain: 1} # as built in\n", -1, other);
    assert_string_equal(mark, other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_difference_that_moves_the_box_tells),
        cmocka_unit_test(the_same_at_another_home),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
