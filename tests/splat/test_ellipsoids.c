/* Shapes in the view splat derived from neighbours, against sums over all pairs in double. */
#include "tests/splat/splat_fixture.h"

typedef struct Body {
    double crowd; /* sum of the neighbours' weights */
    double centre[3], radius;
    double axes[3][3]; /* takes the unit sphere to the ellipsoid, over the radius */
} Body;

enum { IMAGES = 8 };

/* How much a wall mirrors, by the spacings to it: the constants of shaders/splat/ellipsoids.comp. */
static double touch_of(double spacings)
{
    const double t = fmin(fmax((spacings - 0.7) / 0.4, 0), 1);
    return 1 - t * t * (3 - 2 * t);
}

/* The share of a neighbour's image behind walls of the box, and the image's offset in h: `image` has bits
   of the mirrored axes. */
static double image_of(const SplatScene *scene, size_t i, size_t j, int image, double d[3])
{
    const float *from = &scene->particles->position[4 * i], *to = &scene->particles->position[4 * j];
    const double *box = scene->state.box_size, h = scene->state.support_radius;
    double share = 1;
    for (int k = 0; k < 3; k++) {
        const double low = k == 1 ? 0 : -box[k] / 2, high = low + box[k];
        const double way = ((double)from[k] < (low + high) / 2 ? low : high) - from[k];
        const bool walled =
            splat_def(&scene->def)->shape == SPLAT_ELLIPSOID && !(k == 2 && scene->frame.slab > 0);
        d[k] = ((double)to[k] - from[k]) / h;
        if (!(image >> k & 1))
            continue;
        share *= walled ? touch_of(fabs(way) / scene->state.spacing) : 0;
        d[k] = 2 * way / h - d[k];
    }
    return share;
}

/* Weight (Yu and Turk 2013, eq. 11) and offset in h of a particle or image, seen from a second particle. */
static double weight_at(const SplatScene *scene, size_t i, size_t j, int image, double d[3])
{
    const double share = image_of(scene, i, j, image, d), q2 = dot3(d, d);
    return share > 0 && q2 < 1 ? share * (1 - q2 * sqrt(q2)) : 0; /* 0 for NaN */
}

/* Returns the sum of weights; `crowd`: that without images. */
static double weighted_mean(const SplatScene *scene, size_t i, double mean[3], double *crowd)
{
    double sum = 0, d[3];
    for (size_t n = 0; n < IMAGES * scene->particles->count; n++) {
        const double w = weight_at(scene, i, n / IMAGES, n % IMAGES, d);
        sum += w, *crowd += n % IMAGES == 0 ? w : 0;
        for (int k = 0; k < 3 && w > 0; k++)
            mean[k] += w * d[k];
    }
    for (int k = 0; k < 3; k++)
        mean[k] /= sum;
    return sum;
}

static void covariance(const SplatScene *scene, size_t i, const double mean[3], double sum, double c[3][3])
{
    double d[3];
    for (size_t n = 0; n < IMAGES * scene->particles->count; n++) {
        const double w = weight_at(scene, i, n / IMAGES, n % IMAGES, d);
        for (int k = 0; k < 9 && w > 0; k++)
            c[k / 3][k % 3] += w / sum * (d[k / 3] - mean[k / 3]) * (d[k % 3] - mean[k % 3]);
    }
}

