/* The maps of the view splat, pixel by pixel, against the paper's equations in double: Adams, Lenaerts, Dutré
 * 2006. */
#include "tests/scratch.h"
#include "tests/splat/splat_fixture.h"

#include "sim/gpu/gl.h"

/* Each shape with each sprite. */
static void compare_all(SplatScene *scene, int least, bool points_too)
{
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_PAPER; shape++)
        for (int sprite = SPLAT_QUAD; sprite <= (points_too ? SPLAT_POINT : SPLAT_QUAD); sprite++) {
            splat_def(&scene->def)->shape = (SplatShape)shape,
            splat_def(&scene->def)->sprite = (SplatSprite)sprite;
            const int covered = splat_compare(scene);
            if (covered < least)
                fail_msg("%s, %s: %d pixels", splat_shape_names[shape], splat_sprite_names[sprite], covered);
        }
    free(scene->particles);
}

static void depth_of_one_sphere(void **state)
{
    (void)state;
    SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.3);
    particles_add(scene.particles, 0.2, 0.6, 0.1, 1, 0);
    compare_all(&scene, 500, true);
}

static void depth_of_spheres_centred_outside_the_view(void **state)
{
    (void)state;
    SplatScene scene = splat_scene((double[]){0, 0, 2}, (double[]){0, 0, 0}, 40, 0.5);
    particles_add(scene.particles, 1.3, 0, 0, 1, 0);  /* beyond the right side */
    particles_add(scene.particles, 0, -1.0, 0, 1, 1); /* beyond the lower layer */
    compare_all(&scene, 100, true);
}

static void a_sphere_in_the_corner_of_a_wide_view(void **state)
{
    (void)state; /* where the two shapes differ most */
    SplatScene scene = splat_scene((double[]){0, 0, 1}, (double[]){0, 0, 0}, 110, 0.4);
    particles_add(scene.particles, 1.4, 1.0, 0, 1, 0);
    particles_add(scene.particles, -1.3, -0.9, 0.2, 1, 0);
    compare_all(&scene, 500, true);
}

static void small_and_far(void **state)
{
    (void)state; /* a few pixels across, 2,000 radii away */
    SplatScene scene = splat_scene((double[]){0, 0, 20}, (double[]){0, 0, 0}, 0.5, 0.01);
    for (int i = 0; i < 20; i++)
        particles_add(scene.particles, 0.1 * sin(i), 0.06 * cos(1.7 * i), 0.1 * sin(2.9 * i), 1,
                      (unsigned)i % 2);
    compare_all(&scene, 500, true);
}

/* Eq. 8 to 10 with each choice of weights and several widths of the layer. */
static void two_spheres_and_more(void **state)
{
    (void)state;
    static const double all_eps[] = {0.25, 0.6, 1.5};
    for (int weights = SPLAT_NO_WEIGHTS; weights <= SPLAT_W2; weights++)
        for (int i = 0; i < 3; i++) {
            SplatScene scene = splat_scene((double[]){0.3, 0.6, 3}, (double[]){0, 0.5, 0}, 30, 0.4);
            particles_add(scene.particles, -0.2, 0.5, 0, 1, 0);
            particles_add(scene.particles, 0.2, 0.5, 0, 1, 1);
            particles_add(scene.particles, 0.1, 0.8, -0.4, 1, 0);
            splat_def(&scene.def)->weights = (SplatWeights)weights, splat_def(&scene.def)->eps = all_eps[i];
            compare_all(&scene, 2000, false);
        }
}

/* Some hundred spheres on each other, as a fluid has them. */
static void a_heap(void **state)
{
    (void)state;
    SplatScene scene = splat_scene((double[]){1.2, 1.4, 2.5}, (double[]){0, 0.3, 0}, 30, 0.1);
    for (int i = 0; i < 400; i++)
        particles_add(scene.particles, 0.6 * sin(12.9 * i), 0.3 + 0.3 * sin(78.2 * i), 0.4 * sin(37.7 * i), 1,
                      (unsigned)i % 2);
    compare_all(&scene, 4000, false);
}

/* Sums over weights are the colour also at the rim, where weights end: in halves, as hardware has the sums,
 * too. */
static void a_colour_holds_to_the_rim(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 25, 0.5);
        scene.width = 400, scene.height = 300;
        particles_add(scene.particles, 0.011 * i, 0.5 + 0.007 * i, 0, 1, 0);
        SplatPixel *pixels = splat_drawn(&scene);
        int covered = 0;
        for (int k = 0; k < scene.width * scene.height; k++)
            for (int c = 0; pixels[k].weight > 0 && c < 3; c++, covered++)
                if (fabs(pixels[k].color[c] / pixels[k].weight - scene.world.fluids[0].color[c]) > 1e-3)
                    fail_msg("colour %g, not %g, where the weight is %g",
                             pixels[k].color[c] / pixels[k].weight, scene.world.fluids[0].color[c],
                             pixels[k].weight);
        assert_true(covered > 3 * 30000);
        free(pixels);
        free(scene.particles);
    }
}

