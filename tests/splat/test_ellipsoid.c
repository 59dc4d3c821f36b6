/* The view splat with ellipsoids and with drops: pixel by pixel against rays and ellipsoids in double,
   and the purposes: flat surfaces, drops of correct size. */
#include "tests/splat/splat_fixture.h"

/* Few will do where neither sprites nor culling matter. */
static const SplatDef kinds[] = {
    {1.5, SPLAT_W1W2, SPLAT_ELLIPSOID, SPLAT_QUAD, .drops = true},
    {1.5, SPLAT_W1W2, SPLAT_PERSPECTIVE, SPLAT_POINT, .cull = true, .drops = true},
    {1.5, SPLAT_W1W2, SPLAT_ELLIPSOID, SPLAT_POINT, .cull = true, .drops = true},
    {1.5, SPLAT_W1W2, SPLAT_PERSPECTIVE, SPLAT_QUAD, .drops = true},
    {1.5, SPLAT_W1W2, SPLAT_PAPER, SPLAT_QUAD, .drops = true},
};
enum { FEW = 2, KINDS = sizeof kinds / sizeof *kinds };

static void compare_all(SplatScene *scene, int count, int least)
{
    for (int kind = 0; kind < count; kind++) {
        *splat_def(&scene->def) = kinds[kind];
        const int covered = splat_compare(scene);
        if (covered < least)
            fail_msg("%s, %s: %d pixels", splat_shape_names[kinds[kind].shape],
                     splat_sprite_names[kinds[kind].sprite], covered);
    }
    free(scene->particles);
}

/* Sheets and lines across each other, half a radius apart: thin ellipsoids at all angles. */
static void add_rods(SplatScene *scene, double x, double y, double z, double step)
{
    for (int i = -3; i <= 3; i++)
        for (int k = -1; k <= 1; k++) {
            particles_add(scene->particles, x + i * step, y + 0.8 * i * step + 0.4 * k * step,
                          z + 0.6 * k * step, 1, 0);
            particles_add(scene->particles, x + 0.3 * k * step, y + i * step, z - i * step, 1, 1);
        }
}

static SplatScene small(const double from[3], const double to[3], double fov_deg, double radius)
{
    SplatScene scene = splat_scene(from, to, fov_deg, radius);
    scene.width = 96, scene.height = 72;
    return scene;
}

static void of_all_sizes(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0.3, 0.7, 3}, (double[]){0, 0.5, 0}, 40, 0.2);
    add_rods(&scene, 0, 0.5, 0, 0.12);
    particles_add(scene.particles, 0.8, 0.8, 0, 1, 0);
    compare_all(&scene, KINDS, 600);
}

static void centred_outside_the_view(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0, 2}, (double[]){0, 0, 0}, 40, 0.3);
    add_rods(&scene, 1.2, 0, 0, 0.1);
    add_rods(&scene, 0, -1.1, 0.2, 0.1);
    compare_all(&scene, FEW, 40);
}

static void in_the_corners_of_a_wide_view(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0, 1}, (double[]){0, 0, 0}, 110, 0.2);
    add_rods(&scene, 1.4, 1.0, 0, 0.15);
    add_rods(&scene, -1.3, -0.9, 0.2, 0.15);
    compare_all(&scene, FEW, 180);
}

static void small_and_far(void **state)
{
    (void)state; /* a few pixels across, 2,000 radii away */
    SplatScene scene = small((double[]){0, 0, 20}, (double[]){0, 0, 0}, 0.5, 0.01);
    for (int i = -2; i <= 2; i++)
        add_rods(&scene, 0.035 * i, 0.02 * sin(3 * i), 0, 0.006);
    compare_all(&scene, FEW, 180);
}

static void around_the_eye(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0.5, 1}, (double[]){0, 0.5, 0}, 60, 0.1);
    add_rods(&scene, 0, 0.5, 1, 0.06);
    add_rods(&scene, 0.2, 0.5, 0.3, 0.06);
    compare_all(&scene, FEW, 110);
}

static void one_or_none(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.3);
    particles_add(scene.particles, 0.2, 0.6, 0.1, 1, 0);
    for (int kind = 0; kind < FEW; kind++) {
        *splat_def(&scene.def) = kinds[kind];
        scene.empty = true;
        SplatPixel *pixels = splat_drawn(&scene);
        for (int i = 0; i < scene.width * scene.height; i++)
            assert_true(pixels[i].depth > 1e29);
        free(pixels);
        scene.empty = false;
    }
    compare_all(&scene, FEW, 110);
}

static void a_picture_of_one_pixel(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.3);
    scene.width = scene.height = 1;
    add_rods(&scene, 0, 0.5, 0, 0.12);
    compare_all(&scene, FEW, 1);
}