static double determinant(double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The constants of shaders/splat/ellipsoids.comp. */
static void round_off(double c[3][3], double share, bool flat)
{
    const double more = 0.25 * (c[0][0] + c[1][1] + c[2][2]) + 0.1 * (1 - share) + 1e-3;
    for (int k = 0; k < 3; k++)
        c[k][k] += more;
    if (flat)
        c[2][2] = sqrt(c[0][0] * c[1][1] - c[0][1] * c[0][1]);
    const double scale = cbrt(determinant(c));
    for (int k = 0; k < 9; k++)
        c[k / 3][k % 3] /= scale;
}

/* A quarter of a lattice's weights, in its continuous form; Hermite's step. */
static double share_of(const SplatScene *scene, double crowd, bool flat)
{
    const double q = scene->state.support_radius / scene->state.spacing, pi = acos(-1);
    const double full = 0.25 * (flat ? 0.6 * pi * q * q - 1 : 2 * pi / 3 * q * q * q - 1);
    const double t = fmin(crowd / full, 1);
    return t * t * (3 - 2 * t);
}

static Body body_wanted(const SplatScene *scene, size_t i, bool flat)
{
    Body body = {0};
    double mean[3] = {0};
    const double sum = weighted_mean(scene, i, mean, &body.crowd), pi = acos(-1);
    const double drop = scene->state.spacing * (flat ? sqrt(1 / pi) : cbrt(3 / (4 * pi)));
    const double share = share_of(scene, body.crowd - 1, flat),
                 alone = splat_def(&scene->def)->drops ? drop : scene->frame.radii.drawn;
    covariance(scene, i, mean, sum, body.axes);
    round_off(body.axes, share, flat);
    body.crowd -= 1;
    body.radius = alone + share * (scene->frame.radii.drawn - alone);
    for (int k = 0; k < 3; k++)
        body.centre[k] = scene->particles->position[4 * i + (size_t)k] +
                         0.5 * share * scene->state.support_radius * mean[k];
    return body;
}

/* A read back: symmetric, in the box's frame. */
static void inverse_of(const float shape[12], double a[3][3])
{
    static const int at[9] = {4, 8, 9, 8, 5, 10, 9, 10, 6};
    for (int k = 0; k < 9; k++)
        a[k / 3][k % 3] = shape[at[k]];
}

/* A and the axes wanted are inverses of each other, A's determinant is 1, no axis is shorter than said. */
static void compare(const SplatScene *scene, size_t i, bool flat)
{
    const Body wanted = body_wanted(scene, i, flat);
    const float *shape = &splat_shapes[12 * i];
    double a[3][3], unit[3][3];
    inverse_of(shape, a);
    for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
            unit[k][l] = dot3(a[k], wanted.axes[l]);
            if (!(fabs(unit[k][l] - (k == l)) < 4e-4))
                fail_msg("particle %zu, weights %g: A times axes %d %d is %g", i, wanted.crowd, k, l,
                         unit[k][l]);
        }
        if (!(fabs(shape[k] - wanted.centre[k]) <
              2e-5 * scene->state.spacing + 1e-7 * fabs(wanted.centre[k])))
            fail_msg("particle %zu: centre %d at %.9g m, formula %.9g", i, k, shape[k], wanted.centre[k]);
    }
    assert_true(fabs(shape[3] / wanted.radius - 1) < 1e-5);
    assert_true(fabs(determinant(a) - 1) < 1e-4);
}

static void shape_all(SplatScene *scene)
{
    splat_def(&scene->def)->shape = SPLAT_ELLIPSOID;
    free(splat_drawn(scene));
}

static SplatScene in_a_box(double spacing)
{
    SplatScene scene = splat_scene((double[]){0, 0.5, 5}, (double[]){0, 0.5, 0}, 30, spacing);
    scene.width = scene.height = 8;
    splat_def(&scene.def)->drops = true;
    return scene;
}

/* Dense and sparse, inside and outside the box, on cell borders, and coincident. */
static void scatter(Particles *particles)
{
    for (int i = 0; i < 1200; i++)
        particles_add(particles, 0.5 + 0.7 * sin(12.9898 * i), 0.3 + 0.4 * sin(78.233 * i),
                      0.2 + 0.5 * sin(37.719 * i), 1, 0);
    for (int i = 0; i < 30; i++) /* outside, where the grid ends */
        particles_add(particles, 1.1 + 0.3 * sin(12.9 * i), 1.1 + 0.2 * sin(78.2 * i),
                      0.6 + 0.1 * sin(37.7 * i), 1, 0);
    for (int i = 0; i < 20; i++)
        particles_add(particles, -1 + 0.21 * i, 0.85, -0.35, 1, 0);
    for (int i = 0; i < 8; i++)
        particles_add(particles, -0.9, 0.9, 0.4, 1, 0);
}

static void sums_over_all_pairs(void **state)
{
    (void)state;
    SplatScene scene = in_a_box(0.1);
    scatter(scene.particles);
    const size_t finite = scene.particles->count;
    particles_add(scene.particles, NAN, 0.3, 0.2, 1, 0);
    particles_add(scene.particles, 0.4, INFINITY, 0.2, 1, 0);
    shape_all(&scene);
    for (size_t i = 0; i < finite; i++)
        compare(&scene, i, false);
    free(scene.particles);
}

