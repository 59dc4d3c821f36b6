/* --set and --particles: edits of the tree before it is read. */
#include "sim/start/start.h"
#include "sim/world.h"
#include "tests/scene/scene_text.h"

#include <math.h>
#include <stdlib.h>

static Scene scene;
static Error error;

static void set(const char *setting)
{
    if (!parse_set(LEAST, setting, &scene, &error))
        fail_msg("%s", error.message);
}

static void values_replace_and_are_added(void **state)
{
    (void)state;
    set("particles.spacing=0.05");
    assert_true(scene.world.spacing == 0.05);
    set("box.size=[2, 1, 3]");
    assert_true(scene.world.box_size[0] == 2 && scene.world.box_size[2] == 3);
    set("box.size[1]=1.5");
    assert_true(scene.world.box_size[0] == 1 && scene.world.box_size[1] == 1.5);
    set("fluids[0].density=850");
    assert_true(scene.world.fluids[0].density == 850);
    set("solver.step.dt=0.004");
    assert_true(scene.world.dt == 0.004);
    set("title='Two words: and a colon'");
    assert_string_equal(scene.title, "Two words: and a colon");
}

/* Where 0 leaves the choice to slosh, a word stands for 0. */
static void a_word_stands_for_0(void **state)
{
    (void)state;
    set("view.radius=0.7");
    assert_true(scene.view.radius == 0.7);
    set("view.radius=auto");
    assert_true(scene.view.radius == 0);
    set("solver.threads=auto");
    assert_int_equal(*world_threads(&scene.world), 0);
    assert_set_refused("view.radius=automatic", "view.radius must be a number or auto");
    assert_set_refused("particles.spacing=auto", "particles.spacing must be a number in m");
}

static void lists_grow_by_one(void **state)
{
    (void)state;
    set("fluids[0].fill[1]={ball: {centre: [0, 0.8, 0], radius: 0.1}}");
    assert_int_equal(scene.world.fluids[0].fill_count, 2);
    set("motion=[{spin: {axis: [0, 1, 0], rate: 2}}]");
    assert_true(scene.world.motion_count == 1 && scene.world.motions[0].rate == 2);
    set("motion[0]={rock: {axis: [0, 0, 1], angle: 5, frequency: 1}}");
    assert_true(scene.world.motion_count == 1 && scene.world.motions[0].kind == MOTION_ROCK);
    assert_set_refused("fluids[2].density=3", "[2] is beyond the list's end; use at most 1, which appends");
}

static bool range_is_auto(const char *view, const char *setting, const char *more)
{
    char text[1024];
    SceneSettings settings = {.count = more ? 2 : 1, .set = {setting, more}};
    snprintf(text, sizeof text, LEAST "view: {%s}\n", view);
    if (!parse_text(text, &settings, &scene, &error))
        fail_msg("%s", error.message);
    return scene.view.range_auto;
}

/* A range in m/s says nothing of pressures. */
static void a_range_is_of_one_scalar(void **state)
{
    (void)state;
    assert_true(range_is_auto("color_by: speed, range: [0, 2]", "view.color_by=pressure", NULL));
    assert_false(range_is_auto("color_by: speed, range: [0, 2]", "view.color_by=speed", NULL));
    assert_true(range_is_auto("range: [0, 2]", "view.color_by=pressure", NULL));
    assert_false(range_is_auto("range: [0, 2]", "view.color_by=speed", NULL)); /* value without the setting */
    assert_false(range_is_auto("color_by: speed, range: [0, 2]", "view.colormap=plasma", NULL));
    assert_false(
        range_is_auto("color_by: speed, range: [0, 2]", "view.color_by=pressure", "view.range=[0, 9]"));
    assert_true(scene.view.range[1] == 9 && !scene.view.range_symmetric);
    assert_true(range_is_auto("range: symmetric", "view.colormap=plasma", NULL));
    assert_true(scene.view.range_symmetric);
    assert_true(range_is_auto("range: symmetric", "view.range=auto", NULL));
    assert_false(scene.view.range_symmetric);
}

static void later_settings_win(void **state)
{
    (void)state;
    SceneSettings settings = {.count = 3,
                              .set = {"solver.step={dt: 0.1}", "solver.step.dt=0.2", "solver.threads=3"}};
    assert_true(parse_text(LEAST, &settings, &scene, &error));
    assert_true(scene.world.dt == 0.2 && *world_threads(&scene.world) == 3);
}

