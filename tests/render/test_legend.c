/* The legend's numbers, and the automatic camera that leaves room around the box. */
#include "tests/render/fixture.h"

#include "render/frame/frame.h"
#include "render/frame/passes.h"

static void test_round_ticks(void **state)
{
    (void)state;
    static const double ranges[][2] = {{0, 1},        {0.03, 2.91}, {-2, 3}, {995, 1042},
                                       {-1e-4, 3e-4}, {0, 12345},   {7, 8.3}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        double ticks[7];
        int decimals, count = legend_ticks(ranges[i][0], ranges[i][1], 7, ticks, &decimals);
        assert_true(count >= 3 && count <= 7);
        double step = ticks[1] - ticks[0];
        for (int k = 0; k < count; k++) {
            char label[32];
            assert_true(ticks[k] >= ranges[i][0] - 1e-6 * step && ticks[k] <= ranges[i][1] + 1e-6 * step);
            assert_true(k == 0 || fabs(ticks[k] - ticks[k - 1] - step) < 1e-9 * fabs(step) + 1e-12);
            snprintf(label, sizeof label, "%.*f", decimals, ticks[k]); /* what is written is the place */
            assert_true(fabs(strtod(label, NULL) - ticks[k]) < 1e-6 * step);
        }
    }
}

static void test_units_as_people_write_them(void **state)
{
    (void)state;
    char out[32];
    legend_unit("kg/m3", out);
    assert_string_equal(out, "kg/m\u00b3");
    legend_unit("m/s2", out);
    assert_string_equal(out, "m/s\u00b2");
    legend_unit("m/s", out);
    assert_string_equal(out, "m/s");
    legend_unit("", out);
    assert_string_equal(out, "");
}

/* Every corner of the box is in the picture, whatever the shapes of box and picture. */
static void test_camera_shows_the_box(void **state)
{
    (void)state;
    static const double sizes[][3] = {{1, 1, 1}, {4, 0.5, 0.5}, {0.2, 3, 0.2}, {1, 0.1, 5}};
    static const int pictures[][2] = {{1280, 720}, {512, 512}, {300, 900}};
    BoxState box = {.orientation = {0, 0, 0, 1}};
    ViewDef def = view_def_default();
    for (int s = 0; s < 4; s++)
        for (int p = 0; p < 3; p++) {
            int width = pictures[p][0], height = pictures[p][1];
            double largest = 0;
            Camera camera;
            camera_make(&def, sizes[s], &box, (double)width / height, (CoveredParts){0}, &camera);
            for (int corner = 0; corner < 8; corner++) {
                double world[3] = {sizes[s][0] * ((corner & 1) - 0.5), sizes[s][1] * (corner >> 1 & 1),
                                   sizes[s][2] * ((corner >> 2) - 0.5)};
                double pixel[2], depth;
                assert_true(camera_project(&camera, world, width, height, pixel, &depth));
                double aside = fmax(fabs(2 * pixel[0] / width - 1), fabs(2 * pixel[1] / height - 1));
                assert_true(aside < 0.87 && depth > 0 && depth < 1);
                largest = fmax(largest, aside);
            }
            assert_true(largest > 0.6); /* and fills the room */
        }
}

/* The box's part of the picture's width; no corner of the box is in the covered corner. */
static double width_beside(CoveredParts covered, double *rightmost)
{
    const double size[3] = {2, 1, 1};
    const BoxState box = {.orientation = {0, 0, 0, 1}};
    const ViewDef def = view_def_default();
    double leftmost = 100;
    Camera camera;
    *rightmost = 0;
    camera_make(&def, size, &box, 1, covered, &camera);
    for (int corner = 0; corner < 8; corner++) {
        const double world[3] = {(corner & 1) * 2 - 1, corner >> 1 & 1, (corner >> 2) - 0.5};
        double pixel[2], depth;
        assert_true(camera_project(&camera, world, 100, 100, pixel, &depth));
        assert_true(pixel[0] > 3 && pixel[0] < 97 && pixel[1] > 3 && pixel[1] < 97);
        assert_false(pixel[0] > 100 * (1 - covered.right) && pixel[1] < 100 * covered.top);
        leftmost = fmin(leftmost, pixel[0]);
        *rightmost = fmax(*rightmost, pixel[0]);
    }
    return (*rightmost - leftmost) / 100;
}

