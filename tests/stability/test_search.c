/* The search on made-up fluids; the table of its trials. */
#include "tests/sim/fixture.h"

#include "app/lab/stability.h"

/* Holds up to `limit`, and in the band [low, high]. `silent` rungs above the limit fail undetected; of
   rungs above `mixed` below the limit the start `bad` fails. */
typedef struct MadeUp {
    int limit, low, high, silent, mixed, bad, breaks, tries, wholes, highest;
} MadeUp;

static bool made_up(void *context, int rung, int start, bool whole, StableFound *found)
{
    MadeUp *m = context;
    m->tries++;
    m->wholes += whole;
    m->highest = rung > m->highest ? rung : m->highest;
    const bool chance = m->bad > 0 && start == m->bad && rung > m->mixed;
    const bool holds = !chance && (rung <= m->limit || (rung >= m->low && rung <= m->high));
    *found = (StableFound){holds                          ? OUTCOME_HOLDS
                           : rung <= m->limit + m->silent ? OUTCOME_NOISY
                                                          : OUTCOME_BLOWN_UP,
                           !holds && rung <= m->limit + m->silent};
    return m->tries != m->breaks;
}

static StableSearch search_of(MadeUp *m, int first, int most)
{
    StableSearch search;
    m->highest = -1000;
    assert_true(stable_search(made_up, m, first, most, &search));
    assert_true(m->highest <= most);
    return search;
}

static void a_limit_is_found_from_anywhere(void **state)
{
    (void)state;
    for (int limit = -30; limit <= 30; limit++)
        for (int first = limit - 30; first <= limit + STABLE_DOWN; first++) {
            MadeUp m = {.limit = limit, .low = 1000};
            const StableSearch search = search_of(&m, first, 200);
            assert_true(search.end == STABLE_FOUND && search.rung == limit && search.again == limit);
            assert_true(m.tries <= 15 + 2 * STABLE_STARTS && m.wholes == STABLE_ABOVE);
            for (int i = 0; i < STABLE_ABOVE; i++)
                assert_int_equal(search.above[i].kind, OUTCOME_BLOWN_UP);
        }
}

static void what_is_above_is_told(void **state)
{
    (void)state;
    MadeUp m = {.limit = 3, .low = 1000, .silent = 4};
    StableSearch search = search_of(&m, 0, 200);
    for (int i = 0; i < STABLE_ABOVE; i++) {
        assert_int_equal(search.above[i].kind, i < 2 ? OUTCOME_NOISY : OUTCOME_BLOWN_UP);
        assert_int_equal(search.above[i].silent, i < 2);
    }
    m = (MadeUp){.limit = 3, .low = 7, .high = 8}; /* holds again at five rungs above */
    search = search_of(&m, 2, 200);
    assert_true(search.rung == 3 && search.again == 8);
    assert_int_equal(search.above[2].kind, OUTCOME_HOLDS);
    assert_int_equal(search.above[3].kind, OUTCOME_BLOWN_UP);
    m = (MadeUp){.limit = 3, .low = 9, .high = 12}; /* what holds is an island, too near to what fails */
    search = search_of(&m, 9, 200);
    assert_true(search.rung == 3 && search.again == 12);
    m = (MadeUp){.limit = -1000, .low = 3, .high = 5, .silent = 2000};
    search = search_of(&m, 4, 200);
    assert_true(search.end == STABLE_NEVER && search.again == 5);
    m = (MadeUp){.limit = 3, .low = 1000};
    search = search_of(&m, 0, 5); /* what may not be tried is not */
    assert_true(search.rung == 3);
    assert_int_equal(search.above[0].kind, OUTCOME_BLOWN_UP);
    assert_int_equal(search.above[1].kind, OUTCOME_NONE);
}

/* Near the limit one start of several does not hold. */
static void what_holds_by_chance_is_not_named(void **state)
{
    (void)state;
    for (int bad = 1; bad < STABLE_STARTS; bad++)
        for (int mixed = -3; mixed <= 5; mixed++) {
            MadeUp m = {.limit = 5, .low = 1000, .mixed = mixed, .bad = bad};
            const StableSearch search = search_of(&m, 0, 200);
            assert_true(search.end == STABLE_FOUND && search.rung == mixed && search.again == 5);
            assert_int_not_equal(search.above[0].kind, OUTCOME_HOLDS);
        }
}

static void there_may_be_no_limit(void **state)
{
    (void)state;
    MadeUp never = {.limit = -1000, .low = 1000}, always = {.limit = 1000, .low = 2000};
    StableSearch search = search_of(&never, 0, 200);
    assert_true(search.end == STABLE_NEVER && search.rung == -STABLE_DOWN && search.again == search.rung);
    for (int i = 0; i < STABLE_ABOVE; i++)
        assert_int_equal(search.above[i].kind, OUTCOME_BLOWN_UP);
    assert_true(never.tries == 4 + STABLE_ABOVE && never.wholes == 0);
    assert_true(stable_sample(&search, 3) == 0 && stable_sample(&search, 0) == search.rung);
    search = search_of(&always, 0, 20);
    assert_true(search.end == STABLE_ALWAYS && search.rung == 20);
    assert_int_equal(search.above[0].kind, OUTCOME_NONE);
    search = search_of(&always, 30, 20); /* a guess beyond what may be tried */
    assert_true(search.end == STABLE_ALWAYS && search.rung == 20);
}

