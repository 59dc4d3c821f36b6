/* The view splat in a whole picture: solids, shadows, colours, settings changed while drawing. */
#include "tests/render/solids_fixture.h"

#include "render/frame/frame.h"

static SolidsScene splat_among_solids(void)
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "splat");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera = (CameraDef){{0, 0.5, 3}, {0, 0.5, 0}, 30};
    scene.state.spacing = 0.3;                /* m: the radius of a drop */
    splat_def(&scene.def)->antialias = false; /* pixels are counted */
    return scene;
}

static const uint8_t *pixel_of(const uint8_t *rgb, int x, int y)
{
    return &rgb[3 * (y * WIDTH + x)];
}

/* A ball in front hides the drop, a ball behind is hidden; at the contact the nearer surface is seen. */
static void solids_hide_and_are_hidden(void **state)
{
    (void)state;
    static const double places[] = {0.8, -0.8, 0.2};
    for (int i = 0; i < 3; i++) {
        static uint8_t rgb[3 * PIXELS];
        static float depth[PIXELS], alone[PIXELS];
        SolidsScene scene = splat_among_solids();
        particles_add(scene.particles, 0, 0.5, 0, 1, 0);
        draw_depth(&scene, alone);
        scene_add(&scene, SOLID_SPHERE, 0, 0.5, places[i])->density = 500; /* whole beyond the box too */
        draw_rgb(&scene, true, rgb);
        draw_depth(&scene, depth);
        const uint8_t *middle = pixel_of(rgb, WIDTH / 2, HEIGHT / 2);
        const bool solid = middle[0] > 150 && middle[2] < 100;
        assert_int_equal(solid, i != 1); /* the ball is red, the drop blue */
        for (int k = 0; k < PIXELS; k++)
            assert_true(depth[k] >= alone[k]);
        free(scene.particles);
    }
}

static double brightness(const uint8_t *rgb, int x, int y)
{
    const uint8_t *p = pixel_of(rgb, x, y);
    return p[0] + p[1] + p[2];
}

/* The pixel, from the top, of a place in the world. */
static void pixel_at(const SolidsScene *scene, const double at[3], int pixel[2])
{
    Camera camera;
    double place[2], depth;
    camera_make(&scene->def, scene->state.box_size, &scene->state.box, (double)WIDTH / HEIGHT,
                (CoveredParts){0}, &camera);
    assert_true(camera_project(&camera, at, WIDTH, HEIGHT, place, &depth));
    pixel[0] = (int)place[0], pixel[1] = (int)place[1];
}

/* The light comes from the direction (-0.40, 0.84, 0.3666), render/frame/frame.c; the floor is 0.045
   diagonals below the box. */
static void its_shadow_falls_on_the_floor(void **state)
{
    (void)state;
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    SolidsScene scene = splat_among_solids();
    scene.def.floor = true;
    scene.def.camera = (CameraDef){{0, 2.5, 4}, {0, 0, 0}, 40};
    particles_add(scene.particles, 0, 0.5, 0, 1, 0);
    draw_rgb(&scene, false, with);
    scene.particles->position[1] = -100;
    draw_rgb(&scene, false, without);
    const double floor = -0.045 * sqrt(6), drop = (0.5 - floor) / 0.84;
    const double shaded[3] = {0.40 * drop, floor, -0.3666 * drop}, lit[3] = {-0.40 * drop - 0.3, floor, 0.8};
    int at[2], beside[2];
    pixel_at(&scene, shaded, at);
    pixel_at(&scene, lit, beside);
    assert_true(brightness(with, at[0], at[1]) < 0.85 * brightness(without, at[0], at[1]));
    assert_true(fabs(brightness(with, beside[0], beside[1]) - brightness(without, beside[0], beside[1])) < 6);
    free(scene.particles);
}

/* A layer of drops on the ground, seen from above; `shade` at 0.5 m above it puts its shadow where the
   light's direction says, and nowhere else. */
