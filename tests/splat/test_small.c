/* Spheres of the view splat smaller than pixels: coverage equals area. */
#include "tests/splat/outlines_fixture.h"

/* Drops 0.3 pixels in radius, far from each other. */
static SolidsScene drops(double radius_pixels)
{
    SolidsScene scene = scene_of(30);
    scene.def.camera = (CameraDef){{0, 0.5, 3}, {0, 0.5, 0}, 30};
    scene.state.spacing = radius_pixels * 3 * tan(15 * M_PI / 180) / (H / 2.0);
    scene.particles->count = 0;
    for (int i = 0; i < 40; i++)
        particles_add(scene.particles, 0.8 * sin(12.9 * i), 0.5 + 0.6 * sin(78.2 * i), 0, 1, 1);
    return scene;
}

/* Light taken from a picture; mean over a camera moving by parts of a pixel, and the deviation. */
static void darkening(const SolidsScene *scene, bool antialias, double *mean, double *deviation)
{
    static uint8_t rgb[3 * N], clear[3 * N];
    const double pixel = 3 * tan(15 * M_PI / 180) / (H / 2.0);
    double sum = 0, squares = 0;
    Error error = {0};
    ParticleBuffers buffers, state = scene->state;
    ViewDef def = scene->def, none = scene->def;
    splat_def(&def)->antialias = antialias;
    text_set(none.kind, "none");
    state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &state, &buffers);
    Renderer *renderer = renderer_create(&none, &scene->world, W, H, &error);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, clear);
    for (int i = 0; i < 16; i++) {
        def.camera.from[0] = def.camera.to[0] = (i % 8) * pixel / 8;
        def.camera.from[1] = def.camera.to[1] = 0.5 + (0.37 * i + (i > 7)) * pixel / 2;
        assert_true(renderer_set_def(renderer, &def, &scene->world, &error));
        renderer_draw(renderer, &buffers, NULL);
        renderer_read(renderer, rgb);
        double light = 0;
        for (int k = 0; k < N; k++) /* of blue, which the drops have next to none of */
            light += linear_of(clear[3 * k + 2]) - linear_of(rgb[3 * k + 2]);
        sum += light, squares += light * light;
    }
    *mean = sum / 16, *deviation = sqrt(fmax(squares / 16 - pow(sum / 16, 2), 0));
    renderer_destroy(renderer);
    upload_destroy(upload);
}

/* As much light as their area does, and alike wherever their centres are in pixels. */
static void small_drops_neither_vanish_nor_sparkle(void **state)
{
    (void)state;
    const double radii[] = {0.15, 0.3, 0.6};
    double one = 0;
    for (int i = 0; i < 3; i++) {
        SolidsScene scene = drops(radii[i]);
        double with, without, flicker, flicker_without;
        darkening(&scene, true, &with, &flicker);
        darkening(&scene, false, &without, &flicker_without);
        one = i == 0 ? with / pow(radii[i], 2) : one;
        const double area = with / pow(radii[i], 2) / one; /* 1 at the share of the area */
        if (flicker > 0.03 * with || flicker > flicker_without / 1.5 || area < 0.75 || area > 1.1)
            fail_msg("%g pixels: %g +- %g with, %g +- %g without; %g of its area", radii[i], with, flicker,
                     without, flicker_without, area);
        free(scene.particles);
    }
}

static int blue_pixels(const SolidsScene *scene, bool antialias)
{
    static uint8_t rgb[3 * N];
    SolidsScene other = *scene;
    int count = 0;
    splat_def(&other.def)->antialias = antialias;
    draw_at(&other, W, H, rgb, NULL);
    for (int i = 0; i < N; i++)
        count += rgb[3 * i] < 0.6 * rgb[3 * i + 2];
    return count;
}

/* Drops of the second fluid, smaller than pixels, before a wall of large drops: the wall shows through. */
static void small_drops_leave_no_hole(void **state)
{
    (void)state;
    static uint8_t rgb[3 * N];
    SolidsScene scene = drops(0.4);
    const size_t count = scene.particles->count;
    const double r = scene.state.spacing;
    scene.world.fluids[1].color[0] = 0.03F, scene.world.fluids[1].color[1] = 0.22F,
    scene.world.fluids[1].color[2] = 0.55F;
    const int wide = (int)(1.2 / r), high = (int)(0.8 / r);
    for (int i = 0; i < wide * high; i++)
        particles_add(scene.particles, -0.6 + r * (i % wide), 0.1 + r * floor((double)i / wide), -0.5, 1, 0);
    const int wall = blue_pixels(&scene, false), with = blue_pixels(&scene, true);
    if (wall < 1000 || abs(with - wall) > wall / 10)
        fail_msg("of a wall of %d pixels %d are left behind small drops", wall, with);
    draw_at(&scene, W, H, rgb, NULL);
    for (int y = H / 2 - 10; y < H / 2 + 10; y++)
        for (int x = W / 2 - 10; x < W / 2 + 10; x++)
            if (rgb[3 * (y * W + x)] > 0.6 * rgb[3 * (y * W + x) + 2])
                fail_msg("a hole in the wall at %d %d, before %zu drops", x, y, count);
    free(scene.particles);
}

/* Where the view's radius is less than a spacing, spheres within eps do not cover a far body: what is behind
 * them does. */
static void a_far_body_is_opaque(void **state)
{
    (void)state;
    static uint8_t far[3 * N];
    SolidsScene scene = scene_of(30);
    scene.def.camera = (CameraDef){{2.3, 3, 11}, {-0.7, 0.2, 0}, 20};
    scene.def.radius = 0.5;
    memcpy(scene.world.fluids[1].color, scene.world.fluids[0].color, sizeof(float[3]));
    memcpy(scene.def.background, (double[]){1, 0, 0}, sizeof scene.def.background);
    draw_at(&scene, W, H, far, NULL);
    int inside = 0;
    for (int y = H / 2 - 2; y < H / 2 + 2; y++)
        for (int x = W / 2 - 4; x < W / 2 + 4; x++)
            inside += 2 * far[3 * (y * W + x)] < far[3 * (y * W + x) + 2]; /* blue, not red */
    if (inside < 32)
        fail_msg("the background shows in %d of 32 pixels", 32 - inside);
    free(scene.particles);
}

/* Culling changes nothing, where spheres are smaller than pixels too. */
static void culling_changes_no_pixel(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    const double fov[] = {10, 60, 150};
    for (int i = 0; i < 4; i++) {
        SolidsScene scene = scene_of(fov[i < 3 ? i : 2]);
        splat_def(&scene.def)->shape = i < 3 ? SPLAT_PERSPECTIVE : SPLAT_ELLIPSOID;
        draw_at(&scene, W, H, with, NULL);
        splat_def(&scene.def)->cull = false;
        draw_at(&scene, W, H, without, NULL);
        assert_memory_equal(with, without, sizeof with);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(small_drops_neither_vanish_nor_sparkle, no_gl_errors),
        cmocka_unit_test_teardown(small_drops_leave_no_hole, no_gl_errors),
        cmocka_unit_test_teardown(a_far_body_is_opaque, no_gl_errors),
        cmocka_unit_test_teardown(culling_changes_no_pixel, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