static void positions_that_are_no_numbers(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.2);
    particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
    particles_add(scene.particles, 0, 0.5, NAN, 1, 0);
    add_rods(&scene, 0, 0.5, 0, 0.12);
    particles_add(scene.particles, INFINITY, 0.5, -INFINITY, 1, 0);
    particles_add(scene.particles, 1e30, -1e30, 1e30, 1, 0);
    compare_all(&scene, FEW, 600);
}

static void in_two_dimensions(void **state)
{
    (void)state;
    SplatScene scene = small((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.1);
    scene.state.box_size[2] = 0.1;
    for (int i = 0; i < 150; i++)
        particles_add(scene.particles, 0.6 * sin(12.9898 * i), 0.5 + 0.3 * sin(78.233 * i), 0, 1,
                      (unsigned)i % 2);
    compare_all(&scene, FEW, 600);
}

/* Mean of the map; its texels are as large as the farthest particle allows. */
static double thickness_of(SplatScene *scene)
{
    GLint width, height;
    double sum = 0;
    SplatDrawing drawing = splat_open(scene, NULL, false);
    const unsigned map = splat_thickness_map(drawing.view);
    glGetTextureLevelParameteriv(map, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(map, 0, GL_TEXTURE_HEIGHT, &height);
    float *values = read_map(map, GL_RED, width * height, 1);
    for (int i = 0; i < width * height; i++)
        sum += values[i];
    free(values);
    splat_close(&drawing);
    return sum / (width * height);
}

/* Neither thickness nor a level above zero knows ellipsoids or drops. */
static void the_field_is_one_of_balls(void **state)
{
    (void)state;
    double thickness[3];
    SplatPixel *levels[3];
    SplatScene scene = small((double[]){0.3, 0.7, 3}, (double[]){0, 0.5, 0}, 40, 0.2);
    add_rods(&scene, 0, 0.5, 0, 0.12);
    for (int i = 0; i < 3; i++) {
        splat_def(&scene.def)->shape = i == 2 ? SPLAT_ELLIPSOID : SPLAT_PERSPECTIVE,
        splat_def(&scene.def)->drops = i > 0;
        splat_def(&scene.def)->shading = SPLAT_WATER, splat_def(&scene.def)->level = 0;
        thickness[i] = thickness_of(&scene);
        splat_def(&scene.def)->shading = SPLAT_PHONG, splat_def(&scene.def)->level = 0.15;
        levels[i] = splat_drawn(&scene);
    }
    assert_true(thickness[0] > 0.01 && thickness[1] == thickness[0]);
    assert_true(fabs(thickness[2] / thickness[0] - 1) < 0.02);
    for (int i = 0; i < scene.width * scene.height; i++)
        for (int k = 1; k < 3; k++)
            assert_true(levels[0][i].depth == levels[k][i].depth &&
                        levels[0][i].weight == levels[k][i].weight);
    for (int i = 0; i < 3; i++)
        free(levels[i]);
    free(scene.particles);
}

/* The surface of a fluid at rest, from above: 30 x 30 x 8 particles, displaced from lattice places as in
   a settled fluid. Root mean square of the depth around the mean, in spacings. */
static double roughness(SplatShape shape, double *mean)
{
    const double s = 0.03;
    SplatScene scene = splat_scene((double[]){0, 20, 0.001}, (double[]){0, 0, 0}, 2, s);
    for (int i = 0; i < 30 * 30 * 8; i++) {
        const int column = i % 30, row = i / 30 % 30, layer = i / 900;
        particles_add(scene.particles, s * (column - 14.5 + 0.2 * sin(12.9898 * i)),
                      s * (layer + 0.5 + 0.15 * sin(78.233 * i)), s * (row - 14.5 + 0.2 * sin(37.719 * i)), 1,
                      0);
    }
    splat_def(&scene.def)->shape = shape;
    SplatPixel *pixels = splat_drawn(&scene);
    double sum = 0, squares = 0;
    for (int i = 0; i < 60 * 60; i++) {
        const double depth = (pixels[(30 + i / 60) * 160 + 50 + i % 60].depth - 20) / s;
        sum += depth, squares += depth * depth;
    }
    *mean = 8 + sum / 3600; /* how far below the surface of 8 layers */
    free(pixels);
    free(scene.particles);
    return sqrt(squares / 3600 - sum / 3600 * sum / 3600);
}

static void a_flat_surface_is_flat(void **state)
{
    (void)state;
    double below[2];
    const double spheres = roughness(SPLAT_PERSPECTIVE, &below[0]),
                 ellipsoids = roughness(SPLAT_ELLIPSOID, &below[1]);
    if (!(ellipsoids < 0.6 * spheres && fabs(below[1]) < 0.05))
        fail_msg("roughness %g spacings, of spheres %g; %g below the surface", ellipsoids, spheres, below[1]);
}

/* Two spheres a radius apart: test_splat.c. */
static void there_is_no_seam(void **state)
{
    (void)state;
    double greatest = 0;
    SplatScene scene = splat_scene((double[]){0, 0, 4}, (double[]){0, 0, 0}, 25, 0.5);
    scene.width = 400, scene.height = 300;
    particles_add(scene.particles, -0.25, 0, 0, 1, 0);
    particles_add(scene.particles, 0.25, 0, 0, 1, 1);
    splat_def(&scene.def)->shape = SPLAT_ELLIPSOID, splat_def(&scene.def)->eps = 0.25;
    SplatPixel *pixels = splat_drawn(&scene);
    for (int y = 120; y < 180; y++)
        for (int x = 140; x < 260; x++) {
            const double *a = pixels[y * 400 + x].normal, *b = pixels[y * 400 + x + 1].normal;
            greatest = fmax(greatest, acos(fmin(dot3(a, b) / sqrt(dot3(a, a) * dot3(b, b)), 1)));
        }
    if (!(greatest > 0.001 && greatest < 0.06))
        fail_msg("greatest turn from pixel to pixel: %g rad", greatest);
    free(pixels);
    free(scene.particles);
}

/* Its silhouette is a cone about the sphere: tan^2 = r^2 / (d^2 - r^2). */
static void a_drop_has_its_own_volume(void **state)
{
    (void)state;
    const double s = 0.2, pi = acos(-1);
    for (int kind = 0; kind < FEW; kind++) {
        SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 8, s);
        particles_add(scene.particles, 0.01, 0.5, 0, 1, 0);
        *splat_def(&scene.def) = kinds[kind];
        SplatPixel *pixels = splat_drawn(&scene);
        int covered = 0;
        for (int i = 0; i < scene.width * scene.height; i++)
            covered += pixels[i].depth < 1e29;
        const double side = 2 * scene.frame.camera.tangent[1] / scene.height,
                     tan2 = covered * side * side / pi;
        const double r = sqrt(9 * tan2 / (1 + tan2)), volume = 4 / 3.0 * pi * r * r * r;
        if (!(fabs(volume / (s * s * s) - 1) < 0.02))
            fail_msg("%s: a drop of %g of its volume", splat_shape_names[kinds[kind].shape],
                     volume / (s * s * s));
        free(pixels);
        free(scene.particles);
    }
}

/* As a particle falls into the fluid its radius grows, by small steps, from a drop's to the view's. */
static void a_drop_does_not_pop(void **state)
{
    (void)state;
    const double s = 0.1;
    double last = 0;
    SplatScene scene = splat_scene((double[]){0, 0.5, 5}, (double[]){0, 0.5, 0}, 30, s);
    scene.width = scene.height = 4;
    *splat_def(&scene.def) = kinds[1];
    for (int i = 0; i < 7 * 7 * 5; i++) {
        const int column = i % 7, row = i / 7 % 7, layer = i / 49;
        particles_add(scene.particles, s * (column - 3), s * (layer + 0.5), s * (row - 3), 1, 0);
    }
    const size_t drop = scene.particles->count;
    particles_add(scene.particles, 0.3 * s, 0, 0.2 * s, 1, 0);
    for (int step = 0; step <= 100; step++) {
        scene.particles->position[4 * drop + 1] = (float)(s * (8 - 0.04 * step));
        free(splat_drawn(&scene));
        const double radius = splat_shapes[drop] / s;
        assert_true(step > 0 ? radius > last - 1e-6 && radius < last + 0.04 : fabs(radius - 0.62035) < 1e-4);
        last = radius;
    }
    assert_true(last > 0.99 && last < 1 + 1e-6);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(of_all_sizes, no_gl_errors),
        cmocka_unit_test_teardown(centred_outside_the_view, no_gl_errors),
        cmocka_unit_test_teardown(in_the_corners_of_a_wide_view, no_gl_errors),
        cmocka_unit_test_teardown(small_and_far, no_gl_errors),
        cmocka_unit_test_teardown(around_the_eye, no_gl_errors),
        cmocka_unit_test_teardown(one_or_none, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_of_one_pixel, no_gl_errors),
        cmocka_unit_test_teardown(positions_that_are_no_numbers, no_gl_errors),
        cmocka_unit_test_teardown(in_two_dimensions, no_gl_errors),
        cmocka_unit_test_teardown(the_field_is_one_of_balls, no_gl_errors),
        cmocka_unit_test_teardown(a_flat_surface_is_flat, no_gl_errors),
        cmocka_unit_test_teardown(there_is_no_seam, no_gl_errors),
        cmocka_unit_test_teardown(a_drop_has_its_own_volume, no_gl_errors),
        cmocka_unit_test_teardown(a_drop_does_not_pop, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
