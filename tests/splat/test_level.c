/* The view splat at a level above zero, pixel by pixel, against eq. 1, 2 and 4 of Adams, Lenaerts, Dutré 2006
   in double. */
#include "tests/splat/splat_level_fixture.h"

#include "render/views/splat/splat_private.h"

/* The support is `h`, 2.1 spacings. */
static SplatScene level_scene(const double from[3], const double to[3], double fov_deg, double h,
                              double level)
{
    SplatScene scene = splat_scene(from, to, fov_deg, h / 2.1);
    scene.def.radius = 0;
    splat_def(&scene.def)->level = level;
    return scene;
}

/* Each shape, each sprite, with and without culling. */
static void compare_all(SplatScene *scene, int stride, int least)
{
    for (int choice = 0; choice < 4; choice++) {
        splat_def(&scene->def)->shape = (choice & 1) ? SPLAT_PAPER : SPLAT_PERSPECTIVE;
        splat_def(&scene->def)->sprite = (choice & 2) ? SPLAT_POINT : SPLAT_QUAD;
        splat_def(&scene->def)->cull = choice == 1 || choice == 2;
        const int covered = level_compare(scene, stride);
        if (covered < least)
            fail_msg("%s, %s: %d pixels", splat_shape_names[splat_def(&scene->def)->shape],
                     splat_sprite_names[splat_def(&scene->def)->sprite], covered);
    }
    free(scene->particles);
}

/* In a lattice at rest the field is 1 within 2 %, in a flat box within its one layer: eq. 1 summed up. */
static void the_field_is_one_inside(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const int deep = dimensions == 3 ? 3 : 0;
        double sum = 0;
        for (int x = -3; x <= 3; x++)
            for (int y = -3; y <= 3; y++)
                for (int z = -deep; z <= deep; z++)
                    sum += pow(fmax(1 - (x * x + y * y + z * z) / (2.1 * 2.1), 0), 3);
        assert_float_equal(splat_level_gain(0.21, 0.1, dimensions == 2) * sum, 1, 0.02);
    }
    assert_float_equal(splat_level_gain(0.21, 0.1, false), 1e-3 * kernel_poly6(0, 0.21), 1e-12);
    assert_float_equal(splat_level_lone_distance(0.2, 0.1, 1), 0, 0);
}

/* W(r) V = I at the radius of a ball, whose depth is known. */
static void one_particle_is_a_ball(void **state)
{
    (void)state;
    SplatScene scene = level_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 30, 0.6, 0.08);
    particles_add(scene.particles, 0.2, 0.6, 0.1, 1, 0);
    SplatPixel *drawn = splat_drawn(&scene);
    const double h = scene.frame.radii.drawn, spacing = scene.state.spacing;
    const double gain = spacing * spacing * spacing * kernel_poly6(0, h);
    const double radius = h * sqrt(1 - cbrt(0.08 / gain));
    int covered = 0;
    assert_float_equal(h, 0.6, 1e-6);
    assert_float_equal(radius, splat_level_lone_distance(0.08, gain, h), 1e-9);
    scene.frame.radii.drawn = (float)radius;
    for (int i = 0; i < scene.width * scene.height; i++) {
        const SplatHit hit = hit_of(&scene, 0, i % scene.width, i / scene.width);
        if (fabs(hit.rho - 1) < 4e-3)
            continue;
        covered += hit.rho < 1;
        if ((drawn[i].depth < 1e29) != (hit.rho < 1))
            fail_msg("%g radii beside the centre: depth %g", hit.rho, drawn[i].depth);
        if (hit.rho < 0.98 && fabs(drawn[i].depth - hit.depth) > (snaps() ? 3e-4 : 1e-4) * h)
            fail_msg("%g radii beside: depth %.9g, of the ball %.9g", hit.rho, drawn[i].depth, hit.depth);
    }
    assert_true(covered > 700);
    free(drawn);
    free(scene.particles);
}

