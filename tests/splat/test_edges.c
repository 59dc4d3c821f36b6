/* The view splat where there is next to nothing, or too much: no GL error, and the right picture for the
 * rest. */
#include "tests/splat/splat_fixture.h"

static SplatScene two_drops(void)
{
    SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.2);
    splat_def(&scene.def)->shading = SPLAT_WATER; /* has all passes */
    particles_add(scene.particles, -0.3, 0.6, 0.1, 1, 0);
    particles_add(scene.particles, 0.3, 0.4, 0, 1, 1);
    return scene;
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

static void nothing_at_all(void **state)
{
    (void)state;
    for (int cull = 0; cull < 2; cull++)
        for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
            SplatScene scene = two_drops();
            splat_def(&scene.def)->cull = cull, splat_def(&scene.def)->sprite = (SplatSprite)sprite;
            scene.empty = true;
            assert_int_equal(covered_pixels(&scene), 0);
            free(scene.particles);
        }
}

static void one_particle(void **state)
{
    (void)state;
    SplatScene scene = two_drops();
    scene.particles->count = 1;
    assert_true(splat_compare(&scene) > 300);
    free(scene.particles);
}

static void a_picture_of_one_pixel(void **state)
{
    (void)state;
    SplatScene scene = two_drops();
    scene.width = scene.height = 1;
    assert_int_equal(covered_pixels(&scene), 0); /* its centre passes between the drops */
    scene.particles->position[0] = 0, scene.particles->position[1] = 0.45F;
    assert_int_equal(splat_compare(&scene), 1);
    free(scene.particles);
}

/* Of the whole picture, by the target's depth. */
static double covered_share(SplatScene *scene, int side)
{
    Error error = {0};
    ParticleBuffers buffers;
    const size_t pixels = (size_t)side * (size_t)side;
    size_t covered = 0;
    float *depth = calloc(pixels, sizeof *depth);
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, side, side, &error);
    assert_true(depth && renderer);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, depth);
    for (size_t i = 0; i < pixels; i++)
        covered += depth[i] > 0;
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(depth);
    return (double)covered / (double)pixels;
}

static void a_picture_of_4096_pixels_a_side(void **state)
{
    (void)state;
    SplatScene scene = two_drops();
    const double share = covered_share(&scene, 160);
    assert_true(share > 0.03);
    assert_float_equal(covered_share(&scene, 4096), share, 0.001);
    free(scene.particles);
}

static void an_eye_inside_the_fluid(void **state)
{
    (void)state; /* the spheres around the eye have no outside to be seen */
    SplatScene scene = two_drops();
    particles_add(scene.particles, 0.02, 0.5, 3.05, 1, 0);
    particles_add(scene.particles, -0.1, 0.5, 2.9, 1, 0);
    particles_add(scene.particles, 0.25, 0.5, 2.9, 1, 1); /* beside the fluid */
    assert_true(splat_compare(&scene) > 600);
    free(scene.particles);
}

static void nearer_than_the_near_plane(void **state)
{
    (void)state;
    SplatScene scene = two_drops();
    free(splat_drawn(&scene));
    const double front = 0.5 * scene.frame.camera.near_plane; /* from the eye at 3 m */
    particles_add(scene.particles, 0, 0.5, 3 - 0.2 - front, 1, 0);
    SplatPixel *pixels = splat_drawn(&scene);
    assert_true(pixels[60 * 160 + 80].depth > 1);
    free(pixels);
    assert_true(splat_compare(&scene) > 600);
    free(scene.particles);
}

static void a_position_that_is_no_number(void **state)
{
    (void)state;
    for (int cull = 0; cull < 2; cull++)
        for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++)
            for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_PAPER; shape++) {
                SplatScene scene = two_drops();
                particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
                particles_add(scene.particles, 0, 0.5, NAN, 1, 0);
                particles_add(scene.particles, INFINITY, 0.5, -INFINITY, 1, 0);
                particles_add(scene.particles, 1e30, -1e30, 1e30, 1, 0);
                particles_add(scene.particles, 0.35, 0.4, 0.1, 1, 0);
                splat_def(&scene.def)->eps = 1, splat_def(&scene.def)->cull = cull;
                splat_def(&scene.def)->shape = (SplatShape)shape,
                splat_def(&scene.def)->sprite = (SplatSprite)sprite;
                assert_true(splat_compare(&scene) > 600);
                free(scene.particles);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(nothing_at_all, no_gl_errors),
        cmocka_unit_test_teardown(one_particle, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_of_one_pixel, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_of_4096_pixels_a_side, no_gl_errors),
        cmocka_unit_test_teardown(an_eye_inside_the_fluid, no_gl_errors),
        cmocka_unit_test_teardown(nearer_than_the_near_plane, no_gl_errors),
        cmocka_unit_test_teardown(a_position_that_is_no_number, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