/* A separate shader ends the sums early. */
static void radii_of_drops(void **state)
{
    (void)state;
    SplatScene scene = in_a_box(0.1);
    scatter(scene.particles);
    free(splat_drawn(&scene));
    int small = 0;
    for (size_t i = 0; i < scene.particles->count; i++) {
        const Body wanted = body_wanted(&scene, i, false);
        small += wanted.radius < 0.09;
        if (!(fabs(splat_shapes[i] / wanted.radius - 1) < 1e-5))
            fail_msg("particle %zu, weights %g: radius %g m, formula %g", i, wanted.crowd, splat_shapes[i],
                     wanted.radius);
    }
    assert_true(small > 20);
    free(scene.particles);
}

static void few_particles_in_a_vast_box(void **state)
{
    (void)state; /* cells wider than h */
    SplatScene scene = in_a_box(0.01);
    scene.state.box_size[0] = 300, scene.state.box_size[1] = 200, scene.state.box_size[2] = 300;
    for (int i = 0; i < 60; i++)
        particles_add(scene.particles, 140 + 0.02 * sin(12.9 * i), 0.02 + 0.02 * sin(78.2 * i),
                      0.02 * sin(37.7 * i), 1, 0);
    shape_all(&scene);
    for (size_t i = 0; i < scene.particles->count; i += 7)
        compare(&scene, i, false);
    free(scene.particles);
}

static void in_two_dimensions(void **state)
{
    (void)state;
    SplatScene scene = in_a_box(0.1);
    scene.state.box_size[2] = 0.1;
    for (int i = 0; i < 300; i++)
        particles_add(scene.particles, 0.9 * sin(12.9898 * i), 0.5 + 0.5 * sin(78.233 * i), 0, 1, 0);
    particles_add(scene.particles, -5, 0.4, 0, 1, 0); /* alone */
    shape_all(&scene);
    for (size_t i = 0; i < scene.particles->count; i++) {
        const float *shape = &splat_shapes[12 * i];
        compare(&scene, i, true);
        assert_true(fabsf(shape[6] - 1) < 1e-4F && shape[9] == 0 && shape[10] == 0); /* as deep as wide */
    }
    free(scene.particles);
}

/* Of the axes of a symmetric matrix A of determinant 1, the shortest's direction: the eigenvector of A's
   largest eigenvalue, by iteration; the length in `length`. */
static void shortest_axis(double a[3][3], double axis[3], double *length)
{
    memcpy(axis, (double[]){0.31, 0.53, 0.79}, 3 * sizeof *axis);
    for (int i = 0; i < 200; i++) {
        double next[3];
        multiply3(a, axis, next);
        *length = sqrt(dot3(axis, axis) / dot3(next, next));
        for (int k = 0; k < 3; k++)
            axis[k] = next[k] / sqrt(dot3(next, next));
    }
}

/* A lattice of nx x ny x nz turned by some angles, around (0, 0.5, 0). */
static void add_lattice(SplatScene *scene, int nx, int ny, int nz)
{
    const double s = scene->state.spacing;
    for (int i = 0; i < nx * ny * nz; i++) {
        const int column = i % nx, row = i / nx % ny, layer = i / (nx * ny);
        const double x = s * (column - (nx - 1) / 2.0), y = s * (row - (ny - 1) / 2.0),
                     z = s * (layer - (nz - 1) / 2.0);
        particles_add(scene->particles, 0.8 * x - 0.6 * y, 0.5 + 0.6 * x + 0.8 * y, z, 1, 0);
    }
}

static const float *middle_of(SplatScene *scene, int nx, int ny, int nz, double a[3][3])
{
    add_lattice(scene, nx, ny, nz);
    shape_all(scene);
    const float *shape = &splat_shapes[12 * (scene->particles->count / 2)];
    inverse_of(shape, a);
    assert_true(fabs(determinant(a) - 1) < 1e-4);
    free(scene->particles);
    return shape;
}

static void a_sheet_gives_discs(void **state)
{
    (void)state; /* across (-0.6, 0.8, 0) */
    double a[3][3], axis[3], length;
    SplatScene scene = in_a_box(0.05);
    const float *shape = middle_of(&scene, 9, 1, 9, a);
    shortest_axis(a, axis, &length);
    const double turn = acos(fmin(fabs(-0.6 * axis[0] + 0.8 * axis[1]), 1)) * 180 / acos(-1);
    if (!(turn < 1 && length < 0.5 && shape[7] <= length && shape[7] > 0.85 * length))
        fail_msg("%g degrees from the sheet's normal, half as thick as %g radii, said to be at least %g",
                 turn, length, shape[7]);
}