static void balls_centred_outside_the_view(void **state)
{
    (void)state;
    SplatScene scene = level_scene((double[]){0, 0, 2}, (double[]){0, 0, 0}, 40, 0.9, 0.03);
    particles_add(scene.particles, 1.35, 0, 0, 1, 0);
    particles_add(scene.particles, 0, -1.05, 0, 1, 1);
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_PAPER; shape++) {
        splat_def(&scene.def)->shape = (SplatShape)shape, splat_def(&scene.def)->sprite = SPLAT_QUAD;
        assert_true(level_compare(&scene, 1) > 100);
    }
    free(scene.particles);
}

static void two_and_three_melt_together(void **state)
{
    (void)state;
    SplatScene scene = level_scene((double[]){0.3, 0.6, 3}, (double[]){0, 0.5, 0}, 30, 0.5, 0.12);
    particles_add(scene.particles, -0.15, 0.5, 0, 1, 0);
    particles_add(scene.particles, 0.15, 0.5, 0, 1, 1);
    assert_true(level_compare(&scene, 1) > 1000);
    particles_add(scene.particles, 0.1, 0.8, -0.3, 1, 0);
    compare_all(&scene, 2, 300);
}

/* A block of fluid, not quite a lattice, of two kinds, with drops above and in front of it. */
static SplatScene heap(double level)
{
    SplatScene scene = level_scene((double[]){1.2, 1.4, 2.5}, (double[]){0, 0.25, 0}, 30, 0.21, level);
    for (int i = 0; i < 8 * 5 * 8; i++) {
        const int x = i % 8, y = i / 8 % 5, z = i / 40;
        particles_add(scene.particles, 0.1 * (x - 3.5) + 0.03 * sin(12.9 * i),
                      0.1 * y + 0.05 + 0.03 * sin(78.2 * i), 0.1 * (z - 3.5) + 0.03 * sin(37.7 * i), 1,
                      x > 3);
    }
    for (int i = 0; i < 12; i++)
        particles_add(scene.particles, 0.6 * sin(12.9 * i), 0.6 + 0.2 * sin(78.2 * i),
                      0.4 + 0.4 * sin(37.7 * i), 1, (unsigned)i % 2);
    return scene;
}

static void a_heap(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        SplatScene scene = heap((double[]){0.03, 0.12, 0.5}[i]);
        compare_all(&scene, 5, 80);
    }
}

/* With the sphere's own radius as support. */
static void a_radius_of_the_scenes_own(void **state)
{
    (void)state;
    SplatScene scene = heap(0.4);
    scene.def.radius = 1.5;
    assert_true(level_compare(&scene, 3) > 300);
    assert_float_equal(scene.frame.radii.drawn, 0.15, 1e-6);
    free(scene.particles);
}

/* Its supports begin far in front, where the field does not reach the level: several ranges, and a gap. */
static void a_thin_drop_before_fluid(void **state)
{
    (void)state;
    SplatScene scene = level_scene((double[]){0, 0.5, 4}, (double[]){0, 0.5, 0}, 25, 0.21, 0.2);
    for (int i = 0; i < 200; i++) {
        const int x = i % 10, y = i / 10 % 10, z = i / 100;
        particles_add(scene.particles, 0.1 * (x - 4.5), 0.5 + 0.1 * (y - 4.5), -1 + 0.1 * z, 1, 0);
    }
    particles_add(scene.particles, 0.02, 0.5, 2, 1, 1); /* alone it is nowhere at the level */
    for (int i = 0; i < 8; i++)                         /* mist: supports in a row, then a gap */
        particles_add(scene.particles, 0.1 * sin(5.3 * i), 0.5 + 0.1 * sin(3.1 * i), 0.2 + 0.15 * i, 1, 1);
    compare_all(&scene, 2, 500);
}

static int covered_pixels(SplatScene *scene)
{
    SplatPixel *pixels = splat_drawn(scene);
    int covered = 0;
    for (int i = 0; i < scene->width * scene->height; i++)
        covered += pixels[i].depth < 1e29;
    free(pixels);
    return covered;
}

static void a_level_that_is_nowhere(void **state)
{
    (void)state;
    SplatScene scene = heap(0.999);
    scene.def.radius = 3; /* smooth: about 1 inside, never above */
    scene.particles->count = 100;
    assert_int_equal(covered_pixels(&scene), 0);
    free(scene.particles);
}