static void bad_settings_are_named(void **state)
{
    (void)state;
    assert_set_refused("box.size=[1, 1", "not valid YAML");
    assert_set_refused("box.size=", "box.size must be three numbers [x, y, z] in m, not empty");
    assert_set_refused("box.sise=1", "unknown key 'sise'; did you mean 'size'?");
    assert_set_refused("box.size.x=1", "'x' stands in no mapping");
    assert_set_refused("box[0]=1", "[0] follows something that is no list");
    assert_set_refused("nothing", "no setting; write path=value");
    assert_set_refused("=3", "no setting; write path=value");
    assert_set_refused("a..b=3", "a key is missing before a '.'; write it like fluids[0].density");
    assert_set_refused(".a=3", "a key is missing before a '.'");
    assert_set_refused("solver.=3", "the path ends in a '.'; name a key behind it");
    assert_set_refused("fluids[-1].viscosity=1", "the index -1 is less than 0; the first entry "
                                                 "of a list is [0]");
    for (int k = 0; k < 4; k++) {
        char setting[64], reason[128];
        const char *const indices[] = {"", "x", "1.5", "-"};
        snprintf(setting, sizeof setting, "fluids[%s].viscosity=1", indices[k]);
        snprintf(reason, sizeof reason, "'[%s]' is no index; write a whole number from 0 on, like fluids[0]",
                 indices[k]);
        assert_set_refused(setting, reason);
    }
    assert_set_refused("fluids[0=1", "a '[' has no ']' behind it; write an index like fluids[0]");
    assert_set_refused("fluids[0]density=1", "'density' follows an index; write a '.' between them");
    assert_set_refused("fluids[0].=1", "the path ends in a '.'");
    assert_set_refused("fluids[9].viscosity=1", "[9] is beyond the list's end; use at most 1, which appends");
    assert_set_refused("fluids[99999999999].viscosity=1", "[99999999999] is beyond the end of any list");
    assert_set_refused("title=*a", "an alias");
    assert_set_refused("solver.backend=gpu", "solver.backend cannot be 'gpu'; it must be one of: cpu");
}

/* Untouched parts of the scene keep the place in the file. */
static void the_file_keeps_its_places(void **state)
{
    (void)state;
    SceneSettings settings = {.count = 1, .set = {"box.size=[1, 0.4, 1]"}};
    assert_false(parse_text(LEAST, &settings, &scene, &error));
    assert_non_null(strstr(error.message, "scene.yaml:6:50: the fluid is outside the box"));
}

static bool near_count(size_t wanted, double tolerance)
{
    const size_t count = seed_count(&scene.world, scene.world.spacing);
    return fabs((double)count - (double)wanted) <= tolerance * (double)wanted;
}

static void particles_choose_the_spacing_and_scale_the_step(void **state)
{
    (void)state;
    Notes notes;
    SceneSettings settings = {.particles = 4000};
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_true(near_count(4000, 0));
    assert_float_equal(scene.world.spacing, 0.05, 1e-4); /* 20 x 10 x 20: the widest that gives so many */
    assert_float_equal(scene.world.dt, world_def_default().dt * scene.world.spacing / 0.1, 1e-9);
    assert_int_equal(scene.world.substeps, world_def_default().substeps);
    assert_non_null(strstr(notes.line[0],
                           "--particles 4000: a spacing of 0.05 m gives 4000; solver.step.dt goes with it"));

    settings.set[settings.count++] = "solver.step.dt=0.003";
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_true(scene.world.dt == 0.003);
    settings.set[0] = "solver.step.mode=cfl"; /* sound bounds the step */
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_true(scene.world.max_dt == world_def_default().max_dt);
    settings.set[settings.count++] = "solver.method=dfsph";
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_float_equal(scene.world.max_dt, world_def_default().max_dt * sqrt(scene.world.spacing / 0.1),
                       1e-9);
    settings.set[settings.count++] = "solver.step.max_dt=0.004";
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_true(scene.world.max_dt == 0.004);
    assert_string_equal(notes.line[0], "--particles 4000: a spacing of 0.05 m gives 4000");

    settings.set[0] = "solver.step={mode: cfl}"; /* with steps that follow the spacing */
    assert_true(scene_parse("s", LEAST, strlen(LEAST), &settings, &scene, &notes, &error));
    assert_true(scene.world.dt == world_def_default().dt);
    assert_string_equal(notes.line[0], "--particles 4000: a spacing of 0.05 m gives 4000");
}

static void particles_that_cannot_be_are_refused(void **state)
{
    (void)state;
    SceneSettings settings = {.particles = 2000000000};
    assert_false(parse_text(LEAST, &settings, &scene, &error));
    assert_string_equal(error.message, "--particles 2000000000: more than this machine can hold; use fewer");
    settings.particles = 1;
    assert_false(parse_text(LEAST, &settings, &scene, &error));
    assert_string_equal(error.message, "--particles 1: too few to fill this scene; use more");
}

static void steps_have_bounds(void **state)
{
    (void)state;
    static const char *const bad[] = {"mode=rk4",     "number=0",   "number=2.1", "max_dt=0",
                                      "max_dt=100.1", "retries=-1", "retries=11"};
    static const char *const good[] = {"mode=cfl",   "number=0.001", "number=2",  "max_dt=1e-9",
                                       "max_dt=100", "retries=0",    "retries=10"};
    char set[64];
    for (int i = 0; i < 7; i++) {
        snprintf(set, sizeof set, "solver.step.%s", bad[i]);
        assert_false(parse_set(LEAST, set, &scene, &error));
        *strchr(set, '=') = 0;
        assert_non_null(strstr(error.message, set));
        snprintf(set, sizeof set, "solver.step.%s", good[i]);
        if (!parse_set(LEAST, set, &scene, &error))
            fail_msg("%s", error.message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_replace_and_are_added),
        cmocka_unit_test(a_word_stands_for_0),
        cmocka_unit_test(lists_grow_by_one),
        cmocka_unit_test(a_range_is_of_one_scalar),
        cmocka_unit_test(later_settings_win),
        cmocka_unit_test(bad_settings_are_named),
        cmocka_unit_test(the_file_keeps_its_places),
        cmocka_unit_test(particles_choose_the_spacing_and_scale_the_step),
        cmocka_unit_test(particles_that_cannot_be_are_refused),
        cmocka_unit_test(steps_have_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