static void a_line_gives_needles(void **state)
{
    (void)state; /* along (0.8, 0.6, 0) */
    double a[3][3], along[3];
    SplatScene scene = in_a_box(0.05);
    middle_of(&scene, 9, 1, 1, a);
    multiply3(a, (double[]){0.8, 0.6, 0}, along);
    assert_true(fabs(along[0] / 0.8 - along[1] / 0.6) < 1e-4 && fabs(along[2]) < 1e-4);
    if (!(along[0] / 0.8 < 1 / 1.5 && along[0] / 0.8 > 1 / ELLIPSOID_REACH))
        fail_msg("a line's needle is %g radii long", 0.8 / along[0]);
}

static void the_bulk_gives_balls(void **state)
{
    (void)state;
    double a[3][3];
    SplatScene scene = in_a_box(0.05);
    const float *shape = middle_of(&scene, 7, 7, 7, a);
    for (int k = 0; k < 9; k++)
        assert_true(fabs(a[k / 3][k % 3] - (k % 4 == 0)) < 1e-3);
    assert_true(fabsf(shape[3] / 0.05F - 1) < 1e-4F && shape[7] > 0.85F && shape[7] <= 1);
}

/* A fluid that collapsed ends a picture in time, and with shapes that are numbers. */
static void all_in_one_place(void **state)
{
    (void)state;
    SplatScene scene = in_a_box(0.05);
    for (int i = 0; i < PARTICLES_MAX; i++)
        particles_add(scene.particles, 0.3, 0.4, 0.1 + 1e-9 * i, 1, 0);
    shape_all(&scene);
    for (size_t i = 0; i < 12 * scene.particles->count; i++)
        assert_true(isfinite(splat_shapes[i]));
    free(scene.particles);
}

/* A sheet of many in few places is as thin, a line as long as it gets. */
static void none_reaches_farther_than_said(void **state)
{
    (void)state;
    double a[3][3], along[3];
    SplatScene scene = in_a_box(0.05);
    for (int i = 0; i < 10; i++)
        for (int k = -1; k < 2; k++)
            particles_add(scene.particles, 0.04 * k, 0.5, 0, 1, 0);
    shape_all(&scene);
    inverse_of(splat_shapes, a);
    multiply3(a, (double[]){1, 0, 0}, along);
    assert_true(along[0] > 1 / ELLIPSOID_REACH && along[0] < 1.1 / ELLIPSOID_REACH);
    free(scene.particles);
}

/* Where particles are poured in, not every picture makes all buffers anew. */
static void room_grows_ahead(void **state)
{
    (void)state;
    Error error = {0};
    SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 20, 0.05);
    Neighbourhood near;
    Frame frame = {.def = &scene.def, .radii.drawn = 0.05F, .neighbourhood = &near};
    Ellipsoids drops;
    ParticleBuffers buffers;
    size_t capacity = 0;
    int changes = 0;
    splat_def(&scene.def)->drops = true;
    for (int i = 0; i < 200; i++)
        particles_add(scene.particles, 0.004 * i, 0.5, 0, 1, 0);
    scene.state.count = scene.particles->count;
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    assert_true(ellipsoids_create(&drops, splat_def(&scene.def), &error));
    assert_true(neighbourhood_create(&near, &error));
    for (buffers.count = 100; buffers.count <= 200; buffers.count++) {
        ellipsoids_make(&drops, &buffers, &frame);
        assert_true(drops.capacity >= buffers.count && near.capacity >= buffers.count);
        assert_true(buffers.count > 100 || drops.capacity == 100); /* no more where none is added */
        changes += drops.capacity + near.capacity != capacity;
        capacity = drops.capacity + near.capacity;
    }
    assert_int_equal(changes, 3); /* 100, 150, 225 */
    ellipsoids_destroy(&drops);
    neighbourhood_destroy(&near);
    upload_destroy(upload);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(sums_over_all_pairs, no_gl_errors),
        cmocka_unit_test_teardown(radii_of_drops, no_gl_errors),
        cmocka_unit_test_teardown(few_particles_in_a_vast_box, no_gl_errors),
        cmocka_unit_test_teardown(in_two_dimensions, no_gl_errors),
        cmocka_unit_test_teardown(all_in_one_place, no_gl_errors),
        cmocka_unit_test_teardown(a_sheet_gives_discs, no_gl_errors),
        cmocka_unit_test_teardown(a_line_gives_needles, no_gl_errors),
        cmocka_unit_test_teardown(the_bulk_gives_balls, no_gl_errors),
        cmocka_unit_test_teardown(none_reaches_farther_than_said, no_gl_errors),
        cmocka_unit_test_teardown(room_grows_ahead, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
