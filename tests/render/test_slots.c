/* A writer and a drawer, each at its own pace: no slot is ever touched by both, the writer never waits, and
   the drawer sees states whole and in order. ThreadSanitizer watches the bytes. */
#include "render/particles/particles.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <sched.h>

enum { STATES = 20000, WORDS = 64 };

typedef struct Shared {
    Slots slots;
    int words[SLOTS][WORDS];
} Shared;

static void *write_states(void *argument)
{
    Shared *shared = argument;
    for (int number = 1; number <= STATES; number++) {
        int *words = shared->words[slots_write_begin(&shared->slots)];
        for (int i = 0; i < WORDS; i++)
            words[i] = number;
        slots_write_end(&shared->slots);
        if (number % 16 == 0)
            sched_yield();
    }
    return NULL;
}

static void states_are_whole_and_in_order(void **state)
{
    (void)state;
    static Shared shared;
    pthread_t writer;
    int last = 0, in_flight = 0, before = SLOT_NONE;
    slots_create(&shared.slots);
    assert_int_equal(slots_draw(&shared.slots), SLOT_NONE);
    assert_int_equal(pthread_create(&writer, NULL, write_states, &shared), 0);
    while (last < STATES) {
        if (!slots_have_new(&shared.slots)) {
            sched_yield();
            continue;
        }
        slots_release_in_flight(&shared.slots);
        const int drawn = slots_draw(&shared.slots);
        assert_true(drawn >= 0 && drawn < SLOTS && drawn != before);
        const int *words = shared.words[drawn];
        assert_true(words[0] > last);
        for (int i = 0; i < WORDS; i++) {
            assert_int_equal(words[i], words[0]);
            if (before != SLOT_NONE)
                assert_int_equal(shared.words[before][i], in_flight);
        }
        before = drawn;
        in_flight = last = words[0];
    }
    pthread_join(writer, NULL);
    slots_destroy(&shared.slots);
}

/* The newest untaken state is overwritten. */
static void unread_states_are_overwritten(void **state)
{
    (void)state;
    Slots slots;
    slots_create(&slots);
    for (int i = 0; i < 100; i++) {
        slots_write_begin(&slots);
        slots_write_end(&slots);
    }
    const int first = slots_draw(&slots);
    for (int i = 0; i < 100; i++) {
        assert_int_not_equal(slots_write_begin(&slots), first);
        slots_write_end(&slots);
    }
    const int second = slots_draw(&slots);
    for (int i = 0; i < 100; i++) {
        const int written = slots_write_begin(&slots);
        assert_true(written != first && written != second);
        slots_write_end(&slots);
    }
    slots_release_in_flight(&slots);
    bool again = false;
    for (int i = 0; i < 100; i++) {
        again |= slots_write_begin(&slots) == first;
        slots_write_end(&slots);
    }
    assert_true(again);
    slots_destroy(&slots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_are_whole_and_in_order),
        cmocka_unit_test(unread_states_are_overwritten),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
