/* Save, load, step is step, to the bit; and what is no state of this world is refused. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/state.h"

static Error error;

static void must(bool ok)
{
    if (!ok)
        fail_msg("%s", error.message);
}

/* Two fluids in a box that shakes, turns and is in the hand. */
static WorldDef moving_def(int threads)
{
    WorldDef def = fixture_def(1, 1, 1);
    *world_threads(&def) = threads;
    def.retries = 3;
    def.substeps = 3;
    def.dt = 0.01;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 0.5;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 2};
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.3, 0.5);
    fixture_block(&def, 1, -0.5, 0.3, -0.5, 0, 0.6, 0.5);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 1});
    add_motion(&def, (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 5, .frequency = 0.7});
    return def;
}

static void live(World *world, int from, int to)
{
    for (int frame = from; frame < to; frame++) {
        const BoxTarget target = {{0.1 * sin(frame), 0, 0.05}, {0, 0, sin(0.1), cos(0.1)}};
        if (frame % 4 == 0)
            world_set_target(world, &target);
        if (frame == 7) {
            WorldDef def = moving_def(1);
            def.gravity[1] = -5;
            def.fluids[1].viscosity = 1;
            def.dt = 0.009;
            must(world_change(world, &def, &error));
        }
        fixture_step(world, 1);
    }
}

static void same_bits(World *a, World *b)
{
    WorldInfo one, other;
    world_info(a, &one);
    world_info(b, &other);
    assert_true(world_hash(a) == world_hash(b));
    assert_true(one.step == other.step && one.time == other.time && one.guarded == other.guarded);
    assert_memory_equal(&one.box, &other.box, sizeof one.box);
    assert_memory_equal(&one.hand, &other.hand, sizeof one.hand);
}

/* Wherever the state is taken: before the first step, in a frame, after a change, with the hand on its way.
 */
static void save_load_step_is_step(void **state)
{
    (void)state;
    for (int at = fixture_count(0, 4); at <= 12; at += fixture_count(3, 6)) {
        const WorldDef one = moving_def(1), three = moving_def(3);
        World *straight = fixture_world(&one), *loaded = fixture_world(&three);
        WorldState saved = {.count = 0};
        live(straight, 0, at);
        must(world_save(straight, &saved, &error));
        live(straight, at, 16);
        live(loaded, 0, 2); /* whatever value before */
        must(world_load(loaded, &saved, &error));
        live(loaded, at, 16);
        same_bits(straight, loaded);
        must(world_load(straight, &saved, &error)); /* back, and on again */
        live(straight, at, 16);
        same_bits(straight, loaded);
        world_state_free(&saved);
        world_destroy(straight);
        world_destroy(loaded);
    }
}

static void between_two_steps_of_a_frame(void **state)
{
    (void)state;
    const WorldDef def = moving_def(1);
    World *straight = fixture_world(&def), *loaded = fixture_world(&def);
    WorldState saved = {.count = 0};
    for (int i = 0; i < 20; i++) {
        if (i == 11)
            must(world_save(straight, &saved, &error));
        must(world_substep(straight, NULL, &error));
    }
    must(world_load(loaded, &saved, &error));
    for (int i = 11; i < 20; i++)
        must(world_substep(loaded, NULL, &error));
    same_bits(straight, loaded);
    world_state_free(&saved);
    world_destroy(straight);
    world_destroy(loaded);
}

static void refuse(World *world, const WorldState *bad, const char *reason)
{
    const uint64_t hash = world_hash(world);
    error = (Error){{0}};
    assert_false(world_load(world, bad, &error));
    if (!strstr(error.message, reason))
        fail_msg("expected '%s' in '%s'", reason, error.message);
    assert_true(world_hash(world) == hash);
}

/* The rate of density that wcsph keeps is a column of its own. */
static void a_methods_own_number_is_a_number(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    WorldDef def = moving_def(1);
    snprintf(def.method, sizeof def.method, "wcsph");
    World *world = fixture_world(&def);
    WorldState saved = {.count = 0};
    must(world_save(world, &saved, &error));
    int columns = 0;
    for (int k = 0; k < COLUMNS_OWN; k++) {
        float *own = saved.particles.own[k];
        if (!own)
            continue;
        const float kept = own[0];
        own[0] = INFINITY;
        refuse(world, &saved, "not those of the scene");
        own[0] = kept;
        columns++;
    }
    assert_true(columns > 0);
    assert_true(world_load(world, &saved, &error));
    world_state_free(&saved);
    world_destroy(world);
}

static void what_is_no_state_is_refused(void **state)
{
    (void)state;
    const WorldDef def = moving_def(1);
    World *world = fixture_world(&def);
    WorldState saved = {.count = 0};
    live(world, 0, 3);
    must(world_save(world, &saved, &error));
    live(world, 3, 4);
    WorldNumbers good = saved.numbers;

    saved.numbers.version = 99;
    refuse(world, &saved, "version 99");
    saved.numbers = good;
    saved.numbers.filter.velocity[1] = NAN;
    refuse(world, &saved, "not finite");
    saved.numbers = good;
    saved.numbers.since_step = good.step + 1;
    refuse(world, &saved, "do not count");
    saved.numbers = good;
    WorldDef bad = def;
    bad.dt = -1;
    live_save(&bad, saved.numbers.live);
    refuse(world, &saved, "dt");
    saved.numbers = good;
    saved.count--;
    refuse(world, &saved, "particles, the scene");
    saved.count++;
    const ParticleId id = saved.particles.id[5];
    saved.particles.id[5] = saved.particles.id[6];
    refuse(world, &saved, "not those of the scene");
    saved.particles.id[5] = id;
    saved.particles.fluid[0] = 2;
    refuse(world, &saved, "not those of the scene");
    saved.particles.fluid[0] = 0;
    saved.particles.x[1] = INFINITY;
    refuse(world, &saved, "not those of the scene");
    world_state_free(&saved);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(save_load_step_is_step),
        cmocka_unit_test(between_two_steps_of_a_frame),
        cmocka_unit_test(what_is_no_state_is_refused),
        cmocka_unit_test(a_methods_own_number_is_a_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