static void not_a_number_and_next_to_nothing(void **state)
{
    (void)state;
    for (int cull = 0; cull < 2; cull++) {
        SplatScene scene = heap(0.1);
        splat_def(&scene.def)->cull = cull;
        particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
        particles_add(scene.particles, 0, 0.5, NAN, 1, 0);
        particles_add(scene.particles, INFINITY, 0.5, -INFINITY, 1, 0);
        particles_add(scene.particles, 1e30, -1e30, 1e30, 1, 0);
        assert_true(level_compare(&scene, 6) > 50);
        scene.empty = true;
        assert_int_equal(covered_pixels(&scene), 0);
        scene.empty = false;
        scene.width = scene.height = 1;
        assert_int_equal(level_compare(&scene, 1), 1);
        free(scene.particles);
    }
}

/* Spheres that hold the eye or begin before the near plane are left out, as at the level zero. */
static void an_eye_inside_the_fluid(void **state)
{
    (void)state;
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        SplatScene scene = heap(0.12);
        memcpy(scene.def.camera.from, (double[]){0.1, 0.2, 0.3}, sizeof scene.def.camera.from);
        memcpy(scene.def.camera.to, (double[]){0, 0.25, -0.5}, sizeof scene.def.camera.to);
        scene.def.camera.fov_deg = 70;
        splat_def(&scene.def)->sprite = (SplatSprite)sprite;
        if (sprite == SPLAT_QUAD)
            assert_true(level_compare(&scene, 4) > 300);
        else
            assert_true(covered_pixels(&scene) > 1000);
        free(scene.particles);
    }
}

/* Culling hides no visible part: the same bits. */
static void culling_changes_no_pixel(void **state)
{
    (void)state;
    SplatPixel *pixels[2];
    SplatScene scene = heap(0.1);
    for (int cull = 0; cull < 2; cull++) {
        splat_def(&scene.def)->cull = cull;
        pixels[cull] = splat_drawn(&scene);
    }
    assert_memory_equal(pixels[0], pixels[1], 160 * 120 * sizeof *pixels[0]);
    free(pixels[0]);
    free(pixels[1]);
    free(scene.particles);
}

/* One renderer: from the spheres to a level, to another, and back. */
static void the_level_changes_live(void **state)
{
    (void)state;
    static const double levels[] = {0, 0.05, 0.3, 0};
    static uint8_t rgb[4][3 * 160 * 120];
    Error error = {0};
    ParticleBuffers buffers;
    SplatScene scene = heap(0);
    scene.state.count = scene.particles->count;
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    Renderer *renderer = renderer_create(&scene.def, &scene.world, 160, 120, &error);
    assert_non_null(renderer);
    for (int i = 0; i < 4; i++) {
        splat_def(&scene.def)->level = levels[i];
        assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
        renderer_draw(renderer, &buffers, NULL);
        renderer_read(renderer, rgb[i]);
    }
    assert_memory_equal(rgb[0], rgb[3], sizeof rgb[0]);
    for (int i = 0; i < 3; i++)
        assert_memory_not_equal(rgb[i], rgb[i + 1], sizeof rgb[0]);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_field_is_one_inside, no_gl_errors),
        cmocka_unit_test_teardown(one_particle_is_a_ball, no_gl_errors),
        cmocka_unit_test_teardown(balls_centred_outside_the_view, no_gl_errors),
        cmocka_unit_test_teardown(two_and_three_melt_together, no_gl_errors),
        cmocka_unit_test_teardown(a_heap, no_gl_errors),
        cmocka_unit_test_teardown(a_radius_of_the_scenes_own, no_gl_errors),
        cmocka_unit_test_teardown(a_thin_drop_before_fluid, no_gl_errors),
        cmocka_unit_test_teardown(a_level_that_is_nowhere, no_gl_errors),
        cmocka_unit_test_teardown(not_a_number_and_next_to_nothing, no_gl_errors),
        cmocka_unit_test_teardown(an_eye_inside_the_fluid, no_gl_errors),
        cmocka_unit_test_teardown(culling_changes_no_pixel, no_gl_errors),
        cmocka_unit_test_teardown(the_level_changes_live, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
