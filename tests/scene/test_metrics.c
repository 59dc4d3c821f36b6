/* The metrics of a scene: names, refusals, and numbers against sums by hand. */
#include "tests/scene/scene_text.h"
#include "tests/sim/fixture.h"

#include "app/run/measure/measure.h"
#include "app/scene/scene.h"

static Scene scene;
static Error error;

static const char tank[] = "box: {size: [1, 1, 1]}\n"
                           "particles: {spacing: 0.1}\n"
                           "fluids:\n"
                           "  - {density: 800, velocity: [1, 0, 0], start: rest,\n"
                           "     fill: [{block: {min: [-0.5, 0, -0.5], max: [0.1, 0.4, 0.5]}}]}\n"
                           "metrics: [front, kinetic_energy]\n";

static void names_are_read(void **state)
{
    (void)state;
    assert_true(parse_text(tank, NULL, &scene, &error));
    assert_int_equal(scene.metric_count, 2);
    assert_string_equal(metric_kinds[scene.metrics[0]].name, "front");
    assert_string_equal(metric_kinds[scene.metrics[1]].name, "kinetic_energy");
    assert_true(parse_set(tank, "metrics=[height]", &scene, &error));
    assert_int_equal(scene.metric_count, 1);
    assert_string_equal(metric_kinds[scene.metrics[0]].name, "height");
    scene_default(&scene);
    assert_int_equal(scene.metric_count, 2);
    assert_string_equal(metric_kinds[scene.metrics[0]].name, "centre_of_mass");
    assert_string_equal(metric_kinds[scene.metrics[1]].name, "kinetic_energy");
}

static void refused(const char *setting, const char *words)
{
    assert_false(parse_set(tank, setting, &scene, &error));
    if (!strstr(error.message, words))
        fail_msg("%s", error.message);
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    refused(
        "metrics=[front, kinetic_enery]",
        "metrics cannot have 'kinetic_enery'; did you mean 'kinetic_energy'? its names are: centre_of_mass");
    refused("metrics=[colour]",
            "metrics cannot have 'colour'; its names are: centre_of_mass, kinetic_energy");
    refused("metrics=[[front]]", "metrics cannot have ''");
    refused("metrics=front", "metrics must be a list, such as [centre_of_mass]");
    refused("metrics=[]", "metrics has 0 entries; it must have 1 to 8");
    refused("metrics=[front, probes]", "metrics has 'probes', and the scene names none; add `probes`");
    refused("metrics=[front, height, front]", "metrics has 'front' twice");
    assert_false(parse_text("box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1}\n"
                            "fluids:\n  - fill: [{ball: {centre: [0, 0.5, 0], radius: 0.2}}]\n"
                            "metrics: [front, sped]\n",
                            NULL, &scene, &error));
    assert_non_null(strstr(error.message, "5:18: metrics cannot have 'sped'")); /* line and column */
}

static double value_of(World *world, const char *name, int component)
{
    double out[METRIC_NUMBERS] = {0};
    MetricState state = {.def = NULL};
    int m = 0;
    while (strcmp(metric_kinds[m].name, name) != 0)
        m++;
    assert_true(metric_state_read(&state, &scene.world, world, &m, 1));
    metric_kinds[m].of(&state, out);
    metric_state_free(&state);
    return out[component];
}

/* Of a block 6 x 4 x 10 particles of 0.8 kg at the start, which moves at 1 m/s as a whole. */
static void numbers_are_right(void **state)
{
    (void)state;
    assert_true(parse_text(tank, NULL, &scene, &error));
    World *world = fixture_world(&scene.world);
    const double mass = 192, g = -scene.world.gravity[1];
    const struct {
        const char *name;
        int component;
        double right, tolerance;
    } rows[] = {{"centre_of_mass", 0, -0.2, 1e-6},
                {"centre_of_mass", 1, 0.2, 1e-6},
                {"kinetic_energy", 0, 0.5 * mass, 1e-3},
                {"potential_energy", 0, mass * g * 0.2, 1e-2},
                {"angular_momentum", 2, -mass * 0.2, 1e-3},
                {"max_speed", 0, 1, 1e-6},
                {"front", 0, 0.1, 1e-6},
                {"height", 0, 0.4, 1e-6}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double value = value_of(world, rows[i].name, rows[i].component);
        if (!(fabs(value - rows[i].right) <= rows[i].tolerance))
            fail_msg("%s: %.9g, not %.9g", rows[i].name, value, rows[i].right);
    }
    assert_true(value_of(world, "density_error", 0) < 0.01);
    scene.world.periodic[0] = scene.world.periodic[1] = true; /* as if: places are wrapped there */
    assert_true(value_of(world, "centre_of_mass", 0) == 0 && value_of(world, "potential_energy", 0) == 0);
    scene.world.periodic[0] = scene.world.periodic[1] = false;
    fixture_step(world, 20);
    State read = fixture_read(world);
    double sum = 0;
    for (size_t i = 0; i < read.count; i++)
        sum += fmax((double)read.density[i] / 800 - 1, 0) / (double)read.count;
    assert_true(sum > 0 && fabs(value_of(world, "density_error", 0) - sum) < 1e-9);
    fixture_free(&read);
    world_destroy(world);
}

/* All stand in the list once, with help, and in no more numbers than there is room for. */
static void the_list_is_whole(void **state)
{
    (void)state;
    int count = 0;
    for (; metric_kinds[count].name; count++) {
        assert_true(*metric_kinds[count].help && metric_kinds[count].unit && metric_kinds[count].of);
        const int numbers = metric_kinds[count].numbers;
        assert_true(numbers == 1 || numbers == METRIC_NUMBERS ||
                    (numbers == 0 && strcmp(metric_kinds[count].name, "probes") == 0));
        assert_ptr_equal(key_choice(scene_key_find("metrics"), count), metric_kinds[count].name);
    }
    assert_true(count >= 5);
    assert_null(key_choice(scene_key_find("metrics"), count));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_read),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(numbers_are_right),
        cmocka_unit_test(the_list_is_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