static void compare_shadow(bool solid)
{
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    SolidsScene scene = splat_among_solids();
    scene.def.camera = (CameraDef){{0.3, 3.5, 0.5}, {0.2, 0, -0.1}, 40};
    scene.state.spacing = 0.1;
    for (int i = 0; i < 30 * 20; i++)
        particles_add(scene.particles, -1.1 + 0.075 * (i % 30), 0, -0.7 + 0.075 * (i / 30), 1, 0);
    draw_rgb(&scene, false, without);
    if (solid)
        scene_add(&scene, SOLID_SPHERE, -0.2, 0.5, 0.2)->radius = 0.15;
    else
        particles_add(scene.particles, -0.2, 0.5, 0.2, 1, 0);
    draw_rgb(&scene, false, with);
    const double drop = (0.5 - 0.1) / 0.84, shaded[3] = {-0.2 + 0.40 * drop, 0.1, 0.2 - 0.3666 * drop};
    static const double lit[3][3] = {{-0.8, 0.1, 0.5}, {0.8, 0.1, -0.4}, {-0.4, 0.1, -0.4}};
    int at[2];
    pixel_at(&scene, shaded, at);
    if (brightness(with, at[0], at[1]) > 0.85 * brightness(without, at[0], at[1]))
        fail_msg("in the shadow of a %s: %g, without %g", solid ? "solid" : "drop",
                 brightness(with, at[0], at[1]), brightness(without, at[0], at[1]));
    for (int i = 0; i < 3; i++) {
        pixel_at(&scene, lit[i], at);
        assert_true(fabs(brightness(with, at[0], at[1]) - brightness(without, at[0], at[1])) < 6);
    }
    free(scene.particles);
}

static void solids_and_drops_shade_the_fluid(void **state)
{
    (void)state;
    compare_shadow(true);
    compare_shadow(false);
}

/* Through clear fluid a solid behind is seen, refracted; a solid in front hides the fluid, without a
   second image inside. */
static void solids_through_clear_fluid(void **state)
{
    (void)state;
    static uint8_t rgb[3 * PIXELS];
    for (int behind = 0; behind < 2; behind++) {
        SolidsScene scene = splat_among_solids();
        int red = 0;
        splat_def(&scene.def)->shading = SPLAT_WATER;
        for (int k = 0; k < 3; k++)
            scene.world.fluids[0].color[k] = 1;
        scene.state.spacing = 0.1;
        for (int i = 0; i < 8 * 8 * 8; i++)
            particles_add(scene.particles, -0.28 + 0.08 * (i % 8), 0.22 + 0.08 * (i / 8 % 8),
                          -0.28 + 0.08 * (i / 64), 1, 0);
        SolidDef *ball = scene_add(&scene, SOLID_SPHERE, 0.1, 0.5, behind ? -0.6 : 0.6);
        ball->radius = 0.1, ball->density = 500; /* whole beyond the box too */
        draw_rgb(&scene, true, rgb);
        for (int i = 0; i < PIXELS; i++)
            red += rgb[3 * i] > 120 && rgb[3 * i + 1] < 100;
        const double depth = behind ? 3.6 : 2.4, radius = 0.1 / depth * HEIGHT / (2 * tan(M_PI / 12));
        const double area = M_PI * radius * radius;
        if (behind ? red < 0.5 * area || red > 2.5 * area : fabs(red - area) > 0.1 * area)
            fail_msg("%s: %d red pixels; the ball has %g", behind ? "behind" : "before", red, area);
        free(scene.particles);
    }
}

/* The floor's lost light, summed, matches the silhouette: 0.62^2 of a sphere of a spacing. The drop is
   outside the picture. */
static void a_drops_shadow_is_its_own(void **state)
{
    (void)state;
    static uint8_t rgb[3][3 * PIXELS];
    double lost[2] = {0};
    SolidsScene scene = splat_among_solids();
    scene.def.floor = true;
    scene.def.camera = (CameraDef){{2.2, 0.6, -0.27}, {0.29, -0.11, -0.27}, 16};
    particles_add(scene.particles, 0, 0.5, 0, 1, 0);
    for (int i = 0; i < 3; i++) {
        splat_def(&scene.def)->drops = i == 1;
        scene.particles->position[1] = i == 2 ? -100 : 0.5F;
        draw_rgb(&scene, false, rgb[i]);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3 * PIXELS; k++)
            lost[i] += rgb[2][k] - rgb[i][k];
    if (!(lost[0] > 1000 && fabs(lost[1] / lost[0] - 0.385) < 0.06))
        fail_msg("a sphere takes %g of light, its drop %g", lost[0], lost[1]);
    free(scene.particles);
}

/* The surface is independent of shading, with any further settings: passes do not disturb each other. */
static void shading_leaves_the_surface_alone(void **state)
{
    (void)state;
    static float opaque[PIXELS], clear[PIXELS];
    for (int i = 0; i < 4; i++) {
        SolidsScene scene = splat_among_solids();
        scene.state.spacing = 0.1;
        for (int k = 0; k < 8 * 8 * 8; k++)
            particles_add(scene.particles, -0.28 + 0.08 * (k % 8), 0.22 + 0.08 * (k / 8 % 8),
                          -0.28 + 0.08 * (k / 64), 1, 0);
        splat_def(&scene.def)->filter = i & 1 ? SPLAT_NARROW_RANGE : 0;
        splat_def(&scene.def)->level = i & 2 ? 0.2 : 0;
        splat_def(&scene.def)->antialias = true;
        draw_depth(&scene, opaque);
        splat_def(&scene.def)->shading = SPLAT_WATER;
        draw_depth(&scene, clear);
        assert_memory_equal(opaque, clear, sizeof opaque);
        free(scene.particles);
    }
}

