/* What may change while a world lives. */
#include "fixture.h"

#include "sim/state.h"

static WorldDef two_fluids(void)
{
    WorldDef def = fixture_def(1, 1, 1);
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.3, 0.5);
    fixture_block(&def, 1, -0.5, 0.3, -0.5, 0.5, 0.6, 0.5);
    def.fluid_count = 2;
    def.fluids[1].density = 800;
    return def;
}

/* A world changed before the first step equals a world made with the change. */
static void changed_at_the_start_is_made_so(void **state)
{
    (void)state;
    Error error = {0};
    WorldDef def = two_fluids();
    World *changed = fixture_world(&def);
    def.gravity[0] = 3;
    def.fluids[0].viscosity = 2;
    def.fluids[1].viscosity = 0.5;
    def.sound_speed *= 1.5;
    def.negative_pressure = true;
    def.dt = 0.001;
    def.substeps = 2;
    World *made = fixture_world(&def);
    assert_true(world_change(changed, &def, &error));
    const int frames = fixture_count(40, 10);
    fixture_step(changed, frames);
    fixture_step(made, frames);
    assert_int_equal(world_hash(changed), world_hash(made));
    WorldInfo a, b;
    world_info(changed, &a);
    world_info(made, &b);
    assert_true(a.time == b.time);
    assert_int_equal(a.step, 2 * frames);
    world_destroy(changed);
    world_destroy(made);
}

/* Time goes on from where it was, at the new pace; and there is a way back. */
static void time_goes_on(void **state)
{
    (void)state;
    Error error = {0};
    const WorldDef def = two_fluids();
    WorldDef faster = def;
    faster.dt = 0.001;
    World *world = fixture_world(&def);
    WorldInfo info;
    fixture_step(world, 10);
    assert_true(world_change(world, &faster, &error));
    world_info(world, &info);
    assert_true(fabs(info.time - 0.020) < 1e-12);
    fixture_step(world, 10);
    world_info(world, &info);
    assert_true(fabs(info.time - 0.030) < 1e-12);
    assert_true(world_change(world, &def, &error));
    fixture_step(world, 1);
    world_info(world, &info);
    assert_true(fabs(info.time - 0.032) < 1e-12);
    world_destroy(world);
}

/* What makes no sense is refused, and the world goes on as if it had not been asked for. */
static void nonsense_changes_nothing(void **state)
{
    (void)state;
    Error error = {0};
    const WorldDef def = two_fluids();
    World *asked = fixture_world(&def), *left = fixture_world(&def);
    WorldDef bad = def;
    bad.dt = 0;
    bad.gravity[1] = 50;
    assert_false(world_change(asked, &bad, &error));
    assert_non_null(strstr(error.message, "dt"));
    bad.dt = def.dt;
    bad.fluids[1].viscosity = NAN;
    assert_false(world_change(asked, &bad, &error));
    fixture_step(asked, fixture_count(20, 5));
    fixture_step(left, fixture_count(20, 5));
    assert_int_equal(world_hash(asked), world_hash(left));
    world_destroy(asked);
    world_destroy(left);
}

/* A turn about half the height: fluid at rest in a tilted box without gravity stays in place. */
static void a_tilted_box_grows_without_a_jerk(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    Error error;
    WorldInfo info;
    memset(def.gravity, 0, sizeof def.gravity);
    fixture_block(&def, 0, -0.3, 0.3, -0.3, 0.3, 0.7, 0.3);
    World *world = fixture_world(&def);
    world_carry_box(world, &(BoxTarget){.orientation = {0, 0, sin(0.25), cos(0.25)}});
    fixture_step(world, 2);
    def.box_size[1] = 2;
    assert_true(world_set_shapes(&world, &def, &error));
    world_info(world, &info);
    float *before = malloc(8 * info.count * sizeof *before), *after = before + 4 * info.count;
    assert_true(before && world_read(world, &(ParticleArrays){.position = before}));
    fixture_step(world, 1);
    assert_true(world_read(world, &(ParticleArrays){.position = after}));
    for (size_t i = 0; i < 4 * info.count; i++)
        if (i % 4 != 3 && fabsf(before[i] - after[i]) > 0.02F * (float)def.spacing)
            fail_msg("particle %zu goes %g m along axis %zu", i / 4, (double)(after[i] - before[i]), i % 4);
    free(before);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tilted_box_grows_without_a_jerk),
        cmocka_unit_test(changed_at_the_start_is_made_so),
        cmocka_unit_test(time_goes_on),
        cmocka_unit_test(nonsense_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
