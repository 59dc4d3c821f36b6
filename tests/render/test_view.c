/* A view that is no part of the program: tests/render/toy_view.h. */
#include "tests/render/fixture.h"

#include "app/scene/scene.h"
#include "tests/render/toy_view.h"
#include "tests/scene/scene_text.h"

enum { SIZE = 32 };

static int middle_of(Renderer *renderer, const ParticleBuffers *buffers)
{
    static uint8_t rgb[3 * SIZE * SIZE];
    renderer_draw(renderer, buffers, NULL);
    renderer_read(renderer, rgb);
    return rgb[3 * (SIZE / 2 * SIZE + SIZE / 2)];
}

static void it_draws_by_its_own_settings(void **state)
{
    (void)state;
    Error error = {0};
    ParticleBuffers buffers;
    ViewDef def = bare_view();
    Particles *particles = particles_wave(0.1);
    const ParticleBuffers box = box_state(particles->count, 0.1);
    Upload *upload = upload_particles(particles, &box, &buffers);
    text_set(def.kind, "toy");
    assert_true(toy_def(&def)->shade == 0.5);
    Renderer *renderer = renderer_create(&def, NULL, SIZE, SIZE, &error);
    assert_non_null(renderer);
    assert_in_range(middle_of(renderer, &buffers), 187, 189); /* sRGB of 0.5 */
    toy_def(&def)->shade = 1;
    assert_true(renderer_set_def(renderer, &def, NULL, &error));
    assert_int_equal(middle_of(renderer, &buffers), 255);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
}

static void scenes_have_its_key(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {0};
    bool of_world = true;
    if (!parse_text(LEAST "view: {kind: toy, toy: {shade: 0.25}}\n", NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_true(toy_def(&scene.view)->shade == 0.25);
    assert_refused(LEAST "view: {toy: {shade: 2}}\n", "scene.yaml:7:21: view.toy.shade");
    assert_true(scene_set_live(&scene, "view.toy.shade=0.75", &of_world, &error) && !of_world);
    char *text = scene_print_text(&scene);
    assert_non_null(strstr(text, "view.kind = toy"));
    assert_non_null(strstr(text, "view.toy.shade = 0.75"));
    free(text);
}

static void it_is_listed_behind_the_others(void **state)
{
    (void)state;
    static Scene scene;
    static Notes notes;
    Error error = {0};
    const char *name = "", *text = LEAST "view: {toy: {shade: 0.25}}\n";
    const Key *kind = scene_key_find("view.kind");
    for (int i = 0; key_choice(kind, i) && strcmp(key_choice(kind, i), "none") != 0; i++)
        name = key_choice(kind, i);
    assert_string_equal(name, "toy");
    assert_true(scene_parse("scene.yaml", text, strlen(text), NULL, &scene, &notes, &error));
    assert_string_equal(scene.view.kind, view_list[0]->name);
    assert_int_equal(scene_key_find("view.toy.shade")->flags & (KEY_LIVE | KEY_IDLE), KEY_LIVE | KEY_IDLE);
}

static Scalar shown_by(const char *view)
{
    static Scene scene;
    Error error = {0};
    char text[512];
    snprintf(text, sizeof text, "%sview: {%s}\n", LEAST, view);
    if (!parse_text(text, NULL, &scene, &error))
        fail_msg("%s", error.message);
    return view_color_by(&scene.view);
}

static void clear_fluid_has_its_own_colour_unless_a_scalar_is_asked_for(void **state)
{
    (void)state;
    assert_int_equal(shown_by("kind: spheres"), SCALAR_SPEED);
    assert_int_equal(shown_by("kind: none"), SCALAR_SPEED);
    assert_int_equal(shown_by("kind: volume"), SCALAR_SPEED);
    assert_int_equal(shown_by("kind: splat"), SCALAR_SPEED);
    assert_int_equal(shown_by("kind: splat, volume: {look: water}"), SCALAR_SPEED);
    assert_int_equal(shown_by("kind: volume, volume: {look: water}"), SCALAR_FLUID);
    assert_int_equal(shown_by("kind: splat, splat: {shading: water}"), SCALAR_FLUID);
    assert_int_equal(shown_by("kind: splat, splat: {shading: jelly}"), SCALAR_FLUID);
    assert_int_equal(shown_by("kind: splat, splat: {shading: jelly}, color_by: auto"), SCALAR_FLUID);
    assert_int_equal(shown_by("kind: splat, splat: {shading: jelly}, color_by: speed"), SCALAR_SPEED);
}

static void a_view_follows_what_auto_stands_for(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {0};
    bool of_world;
    if (!parse_text(LEAST "view: {kind: volume, range: [0, 3]}\n", NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_int_equal(view_def_ranges(&scene.view), 0);
    assert_true(scene_set_live(&scene, "view.range=auto", &of_world, &error));
    assert_int_equal(view_def_ranges(&scene.view), 1U << SCALAR_SPEED);
    assert_true(scene_set_live(&scene, "view.volume.look=water", &of_world, &error) && !of_world);
    assert_int_equal(view_color_by(&scene.view), SCALAR_FLUID);
    assert_int_equal(view_def_ranges(&scene.view), 0);
    assert_true(scene_set_live(&scene, "view.range=[0, 3]", &of_world, &error));
    assert_true(scene_set_live(&scene, "view.color_by=speed", &of_world, &error));
    assert_false(scene.view.range_auto); /* a range beside auto is of the speed */
    assert_true(scene_set_live(&scene, "view.color_by=density", &of_world, &error));
    assert_true(scene.view.range_auto);
}

int main(void)
{
    toy_view_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(it_draws_by_its_own_settings, no_gl_errors),
        cmocka_unit_test(scenes_have_its_key),
        cmocka_unit_test(clear_fluid_has_its_own_colour_unless_a_scalar_is_asked_for),
        cmocka_unit_test(a_view_follows_what_auto_stands_for),
        cmocka_unit_test(it_is_listed_behind_the_others),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