/* With a driver rounding depths of the first pass down by a few units more than the second, each covered
   pixel still has the foremost sphere. */
static void depths_may_be_rounded_otherwise(void **state)
{
    (void)state;
    char directory[SCRATCH_SIZE], command[5 * SCRATCH_SIZE];
    scratch_folder(directory);
    snprintf(command, sizeof command,
             "cp -r '%s'/shaders/. '%s' && "
             "sed -i 's/? hit.depth :/? hit.depth * 0.999995 :/' '%s/splat/splat_depth.frag'",
             SLOSH_SOURCE_DIR, directory, directory);
    assert_int_equal(system(command), 0);
    SplatScene scene = splat_scene((double[]){0.3, 0.6, 3}, (double[]){0, 0.5, 0}, 30, 0.2);
    splat_def(&scene.def)->weights = SPLAT_NO_WEIGHTS;
    for (int i = 0; i < 30; i++)
        particles_add(scene.particles, 0.4 * sin(12.9 * i), 0.5 + 0.2 * sin(78.2 * i), 0.3 * sin(37.7 * i), 1,
                      0);
    SplatPixel *exact = splat_drawn(&scene);
    program_set_directory(directory);
    SplatPixel *rounded = splat_drawn(&scene);
    program_set_directory(NULL);
    int covered = 0, moved = 0;
    for (int i = 0; i < scene.width * scene.height; i++) {
        assert_int_equal(rounded[i].weight > 0, rounded[i].depth < 1e29);
        covered += rounded[i].weight > 0;
        moved += rounded[i].depth < exact[i].depth;
    }
    assert_true(covered > 1000 && moved == covered);
    free(exact);
    free(rounded);
    free(scene.particles);
}

/* Figure 3: two spheres a radius apart, eps a quarter of it. The greatest turn of the unit normal from a
   pixel to its neighbour, away from silhouettes and from the jump of depth, where even the paper's weights
   cannot help. */
static double greatest_turn(SplatWeights weights)
{
    SplatScene scene = splat_scene((double[]){0, 0, 4}, (double[]){0, 0, 0}, 25, 0.5);
    scene.width = 400, scene.height = 300;
    particles_add(scene.particles, -0.25, 0, 0, 1, 0);
    particles_add(scene.particles, 0.25, 0, 0, 1, 1);
    splat_def(&scene.def)->weights = weights, splat_def(&scene.def)->eps = 0.25;
    SplatPixel *pixels = splat_drawn(&scene);
    double greatest = 0;
    for (int y = 100; y < 200; y++)
        for (int x = 120; x < 280; x++) { /* the middle of the picture: within 0.35 m of its axis */
            const double *a = pixels[y * 400 + x].normal, *b = pixels[y * 400 + x + 1].normal;
            greatest = fmax(greatest, acos(fmin(dot3(a, b) / sqrt(dot3(a, a) * dot3(b, b)), 1)));
        }
    free(pixels);
    free(scene.particles);
    return greatest;
}

static void weights_leave_no_seam(void **state)
{
    (void)state;
    const double none = greatest_turn(SPLAT_NO_WEIGHTS), w1 = greatest_turn(SPLAT_W1),
                 w2 = greatest_turn(SPLAT_W2), w1w2 = greatest_turn(SPLAT_W1W2);
    printf("greatest turn from pixel to pixel: none %g, w1 %g, w2 %g, w1w2 %g rad\n", none, w1, w2, w1w2);
    assert_true(none > 0.5 && w1 > 0.1 && w2 > 0.045 && w2 < w1 && w1w2 < 0.035);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(depth_of_one_sphere, no_gl_errors),
        cmocka_unit_test_teardown(depth_of_spheres_centred_outside_the_view, no_gl_errors),
        cmocka_unit_test_teardown(a_sphere_in_the_corner_of_a_wide_view, no_gl_errors),
        cmocka_unit_test_teardown(small_and_far, no_gl_errors),
        cmocka_unit_test_teardown(two_spheres_and_more, no_gl_errors),
        cmocka_unit_test_teardown(a_heap, no_gl_errors),
        cmocka_unit_test_teardown(depths_may_be_rounded_otherwise, no_gl_errors),
        cmocka_unit_test_teardown(a_colour_holds_to_the_rim, no_gl_errors),
        cmocka_unit_test_teardown(weights_leave_no_seam, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