/* A legend hides no corner of the box, and makes the box smaller only where a corner would be hidden. */
static void test_camera_leaves_room_for_the_legend(void **state)
{
    (void)state;
    double right, whole = width_beside((CoveredParts){0}, &right);
    assert_true(whole > 0.8);
    assert_true(fabs(width_beside((CoveredParts){0, 0.3, 0.05}, &right) - whole) < 1e-3);
    const double corner = width_beside((CoveredParts){0, 0.3, 0.4}, &right);
    assert_true(right > 72 && corner < whole);
    const double side = width_beside((CoveredParts){0, 0.3, 1}, &right);
    assert_true(right < 70 && right > 60 && side < corner - 0.05);
}

/* The same for the fluids and for scalars: from view to view the box stands still. */
static void test_one_room_for_all_views(void **state)
{
    (void)state;
    ViewDef def = view_def_default();
    WorldDef world = {.fluid_count = 1};
    text_set(world.fluids[0].name, "water");
    for (int fluids = 1; fluids <= FLUIDS_MAX; fluids += FLUIDS_MAX - 1) {
        world.fluid_count = fluids;
        def.color_by = SCALAR_FLUID;
        const CoveredParts of_fluids = legend_room(&def, &world, 1280, 720);
        assert_true(of_fluids.right * 1280 >= legend_width_pixels(&def, &world, 720));
        def.color_by = SCALAR_SPEED;
        const CoveredParts of_speed = legend_room(&def, &world, 1280, 720);
        assert_true(of_fluids.right == of_speed.right && of_fluids.top == of_speed.top);
        assert_true(of_speed.right * 1280 >= legend_width_pixels(&def, &world, 720) && of_speed.top > 0.3);
    }
    def.legend = false;
    assert_true(legend_room(&def, &world, 1280, 720).right == 0);
}

/* In a thumbnail too, the box is more than two fifths as wide as the picture. */
static void test_small_pictures_show_the_box(void **state)
{
    (void)state;
    double right;
    const ViewDef def = view_def_default();
    const WorldDef world = {.fluid_count = 0};
    for (int width = 120; width <= 320; width += 40)
        assert_true(width_beside(legend_room(&def, &world, width, width * 3 / 4), &right) > 0.4);
}

static double fluid_legend(const char *name, double blue, double viscosity)
{
    ViewDef def = view_def_default();
    WorldDef world = {.fluid_count = 1};
    def.color_by = SCALAR_FLUID;
    text_set(world.fluids[0].name, name);
    world.fluids[0].color[2] = (float)blue;
    world.fluids[0].viscosity = viscosity;
    return legend_width_pixels(&def, &world, 720);
}

/* Water as viscous as honey is noted, by name or colour; different fluids, and true water, have no note. */
static void test_legend_tells_what_is_no_water(void **state)
{
    (void)state;
    assert_true(fluid_legend("water", 0, 5) > fluid_legend("water", 0, 1e-3) + 20);
    assert_true(fluid_legend("fluid", 0.6, 5) > fluid_legend("fluid", 0.6, 2e-3) + 20);
    assert_true(fluid_legend("honey", 0, 5) == fluid_legend("honey", 0, 1e-3));
    assert_true(fluid_legend("water", 0, 0) == fluid_legend("water", 0, 1e-3)); /* without friction */
}

/* Nor beside a panel on the left, with and without a legend. */
static void test_camera_leaves_room_for_a_panel(void **state)
{
    (void)state;
    double size[3] = {2, 1, 1};
    BoxState box = {.orientation = {0, 0, 0, 1}};
    ViewDef def = view_def_default();
    for (int legend = 0; legend <= 1; legend++) {
        Camera camera;
        double leftmost = 100, rightmost = 0;
        camera_make(&def, size, &box, 1.5, (CoveredParts){0.3, 0.2 * legend, 1}, &camera);
        for (int corner = 0; corner < 8; corner++) {
            double world[3] = {(corner & 1) * 2 - 1, corner >> 1 & 1, (corner >> 2) - 0.5}, pixel[2], depth;
            assert_true(camera_project(&camera, world, 100, 100, pixel, &depth));
            leftmost = fmin(leftmost, pixel[0]);
            rightmost = fmax(rightmost, pixel[0]);
        }
        assert_true(leftmost > 30 && leftmost < 45 && rightmost < 100 - 20 * legend && rightmost > 70);
    }
}

