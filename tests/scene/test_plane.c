/* Scenes of two dimensions: vectors of two numbers, and what may not leave the plane. */
#include "sim/start/start.h"
#include "tests/scene/scene_text.h"

static const char flat[] =
    "box: {size: [2, 1]}\n"
    "gravity: [0.5, -9]\n"
    "particles: {spacing: 0.05}\n"
    "fluids:\n"
    "  - velocity: [1, 0]\n"
    "    fill: [{block: {min: [-1, 0], max: [0, 0.5]}}, {ball: {centre: [0.5, 0.5], radius: 0.2}}]\n"
    "motion: [{shake: {axis: [1, 0], amplitude: 0.1, frequency: 1}}]\n";

static Scene scene;
static Error error;

static bool parse(const char *text, SceneSettings *settings)
{
    return scene_parse("a.yaml", text, strlen(text), settings, &scene, NULL, &error);
}

static void two_numbers_make_a_plane(void **state)
{
    (void)state;
    if (!parse(flat, NULL))
        fail_msg("%s", error.message);
    assert_int_equal(scene.world.dimensions, 2);
    assert_true(scene.world.gravity[0] == 0.5 && scene.world.gravity[1] == -9 && scene.world.gravity[2] == 0);
    assert_true(scene.world.box_size[2] == 0.05);
    assert_true(seed_count(&scene.world, 0.05) == 20 * 10 + 52);
    SceneSettings settings = {.particles = 1000};
    assert_true(parse(flat, &settings));
    const size_t count = seed_count(&scene.world, scene.world.spacing);
    assert_true(count > 980 && count < 1020);
    assert_true(scene.world.box_size[2] == scene.world.spacing);
}

static void refuse(const char *setting, const char *reason)
{
    SceneSettings settings = {.count = 1, .set = {setting}};
    if (parse(flat, &settings))
        fail_msg("%s was taken", setting);
    if (!strstr(error.message, reason))
        fail_msg("%s: expected '%s' in '%s'", setting, reason, error.message);
}

static void what_leaves_the_plane_is_refused(void **state)
{
    (void)state;
    refuse("gravity=[0, 0, 1]", "the third number must be 0, or left out, in a 2D scene, not 1");
    refuse("fluids[0].velocity=[0, 0, 1]", "the third number must be 0");
    refuse("fluids[0].fill[0].block.min=[-1, 0, -0.1]", "the third number must be 0");
    refuse("fluids[0].fill[1].ball.centre=[0, 0.5, 0.1]", "the third number must be 0");
    refuse("motion[0].shake.axis=[1, 0, 1]", "the motion leaves the plane of a 2D scene");
    refuse("motion=[{rock: {axis: [1, 0, 0], angle: 3, frequency: 1}}]", "the motion leaves the plane");
    refuse("fluids[0].fill[0].block.max=[0, 1.5]", "the fluid is outside the box");
    refuse("fluids[0].fill[1]={cylinder: {centre: [0.5, 0.5], radius: 0.1, height: 0.1}}",
           "a 2D scene has no cylinders; write a ball, which is a disc there");
    refuse("particles.spacing=0.6", "too large for the box");
    refuse("gravity=[0]", "two numbers [x, y], or three");
}

static void three_stay_three(void **state)
{
    (void)state;
    static const char deep[] = "box: {size: [1, 1, 1]}\n"
                               "particles: {spacing: 0.1}\n"
                               "gravity: [0, -9]\n"
                               "fluids: [{fill: [{block: {min: [0, 0, 0], max: [0.5, 0.5, 0.5]}}]}]\n";
    assert_false(parse(deep, NULL));
    assert_non_null(strstr(error.message, "a.yaml:3:10: gravity must be three numbers [x, y, z]"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_numbers_make_a_plane),
        cmocka_unit_test(what_leaves_the_plane_is_refused),
        cmocka_unit_test(three_stay_three),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