/* Along a line through overlapping drops of two fluids the colour changes by small steps. */
static void colours_mix_where_fluids_meet(void **state)
{
    (void)state;
    static uint8_t rgb[3 * PIXELS];
    SolidsScene scene = splat_among_solids();
    particles_add(scene.particles, -0.15, 0.5, 0, 1, 0);
    particles_add(scene.particles, 0.15, 0.5, 0, 1, 1);
    draw_rgb(&scene, true, rgb);
    int mixed = 0, greatest = 0;
    for (int x = WIDTH / 2 - 20; x < WIDTH / 2 + 20; x++) {
        const int here = pixel_of(rgb, x, HEIGHT / 2)[0], next = pixel_of(rgb, x + 1, HEIGHT / 2)[0];
        mixed += here > 90 && here < 210; /* the fluids' reds are 48 and 237 */
        greatest = abs(next - here) > greatest ? abs(next - here) : greatest;
    }
    if (mixed < 5 || greatest > 40)
        fail_msg("%d pixels between the colours, steps up to %d of 255", mixed, greatest);
    free(scene.particles);
}

static void scalars_colour_it(void **state)
{
    (void)state;
    static uint8_t slow[3 * PIXELS], fast[3 * PIXELS];
    SolidsScene scene = splat_among_solids();
    scene.def.color_by = SCALAR_SPEED;
    scene.def.range_auto = false, scene.def.range[0] = 0, scene.def.range[1] = 2;
    particles_add(scene.particles, 0, 0.5, 0, 0, 0);
    draw_rgb(&scene, true, slow);
    scene.particles->speed[0] = 2;
    draw_rgb(&scene, true, fast);
    const uint8_t *first = pixel_of(slow, WIDTH / 2, HEIGHT / 2),
                  *last = pixel_of(fast, WIDTH / 2, HEIGHT / 2);
    assert_true(abs(first[0] - 68) < 3 && abs(first[1] - 1) < 3 &&
                abs(first[2] - 84) < 3); /* viridis' ends */
    assert_true(abs(last[0] - 253) < 3 && abs(last[1] - 231) < 3 && abs(last[2] - 37) < 3);
    free(scene.particles);
}

static void change(Renderer *renderer, SolidsScene *scene, uint8_t rgb[3 * PIXELS])
{
    Error error = {0};
    if (!renderer_set_def(renderer, &scene->def, &scene->world, &error))
        fail_msg("%s", error.message);
    draw(scene, renderer);
    renderer_read(renderer, rgb);
}

/* Numbers of some pictures only stand after the enabling setting. */
static void make_settings(SplatDef usual, SplatDef others[], int count)
{
    for (int i = 0; i < count; i++)
        others[i] = usual;
    others[0].eps = 0.2;
    others[1].weights = SPLAT_NO_WEIGHTS;
    others[2].weights = SPLAT_W1;
    others[3].shape = SPLAT_PAPER;
    others[4].show = SPLAT_DEPTH;
    others[5].show = SPLAT_NORMALS;
    others[6].show = SPLAT_WEIGHT;
    others[7].show = SPLAT_THICKNESS;
    others[8].shading = SPLAT_JELLY;
    others[9].shading = others[10].shading = others[11].shading = SPLAT_WATER;
    others[10].ior = 1.6;
    others[11].attenuation = 0.05;
    others[12].shape = SPLAT_ELLIPSOID;
    others[13].drops = true;
    others[14].antialias = !usual.antialias;
    for (int i = 15; i < 19; i++)
        others[i].filter = SPLAT_NARROW_RANGE;
    others[16].filter_size = 1;
    others[17].filter_range = 0.1;
    others[18].filter_iterations = 8;
    others[19].level = 0.1;
    others[20].level = 0.15;
}

/* A row of particles, a third of a spacing apart: these are ellipsoids where that is asked for. */
static void add_row(SolidsScene *scene)
{
    for (int i = -4; i <= 4; i++)
        particles_add(scene->particles, 0.4 + 0.1 * i, 0.2 + 0.05 * i, 0.2, 1, i & 1);
}

/* Pixels that differ by more than what drivers and processors round differently, 2/255. */
static int pixels_changed(const uint8_t *a, const uint8_t *b)
{
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        int most = 0;
        for (int c = 3 * i; c < 3 * i + 3; c++)
            most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
        count += most > 2;
    }
    return count;
}

