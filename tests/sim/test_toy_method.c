/* The toy method is listed, is saved, and has the same bits on any number of threads. */
#include "sim/state.h"
#include "tests/sim/fixture.h"
#include "tests/sim/toy_method.h"

static void toy_lives(void **state)
{
    (void)state;
    Error error;
    WorldState saved = {.count = 0};
    WorldDef def = fixture_def(1, 1, 1);
    strcpy(def.method, "toy"), fixture_block(&def, 0, -0.4, 0, -0.4, 0.2, 0.5, 0.4);
    World *one = fixture_world(&def), *three = (*world_threads(&def) = 3, fixture_world(&def));
    fixture_step(one, 30);
    assert_true(world_save(one, &saved, &error) && world_load(three, &saved, &error));
    fixture_step(one, 5), fixture_step(three, 5);
    assert_float_equal(saved.particles.own[0][5], 0.06 * saved.particles.id[5], 1e-4);
    assert_true(world_hash(one) && world_hash(one) == world_hash(three));
    const Named *last = world_methods();
    while (last[1].name)
        last++;
    assert_string_equal(last->name, "toy");
    world_state_free(&saved), world_destroy(one), world_destroy(three);
}

int main(void)
{
    toy_method_add();
    return cmocka_run_group_tests(((const struct CMUnitTest[]){cmocka_unit_test(toy_lives)}), NULL, NULL);
}
