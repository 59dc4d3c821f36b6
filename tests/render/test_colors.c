/* Colours follow the scalar, and colormaps have the colours they are known for. */
#include "tests/render/fixture.h"

#include "render/frame/frame.h"

enum { WIDTH = 96, HEIGHT = 72 };

static void test_known_ends(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        uint8_t low[3], high[3];
    } known[] = {{"viridis", {0x44, 0x01, 0x54}, {0xfd, 0xe7, 0x25}},
                 {"inferno", {0, 0, 4}, {0xfc, 0xff, 0xa4}},
                 {"plasma", {0x0d, 0x08, 0x87}, {0xf0, 0xf9, 0x21}},
                 {"coolwarm", {59, 76, 192}, {180, 4, 38}},
                 {"turbo", {0x30, 0x12, 0x3b}, {0x7a, 0x04, 0x03}},
                 {"mako", {0x39, 0x5d, 0x9c}, {0xde, 0xf5, 0xe5}},
                 {"gray", {0, 0, 0}, {255, 255, 255}}};
    uint8_t rgb[3 * COLORMAP_SIZE];
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        assert_true(colormap_fill(known[i].name, rgb));
        assert_memory_equal(rgb, known[i].low, 3);
        assert_memory_equal(rgb + sizeof rgb - 3, known[i].high, 3);
        assert_string_equal(colormap_list[i], known[i].name);
    }
    assert_null(colormap_list[sizeof known / sizeof known[0]]);
    assert_false(colormap_fill("jet", rgb));
}

static void rises_in_lightness(const char *name)
{
    uint8_t rgb[3 * COLORMAP_SIZE];
    double before = -1;
    assert_true(colormap_fill(name, rgb));
    for (int i = 0; i < COLORMAP_SIZE; i += 8) {
        double luma = 0;
        for (int k = 0; k < 3; k++)
            luma += (double[]){0.2126, 0.7152, 0.0722}[k] * pow(rgb[3 * i + k] / 255.0, 2.2);
        assert_true(luma > before);
        before = luma;
    }
}

/* The full range: the purpose of the maps. */
static void test_lightness(void **state)
{
    (void)state;
    rises_in_lightness("viridis");
    rises_in_lightness("mako");
}

/* Automatic choices follow the scalar. */
static void test_auto_goes_with_the_scalar(void **state)
{
    (void)state;
    ViewDef def = view_def_default();
    def.color_by = SCALAR_SPEED;
    assert_string_equal(view_colormap(&def), "mako");
    def.color_by = SCALAR_PRESSURE;
    assert_string_equal(view_colormap(&def), "viridis");
    snprintf(def.colormap, sizeof def.colormap, "turbo");
    assert_string_equal(view_colormap(&def), "turbo");
}

/* The colour in the middle of a picture of one sphere, without light. */
static void center_color(ViewDef *def, double speed, unsigned fluid, uint8_t color[3])
{
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    ParticleBuffers buffers, box = box_state(2, 0.4);
    Particles *particles = calloc(1, sizeof *particles);
    particles_add(particles, 0.8, 0.5, 0, 1.7, 1 - fluid); /* a second, aside */
    particles_add(particles, 0, 0.5, 0, speed, fluid);
    Upload *upload = upload_particles(particles, &box, &buffers);
    const WorldDef world = bare_world();
    Renderer *renderer = renderer_create(def, &world, WIDTH, HEIGHT, &error);
    assert_non_null(renderer);
    renderer_set_plain(renderer, true);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    memcpy(color, &rgb[3 * (WIDTH * (HEIGHT / 2) + WIDTH / 2)], 3);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
}

static void assert_color(const uint8_t color[3], const uint8_t wanted[3])
{
    for (int k = 0; k < 3; k++)
        if (abs(color[k] - wanted[k]) > 2)
            fail_msg("colour %d %d %d instead of %d %d %d", color[0], color[1], color[2], wanted[0],
                     wanted[1], wanted[2]);
}

static void test_scalar_through_colormap(void **state)
{
    (void)state;
    uint8_t map[3 * COLORMAP_SIZE] = {0}, color[3] = {0};
    ViewDef def = bare_view();
    def.range_auto = false;
    def.range[0] = 1, def.range[1] = 3;
    for (int m = 0; colormap_list[m]; m++) {
        text_set(def.colormap, colormap_list[m]);
        assert_true(colormap_fill(def.colormap, map));
        for (int i = 0; i < COLORMAP_SIZE; i += 85) {
            center_color(&def, 1 + 2 * i / 255.0, 0, color);
            assert_color(color, &map[3 * i]);
        }
    }
    center_color(&def, 99, 0, color); /* beyond the range: its end */
    assert_color(color, &map[3 * 255]);
    for (int automatic = 0; automatic < 2; automatic++) {
        static const uint8_t magenta[3] = {255, 0, 203};
        def.range_auto = automatic;
        center_color(&def, NAN, 0, color);
        assert_color(color, magenta);
    }
}

static void test_fluids_own_colors(void **state)
{
    (void)state;
    uint8_t color[3] = {0};
    ViewDef def = bare_view();
    const WorldDef world = bare_world();
    def.color_by = SCALAR_FLUID;
    for (unsigned fluid = 0; fluid < 2; fluid++) {
        uint8_t wanted[3];
        for (int k = 0; k < 3; k++)
            wanted[k] = (uint8_t)(255 * (1.055 * pow(world.fluids[fluid].color[k], 1 / 2.4) - 0.055) + 0.5);
        center_color(&def, 0, fluid, color);
        assert_color(color, wanted);
    }
}

static void test_unknown_names(void **state)
{
    (void)state;
    Error error = {0};
    ViewDef def = bare_view();
    text_set(def.colormap, "jet");
    assert_null(renderer_create(&def, NULL, WIDTH, HEIGHT, &error));
    assert_non_null(strstr(error.message, "jet"));
    def = bare_view();
    text_set(def.kind, "cubes");
    assert_null(renderer_create(&def, NULL, WIDTH, HEIGHT, &error));
    assert_non_null(strstr(error.message, "spheres"));
    def = bare_view();
    assert_null(renderer_create(&def, NULL, 0, HEIGHT, &error));
    assert_non_null(strstr(error.message, "0 x 72"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_ends),
        cmocka_unit_test(test_lightness),
        cmocka_unit_test(test_auto_goes_with_the_scalar),
        cmocka_unit_test_teardown(test_scalar_through_colormap, no_gl_errors),
        cmocka_unit_test_teardown(test_fluids_own_colors, no_gl_errors),
        cmocka_unit_test_teardown(test_unknown_names, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