/* Every setting changes the picture of a renderer that is drawing already, and back again. */
static void settings_are_live(void **state)
{
    (void)state;
    static uint8_t first[3 * PIXELS], last[3 * PIXELS], other[3 * PIXELS];
    enum { OTHERS = 21, CHANGED = 150 };
    SplatDef others[OTHERS];
    SolidsScene scene = splat_among_solids();
    particles_add(scene.particles, -0.15, 0.7, 0, 1, 0);
    particles_add(scene.particles, 0.15, 0.4, 0.1, 1, 1);
    add_row(&scene);
    Renderer *renderer = drawn(&scene);
    renderer_read(renderer, first);
    const SplatDef usual = *splat_def(&scene.def);
    memcpy(last, first, sizeof last);
    make_settings(usual, others, OTHERS);
    for (int i = 0; i < OTHERS; i++) {
        *splat_def(&scene.def) = others[i];
        change(renderer, &scene, other);
        const int of_usual = pixels_changed(other, first), of_last = pixels_changed(other, last);
        if (of_usual < CHANGED || of_last < CHANGED)
            fail_msg("setting %d changes %d pixels of the usual picture, %d of the one before", i, of_usual,
                     of_last);
        memcpy(last, other, sizeof last);
    }
    *splat_def(&scene.def) = usual;
    change(renderer, &scene, other);
    assert_memory_equal(other, first, sizeof first);
    renderer_destroy(renderer);
    free(scene.particles);
}

static void maps_can_be_seen(void **state)
{
    (void)state;
    static uint8_t normals[3 * PIXELS], depth[3 * PIXELS];
    SolidsScene scene = splat_among_solids();
    particles_add(scene.particles, -0.5, 0.5, 0.3, 1, 0);
    particles_add(scene.particles, 0.5, 0.5, -0.3, 1, 0);
    splat_def(&scene.def)->show = SPLAT_NORMALS;
    draw_rgb(&scene, false, normals);
    splat_def(&scene.def)->show = SPLAT_DEPTH;
    draw_rgb(&scene, false, depth);
    int near[2], far[2];
    pixel_at(&scene, (double[]){-0.5, 0.5, 0.3}, near);
    pixel_at(&scene, (double[]){0.5, 0.5, -0.3}, far);
    assert_true(brightness(depth, near[0], near[1]) > brightness(depth, far[0], far[1]) + 20);
    const uint8_t *left = pixel_of(normals, near[0] - 8, near[1]),
                  *right = pixel_of(normals, near[0] + 8, near[1]);
    assert_true(left[0] + 30 < right[0] &&
                left[2] > 200); /* to the left and to the right, both towards the eye */
    free(scene.particles);
}

/* A drop, and a picture of the drop elsewhere by the same view: equal to a new view. */
static void nothing_is_left_of_the_picture_before(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        static uint8_t moved[3 * PIXELS], fresh[3 * PIXELS];
        SolidsScene scene = splat_among_solids();
        splat_def(&scene.def)->cull = i & 1, splat_def(&scene.def)->antialias = true;
        particles_add(scene.particles, -0.4, 0.3, 0, 1, 0);
        if (i & 2)
            scene_add(&scene, SOLID_SPHERE, -0.3, 0.4, 0.2);
        Renderer *renderer = drawn(&scene);
        memcpy(scene.particles->position, (float[3]){-0.2F, 0.4F, 0}, 3 * sizeof(float));
        draw(&scene, renderer);
        draw(&scene, renderer);
        renderer_read(renderer, moved);
        renderer_destroy(renderer);
        draw_rgb(&scene, false, fresh);
        assert_memory_equal(moved, fresh, sizeof fresh);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(solids_hide_and_are_hidden, no_gl_errors),
        cmocka_unit_test_teardown(its_shadow_falls_on_the_floor, no_gl_errors),
        cmocka_unit_test_teardown(a_drops_shadow_is_its_own, no_gl_errors),
        cmocka_unit_test_teardown(solids_and_drops_shade_the_fluid, no_gl_errors),
        cmocka_unit_test_teardown(solids_through_clear_fluid, no_gl_errors),
        cmocka_unit_test_teardown(shading_leaves_the_surface_alone, no_gl_errors),
        cmocka_unit_test_teardown(colours_mix_where_fluids_meet, no_gl_errors),
        cmocka_unit_test_teardown(scalars_colour_it, no_gl_errors),
        cmocka_unit_test_teardown(settings_are_live, no_gl_errors),
        cmocka_unit_test_teardown(maps_can_be_seen, no_gl_errors),
        cmocka_unit_test_teardown(nothing_is_left_of_the_picture_before, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