static void a_trial_that_cannot_be_made_ends_it(void **state)
{
    (void)state;
    for (int breaks = 1; breaks <= 9; breaks++) {
        MadeUp m = {.limit = 5, .low = 1000, .breaks = breaks};
        StableSearch search;
        assert_false(stable_search(made_up, &m, 0, 200, &search));
        assert_int_equal(m.tries, breaks);
    }
}

static void rungs_are_steps(void **state)
{
    (void)state;
    for (int rung = -100; rung < 10; rung++)
        assert_int_equal(stable_rung(stable_step(rung)), rung);
    assert_true(stable_step(0) == 1 && stable_step(-STABLE_RUNGS) == 0.5);
}

/* ---- the table ---- */

static const char PATH[] = "test_stable_rows.csv";

static StableRow row_of(int n)
{
    StableRow row = {.key = 0x9e3779b97f4a7c15ULL * (uint64_t)(n + 1),
                     .rung = -n,
                     .step = stable_step(-n),
                     .steps = (uint64_t)n * 10,
                     .finder = n % 3 ? FOUND_BY_NOBODY : FOUND_BY_LOOKS,
                     .outcome = {.kind = n % 3 ? OUTCOME_HOLDS : OUTCOME_SQUEEZED, .time = 0.1 * n}};
    snprintf(row.method, sizeof row.method, "%s", n % 2 ? "mueller" : "wcsph");
    snprintf(row.backend, sizeof row.backend, "cpu");
    snprintf(row.at, sizeof row.at, "solver.sound_speed=%d", n % 5);
    if (n % 3 == 0)
        snprintf(row.outcome.words, sizeof row.outcome.words, "pressed, by %d %%", n);
    else
        row.outcome.time = (double)NAN;
    return row;
}

static char *file_text(void)
{
    static char text[65536];
    FILE *file = fopen(PATH, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void rows_come_back_in_any_order(void **state)
{
    (void)state;
    enum { N = 300 };
    Trials rows = {.table = &stable_table}, back = {.table = &stable_table};
    static char first[65536];
    Error error;
    for (int n = 0; n < N; n++) {
        const StableRow row = row_of(n * 7 % N);
        assert_true(trials_add(&rows, &row, NULL) && trials_add(&rows, &row, NULL));
    }
    assert_int_equal(rows.count, N);
    assert_true(trials_write(&rows, PATH, &error));
    snprintf(first, sizeof first, "%s", file_text());
    assert_true(trials_read(&back, PATH, stderr, &error));
    assert_int_equal(back.count, N);
    for (int n = 0; n < N; n++) {
        const StableRow row = row_of(n);
        const StableRow *found = trials_find(&back, row.key);
        assert_non_null(found);
        assert_true(found->rung == row.rung && found->steps == row.steps && found->finder == row.finder &&
                    found->outcome.kind == row.outcome.kind);
        assert_string_equal(found->outcome.words, row.outcome.words);
        assert_string_equal(found->at, row.at);
    }
    assert_null(trials_find(&back, 1));
    assert_true(trials_write(&back, PATH, &error));
    assert_string_equal(file_text(), first);
    trials_free(&rows);
    trials_free(&back);
    remove(PATH);
}

static int read_with(const char *line, const char *as)
{
    Trials rows = {.table = &stable_table};
    Error error;
    const StableRow one = row_of(3), other = row_of(4);
    assert_true(trials_add(&rows, &one, NULL) && trials_add(&rows, &other, NULL) &&
                trials_write(&rows, PATH, &error));
    char *text = file_text(), *at = strstr(text, line);
    assert_non_null(at);
    FILE *file = fopen(PATH, "w"), *none = fopen("/dev/null", "w");
    fprintf(file, "%.*s%s%s", (int)(at - text), text, as, at + strlen(line));
    fclose(file);
    assert_true(trials_read(&rows, PATH, none, &error));
    const int count = rows.count;
    fclose(none);
    trials_free(&rows);
    remove(PATH);
    return count;
}

static void broken_rows_are_left_out(void **state)
{
    (void)state;
    static const char *const broken[][2] = {{"squeezed,", "squashed,"},
                                            {",looks,", ",someone,"},
                                            {",nobody,", ",sentinel,"},
                                            {",-3,", ",3e9,"},
                                            {",-4,", ",,"},
                                            {",30,", ",-30,"},
                                            {",cpu,", ",,"},
                                            {",cpu,", ","},
                                            {"solver.sound_speed=4\n", "solver.sound_speed=4"},
                                            {"solver.sound_speed=4", "4,more"}};
    assert_int_equal(read_with(",cpu,", ",cpu,"), 2);
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++)
        if (read_with(broken[i][0], broken[i][1]) != 1)
            fail_msg("%s as %s", broken[i][0], broken[i][1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_is_found_from_anywhere),      cmocka_unit_test(what_is_above_is_told),
        cmocka_unit_test(what_holds_by_chance_is_not_named),   cmocka_unit_test(there_may_be_no_limit),
        cmocka_unit_test(a_trial_that_cannot_be_made_ends_it), cmocka_unit_test(rungs_are_steps),
        cmocka_unit_test(rows_come_back_in_any_order),         cmocka_unit_test(broken_rows_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