/* A shaken box moves in the picture; a departing box is followed. */
static void test_camera_follows_late(void **state)
{
    (void)state;
    double size[3] = {1, 1, 1};
    ViewDef def = view_def_default();
    Camera rest, shaken, gone;
    camera_make(&def, size, &(BoxState){.orientation = {0, 0, 0, 1}}, 1, (CoveredParts){0}, &rest);
    camera_make(&def, size, &(BoxState){.position = {0.3, 0, 0}, .orientation = {0, 0, 0, 1}}, 1,
                (CoveredParts){0}, &shaken);
    camera_make(&def, size, &(BoxState){.position = {9.5, 0, 0}, .orientation = {0, 0, 0, 1}}, 1,
                (CoveredParts){0}, &gone);
    assert_true(fabsf(shaken.eye[0] - rest.eye[0]) < 1e-6F);
    assert_true(fabsf(gone.eye[0] - rest.eye[0] - 9) < 1e-4F);
}

/* At the smallest and a large size, the legend is there: ink in its corner. */
static void test_legend_is_drawn(void **state)
{
    (void)state;
    static const int sizes[][2] = {{512, 512}, {1920, 1080}};
    Error error = {0};
    ParticleBuffers none = box_state(0, 0.1);
    for (int i = 0; i < 2; i++) {
        int width = sizes[i][0], height = sizes[i][1], dark = 0, em = (int)legend_text_pixels(height);
        ViewDef def = view_def_default();
        def.box = false;
        def.range_auto = false;
        def.range[1] = 1;
        none.scalar[SCALAR_SPEED].buffer = 1; /* only a check for presence: no drawing */
        uint8_t *rgb = malloc(3 * (size_t)width * (size_t)height);
        Renderer *renderer = renderer_create(&def, NULL, width, height, &error);
        assert_non_null(renderer);
        renderer_draw(renderer, &none, NULL);
        renderer_read(renderer, rgb);
        for (int y = em; y < 3 * em; y++) /* the title's line */
            for (int x = width - 9 * em; x < width - em; x++)
                dark += rgb[3 * (y * width + x)] < 100;
        assert_true(dark > em * em / 3);
        renderer_destroy(renderer);
        free(rgb);
    }
}

/* The number of pixels with the ink of gravity. `middle`: the mean x of the arrow's pixels. */
static int gravity_ink(const double gravity[3], const double orientation[4], double *middle)
{
    enum { LONG = 640, HIGH = 360, WORD = LONG - 52 };
    static uint8_t rgb[2][3 * LONG * HIGH];
    Error error = {0};
    ViewDef def = bare_view();
    int written = 0, arrow = 0;
    def.legend = true, def.camera_auto = false;
    def.camera = (CameraDef){{0, 1, 3}, {0, 1, 0}, 36};
    Renderer *renderer = renderer_create(&def, NULL, LONG, HIGH, &error);
    assert_non_null(renderer);
    for (int k = 0; k < 2; k++) {
        ParticleBuffers none = box_state(0, 0.1);
        memcpy(none.box.orientation, orientation, sizeof none.box.orientation);
        if (k)
            memcpy(none.gravity, gravity, sizeof none.gravity);
        renderer_draw(renderer, &none, NULL);
        renderer_read(renderer, rgb[k]);
    }
    *middle = 0;
    for (int i = 0; i < LONG * HIGH; i++)
        if (memcmp(&rgb[0][3 * i], &rgb[1][3 * i], 3) != 0) {
            written++;
            if (i % LONG < WORD)
                *middle += i % LONG, arrow++;
        }
    *middle /= arrow ? arrow : 1;
    renderer_destroy(renderer);
    return written;
}

/* An arrow where gravity is not towards the floor, whatever the box's pose. */
static void test_gravity_has_an_arrow(void **state)
{
    (void)state;
    static const double upright[4] = {0, 0, 0, 1}, turned[4] = {0, 0, 0.70710678, 0.70710678};
    static const double down[3] = {0, -9.81, 0}, right[3] = {9.81, 0, 0}, left[3] = {-9.81, 0, 0};
    double middle, to_right, to_left;
    assert_int_equal(gravity_ink(down, upright, &middle), 0);
    assert_int_equal(gravity_ink(left, turned, &middle), 0);
    assert_true(gravity_ink(right, upright, &to_right) > 100);
    assert_true(gravity_ink(left, upright, &to_left) > 100);
    printf("the arrow's middle %.3g and %.3g\n", to_right, to_left);
    assert_true(to_right > to_left + 1);
    assert_true(gravity_ink(down, turned, &middle) > 100 && fabs(middle - to_right) < 0.5);
}

