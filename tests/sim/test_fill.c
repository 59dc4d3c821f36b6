/* Fills: the lattice points inside. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/start/start.h"

/* A slanted cylinder, by the distance from its axis and along it. */
static void a_cylinder_has_its_points(void **state)
{
    (void)state;
    WorldDef def = fixture_def(4, 4, 4);
    const Fill *fill = add_fill(&def.fluids[0], (Fill){.kind = FILL_CYLINDER,
                                                       .centre = {0.3, 2, -0.2},
                                                       .radius = 0.55,
                                                       .height = 1.7,
                                                       .axis = {2, 3, -6}}); /* of length 7 */
    const size_t count = seed_lattice(&def, NULL, NULL);
    float *x = malloc(3 * count * sizeof *x);
    uint8_t *fluid = malloc(count);
    assert_int_equal(seed_lattice(&def, x, fluid), count);
    for (size_t i = 0; i < count; i++) {
        const double d[3] = {x[3 * i] - 0.3, x[3 * i + 1] - 2, x[3 * i + 2] + 0.2};
        const double along = (2 * d[0] + 3 * d[1] - 6 * d[2]) / 7;
        const double across2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - along * along;
        assert_true(fabs(along) < 0.85 + 1e-6 && across2 < 0.55 * 0.55 + 1e-6);
    }
    const double volume = fill_volume(fill, 3);
    assert_true(fabs(volume - 0.55 * 0.55 * M_PI * 1.7) < 1e-12);
    assert_true(fabs((double)count * 1e-3 / volume - 1) < 0.02); /* none is missing */
    free(x);
    free(fluid);
}

static size_t written(const WorldDef *def)
{
    static float x[3 * 20000];
    return seed_lattice(def, x, NULL);
}

/* Separate blocks are counted along the axes: as many as specified, with faces anywhere. */
static void what_is_counted_is_written(void **state)
{
    (void)state;
    for (int i = 0; i < 400; i++) {
        const double s = 0.1, a = s * (i % 7) / 3, b = s * (i % 11) / 4, c = i % 5 ? s * i / 90 : 0;
        WorldDef def = fixture_def(1, 1, 1);
        def.dimensions = i % 4 ? 3 : 2;
        fixture_block(&def, 0, -0.5 + a, b, -0.3, -0.5 + a + c, 0.2 + b, 0.3 - b);
        fixture_block(&def, 0, -0.5 + a + c, b, -0.5, 0.5, 0.2 + b + a, 0.5 - a);   /* touching */
        fixture_block(&def, 0, -0.2, 0.3 + b - a, -0.3, 0.1 + c, 0.8 - b, 0.3 - b); /* may overlap two */
        assert_int_equal(seed_lattice(&def, NULL, NULL), written(&def));
        def.fluids[0].fill_count = 1 + i % 2;
        assert_int_equal(seed_lattice(&def, NULL, NULL), written(&def));
    }
}

/* The block around a fill touches it on each side. */
static void bounds_are_close(void **state)
{
    (void)state;
    double low[3], high[3];
    const Fill slanted = {
        .kind = FILL_CYLINDER, .centre = {1, 2, 3}, .radius = 0.5, .height = 2, .axis = {0, 3, 4}};
    fill_bounds(&slanted, low, high);
    assert_true(fabs(high[0] - 1.5) < 1e-12 && fabs(low[0] - 0.5) < 1e-12);
    assert_true(fabs(high[1] - (2 + 0.6 + 0.5 * 0.8)) < 1e-12 &&
                fabs(low[2] - (3 - 0.8 - 0.5 * 0.6)) < 1e-12);
    const Fill ball = {.kind = FILL_BALL, .centre = {1, 2, 3}, .radius = 0.5};
    fill_bounds(&ball, low, high);
    assert_true(low[2] == 2.5 && high[1] == 2.5);
}

static void a_cylinder_needs_three_dimensions(void **state)
{
    (void)state;
    Error error;
    WorldDef def = fixture_def(4, 4, 0);
    add_fill(
        &def.fluids[0],
        (Fill){.kind = FILL_CYLINDER, .centre = {0, 2, 0}, .radius = 0.5, .height = 1, .axis = {0, 1, 0}});
    def.dimensions = 2;
    assert_null(world_create(&def, &error));
    assert_non_null(strstr(error.message, "2D"));
}

/* A world copies the lists of its definition: later changes to the definition's lists change nothing. */
static void a_world_keeps_its_lists(void **state)
{
    (void)state;
    uint64_t hash[2];
    fixture_needs_cpu("the lists are the world's on any backend");
    for (int k = 0; k < 2; k++) {
        WorldDef def = fixture_def(1, 1, 1);
        Fill fills[] = {{.kind = FILL_BLOCK, .min = {-0.5, 0, -0.5}, .max = {0, 0.5, 0.5}}};
        Motion shake = {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 2},
               turn = shake;
        Emit jet = {.centre = {0.2, 0.8, 0}, .direction = {0, -1, 0}, .radius = 0.15, .speed = 2};
        Fill drain = {.kind = FILL_BALL, .centre = {-0.4, 0, 0.4}, .radius = 0.1};
        Error error;
        def.fluids[0].fills = fills, def.fluids[0].fill_count = 1;
        def.fluids[0].emits = &jet, def.fluids[0].emit_count = 1;
        def.motions = &shake, def.motion_count = 1;
        def.drains = &drain, def.drain_count = 1;
        def.solids[def.solid_count++] = (SolidDef){.kind = SOLID_SPHERE,
                                                   .centre = {0.3, 0.3, 0},
                                                   .radius = 0.12,
                                                   .motion_count = 1,
                                                   .motions = &turn};
        World *world = fixture_world(&def);
        if (k) {
            memset(fills, 0xff, sizeof fills);
            shake.amplitude = turn.amplitude = 3;
            jet.speed = 0.1;
            drain.radius = 1;
        }
        fixture_step(world, 20);
        hash[k] = world_hash(world);
        def.motions = NULL;
        assert_null(world_create(&def, &error));
        assert_string_equal(error.message, "1 motions, but no list of them");
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_counted_is_written), cmocka_unit_test(a_cylinder_has_its_points),
        cmocka_unit_test(bounds_are_close),           cmocka_unit_test(a_cylinder_needs_three_dimensions),
        cmocka_unit_test(a_world_keeps_its_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
