/* A flow that has nearly died out: what is less than the least normal number is 0, on any number of threads.
 */
#include "tests/sim/fixture.h"

#include <float.h>

enum { SIDE = 9, COUNT = SIDE * SIDE * SIDE };

static void what_dies_out_is_zero(void **state)
{
    (void)state;
    fixture_needs_cpu("a driver has its own way");
    static float x[3 * COUNT], v[3 * COUNT];
    uint64_t hash[2];
    uint32_t seed = 5;
    WorldDef def = fixture_def(2, 2, 2);
    memset(def.gravity, 0, sizeof def.gravity);
    strcpy(def.method, "wcsph"); /* what is at rest has no pressure, not even one of roundings */
    def.fluids[0].viscosity = 10;
    for (size_t i = 0; i < COUNT; i++)
        for (size_t k = 0; k < 3; k++) {
            x[3 * i + k] =
                (float)(0.1 * (double)(i / (size_t[]){1, SIDE, SIDE * SIDE}[k] % SIDE) + (k == 1) - 0.4);
            v[3 * i + k] = (float)(4 * (fixture_random(&seed) - 0.5)) * FLT_MIN;
        }
    def.initial = &(InitialState){.count = COUNT, .position = x, .velocity = v};
    for (int run = 0; run < 2; run++) {
        *world_threads(&def) = 1 + 2 * run;
        World *world = fixture_world(&def);
        fixture_step(world, 5);
        hash[run] = world_hash(world);
        State s = fixture_read(world);
        for (size_t i = 0; i < 4 * s.count; i++)
            if (s.velocity[i] != 0 && fabsf(s.velocity[i]) < FLT_MIN)
                fail_msg("a velocity is %g", (double)s.velocity[i]);
        fixture_free(&s);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_dies_out_is_zero)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