/* The whole legend, lines of curves included, is in the room for legends. */
static void test_legend_stays_in_its_room(void **state)
{
    (void)state;
    enum { LONG = 640, HIGH = 360 };
    static uint8_t rgb[2][3 * LONG * HIGH];
    Error error = {0};
    ParticleBuffers none = box_state(0, 0.1);
    none.scalar[SCALAR_SPEED].buffer = 1; /* only a check for presence: no drawing */
    const WorldDef world = bare_world();
    CoveredParts room = {0};
    for (int legend = 0; legend < 2; legend++) {
        ViewDef def = bare_view();
        def.legend = legend == 1;
        text_set(def.kind, "spheres");
        def.color_by = SCALAR_SPEED;
        def.opacity.by = 1 + SCALAR_PRESSURE, def.size.by = 1 + SCALAR_SPEED;
        def.opacity.range[1] = 12345.6, def.size.range[1] = 0.0123456;
        def.opacity.range_auto = def.size.range_auto = false;
        def.camera_auto = false; /* the same sky */
        if (legend)
            room = legend_room(&def, &world, LONG, HIGH);
        Renderer *renderer = renderer_create(&def, &world, LONG, HIGH, &error);
        assert_non_null(renderer);
        renderer_draw(renderer, &none, NULL);
        renderer_read(renderer, rgb[legend]);
        renderer_destroy(renderer);
    }
    int written = 0;
    for (int i = 0; i < LONG * HIGH; i++) {
        const int x = i % LONG, y = i / LONG;
        const bool time = y > HIGH - 40 && x < 80;
        const bool inside = x >= LONG * (1 - room.right) && y < HIGH * room.top;
        const bool same = memcmp(&rgb[0][3 * i], &rgb[1][3 * i], 3) == 0;
        assert_true(same || inside || time);
        written += !same && y > (1 + 15.5) * legend_text_pixels(HIGH);
    }
    assert_true(written > 400 && room.top < 0.9);
}

/* A fluid's colour in the legend equals the particles' colour: linear light converted for a screen. */
static void test_fluids_have_their_colors(void **state)
{
    (void)state;
    enum { SIZE = 512 };
    static const float color[3] = {0.2F, 0.5F, 0.05F};
    static uint8_t rgb[3 * SIZE * SIZE];
    Error error = {0};
    const int em = (int)legend_text_pixels(SIZE);
    const ParticleBuffers none = box_state(0, 0.1);
    ViewDef def = view_def_default();
    WorldDef world = {.fluid_count = 1};
    int found = 0;
    def.color_by = SCALAR_FLUID;
    text_set(world.fluids[0].name, "fluid");
    memcpy(world.fluids[0].color, color, sizeof color);
    Renderer *renderer = renderer_create(&def, &world, SIZE, SIZE, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &none, NULL);
    renderer_read(renderer, rgb);
    for (int i = 0; i < SIZE * SIZE; i++) {
        bool same = true;
        for (int k = 0; k < 3; k++)
            same &= fabs(255 * (1.055 * pow((double)color[k], 1 / 2.4) - 0.055) - rgb[3 * i + k]) < 2;
        found += same;
    }
    assert_in_range(found, em * em / 2, em * em); /* a dot */
    renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_ticks),
        cmocka_unit_test(test_units_as_people_write_them),
        cmocka_unit_test(test_camera_shows_the_box),
        cmocka_unit_test(test_camera_leaves_room_for_the_legend),
        cmocka_unit_test(test_small_pictures_show_the_box),
        cmocka_unit_test(test_one_room_for_all_views),
        cmocka_unit_test(test_legend_tells_what_is_no_water),
        cmocka_unit_test(test_camera_leaves_room_for_a_panel),
        cmocka_unit_test(test_camera_follows_late),
        cmocka_unit_test_teardown(test_gravity_has_an_arrow, no_gl_errors),
        cmocka_unit_test_teardown(test_legend_is_drawn, no_gl_errors),
        cmocka_unit_test_teardown(test_legend_stays_in_its_room, no_gl_errors),
        cmocka_unit_test_teardown(test_fluids_have_their_colors, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
