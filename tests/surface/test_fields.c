/* Fields against references: slopes and bends against differences, volumes against sources, the
   particles' field against the sum over all. */
#include "fixture.h"

#include "sim/base/formula.h"
#include "sim/points/points.h"

static const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};

static LevelSample at(const LevelField *field, const double p[3])
{
    LevelSample s;
    level_at(field, p, &s);
    return s;
}

/* Tr(H P) by central differences of gradients. */
static double bend_by_differences(const LevelField *field, const double p[3], double step)
{
    const LevelSample s = at(field, p);
    double square = 0, bend = 0;
    for (int k = 0; k < 3; k++)
        square += (double)(s.gradient[k] * s.gradient[k]);
    for (int k = 0; k < 3; k++) {
        double a[3] = {p[0], p[1], p[2]}, b[3] = {p[0], p[1], p[2]};
        a[k] -= step;
        b[k] += step;
        const LevelSample before = at(field, a), after = at(field, b);
        for (int l = 0; l < 3; l++)
            bend += (double)(after.gradient[l] - before.gradient[l]) / (2 * step) *
                    ((k == l) - (double)(s.gradient[k] * s.gradient[l]) / square);
    }
    return bend;
}

/* At places well inside cells of so many m; NULL: anywhere. */
static void check_derivatives(const LevelField *field, const char *what, double step, double scale,
                              const double *cell)
{
    for (int i = 0; i < 40; i++) {
        double p[3] = {0.4 * sin(1.0 + 7 * i), 0.4 * sin(2.0 + 11 * i), 0.4 * sin(3.0 + 13 * i)};
        for (int k = 0; k < 3 && cell; k++)
            p[k] = field->low[k] + (floor((p[k] - field->low[k]) / cell[k]) + 0.5) * cell[k] +
                   0.1 * cell[k] * sin(i + k);
        const LevelSample s = at(field, p);
        for (int k = 0; k < 3; k++) {
            double a[3] = {p[0], p[1], p[2]}, b[3] = {p[0], p[1], p[2]};
            a[k] -= step;
            b[k] += step;
            const double slope = (double)(at(field, b).value - at(field, a).value) / (2 * step);
            check_near((double)s.gradient[k], slope, 2e-3 * scale, what);
        }
        check_near((double)s.bend / (10 * scale), bend_by_differences(field, p, step) / (10 * scale), 1e-2,
                   what);
    }
}

static void derivatives_are_those_of_the_value(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere((double[]){0.03, 0.6, 0}, 0.5),
                     torus = level_torus((double[]){0, 0.9, 0}, 0.35, 0.15);
    const LevelField gyroid = level_gyroid(low, high, 1), wave = level_wave(low, high, 0, 0.1, 0.8);
    const LevelField plane = level_plane(low, high, origin, (double[]){1, -2, 3});
    check_derivatives(&sphere, "sphere", 1e-3, 1, NULL);
    check_derivatives(&torus, "torus", 1e-3, 1, NULL);
    check_derivatives(&gyroid, "gyroid", 1e-3, 2 * M_PI, NULL);
    check_derivatives(&wave, "wave", 1e-3, 1, NULL);
    check_derivatives(&plane, "plane", 1e-3, 1, NULL);
}

/* Second derivatives are the differences of first ones, in double precision. */
static void check_bends(const Formula *formula, const double p[3], const char *text)
{
    static const int number[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; /* xx yy zz xy yz zx */
    const double step = 1e-5;
    FormulaJet here;
    formula_jet(formula, p, &here);
    for (int k = 0; k < 3; k++) {
        double a[3] = {p[0], p[1], p[2]}, b[3] = {p[0], p[1], p[2]};
        FormulaJet before, after;
        a[k] -= step;
        b[k] += step;
        formula_jet(formula, a, &before);
        formula_jet(formula, b, &after);
        for (int j = 0; j < 3; j++) {
            const double bend = (after.slope[j] - before.slope[j]) / (2 * step);
            check_near(here.bend[number[k][j]], bend, 1e-5 * (1 + fabs(bend)), text);
        }
    }
}

/* Each operator and function once, of each place. */
static void formulas_have_exact_derivatives(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x*y - 2*z + sin(3*x)*cos(y)/(2 + z) - exp(x/2)^z",
        "tan(x) + log(2 + y) + sqrt(1 + z^2) - abs(5 - x*z)",
        "tanh(x*y) + sinh(y + z) - cosh(z)*x + (2 + x)^3 + (2 + y)^-1.5 - 2^x",
        "max(x + 9, y) * min(z, 9 - x)",
        "-x^2 + x^1*3 + y^0 + 4/(z - 3)",
    };
    Error error = {{0}};
    for (int i = 0; i < 5; i++) {
        Formula formula;
        if (!formula_read(texts[i], "xyz", &formula, &error))
            fail_msg("%s", error.message);
        const LevelField field = level_formula(&formula, low, high);
        check_derivatives(&field, texts[i], 1e-3, 5, NULL);
        for (int k = 0; k < 20; k++) {
            const double p[3] = {0.4 * sin(1.0 + 7 * k), 0.4 * sin(2.0 + 11 * k), 0.4 * sin(3.0 + 13 * k)};
            const double from[3] = {(double)(float)p[0], (double)(float)p[1], (double)(float)p[2]};
            check_near((double)at(&field, p).value, formula_value(&formula, from), 1e-5, texts[i]);
            check_bends(&formula, p, texts[i]);
        }
    }
}

enum { SIDE = 24 };

/* A gyroid on a grid whose axes are of different sizes. */
static VolumeData gyroid_volume(float value[SIDE * (SIDE + 1) * (SIDE + 2)])
{
    VolumeData volume = {.size = {SIDE, SIDE + 1, SIDE + 2}, .value = value};
    for (int k = 0; k < 3; k++) {
        volume.corner[k] = -0.5;
        volume.spacing[k] = 1.0 / (volume.size[k] - 1);
    }
    const LevelField gyroid = level_gyroid(low, high, 1);
    for (int i = 0; i < SIDE * (SIDE + 1) * (SIDE + 2); i++) {
        const int index[3] = {i % SIDE, i / SIDE % (SIDE + 1), i / SIDE / (SIDE + 1)};
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = -0.5 + index[k] * volume.spacing[k];
        value[i] = at(&gyroid, p).value;
    }
    return volume;
}

static void volumes_interpolate_their_values(void **state)
{
    (void)state;
    static float value[SIDE * (SIDE + 1) * (SIDE + 2)];
    const VolumeData volume = gyroid_volume(value);
    const LevelField gyroid = level_gyroid(low, high, 1);
    const double off[VOLUME_INTERPOLATIONS] = {3e-2, 2e-3}; /* second and third order in a cell of 1 / 23 */
    for (VolumeInterpolation way = 0; way < VOLUME_INTERPOLATIONS; way++) {
        LevelField field;
        Error error = {{0}};
        assert_true(level_volume(&volume, way, &field, &error));
        check_near(field.step, 0.3 / (SIDE + 1), 1e-12, "step");
        for (int i = 0; i < 60; i++) {
            const double p[3] = {0.45 * sin(1.0 + 7 * i), 0.45 * sin(2.0 + 11 * i), 0.45 * sin(3.0 + 13 * i)};
            check_near((double)at(&field, p).value, (double)at(&gyroid, p).value, off[way],
                       volume_interpolation_name(way));
        }
        for (int i = 0; i < SIDE; i++) /* through the values, to the border */
            check_near((double)at(&field, (double[]){-0.5 + i * volume.spacing[0], -0.5, 0.5}).value,
                       (double)at(&gyroid, (double[]){-0.5 + i * volume.spacing[0], -0.5, 0.5}).value, 1e-5,
                       "a value");
        check_derivatives(&field, volume_interpolation_name(way), 2e-3, 2 * M_PI, volume.spacing);
        const LevelSample beyond = at(&field, (double[]){1e3, -1e3, 0});
        assert_true(isfinite(beyond.value));
    }
    assert_null(volume_interpolation_name(VOLUME_INTERPOLATIONS));
}

/* Points on a level of a volume: on the interpolated field, and about as many as on what it interpolates. */
static void volumes_are_walked(void **state)
{
    (void)state;
    static float value[SIDE * (SIDE + 1) * (SIDE + 2)];
    const VolumeData volume = gyroid_volume(value);
    for (VolumeInterpolation way = 0; way < VOLUME_INTERPOLATIONS; way++) {
        LevelField field;
        SurfacePoints points = {0};
        assert_true(level_volume(&volume, way, &field, NULL));
        const SurfaceRequest request = request_for(&field, 3.09, 1e5);
        const SurfaceResult result = sample(&request, &points);
        check_near(result.area, 3.09, 0.045,
                   "area of a cell of the gyroid"); /* Schoen 1970: 3.0915; 10,000 crossings */
        for (size_t i = 0; i < points.count; i += 5) {
            const float *p = points.point[i].position;
            const LevelSample s = at(&field, (double[]){(double)p[0], (double)p[1], (double)p[2]});
            const float *g = s.gradient;
            check_near((double)s.value / sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])), 0, 2e-5,
                       "distance");
        }
        surface_points_free(&points);
    }
}

/* Each axis is looked at by its own spacing: a billion times as many places along the others would never end.
 */
static void volumes_as_flat_as_may_be_are_walked(void **state)
{
    (void)state;
    const float value[8] = {0, 1, 0, 1, 0, 1, 0, 1};
    const VolumeData volume = {{2, 2, 2}, {0, 0, 0}, {1e-9, 1, 1}, value};
    LevelField field;
    SurfacePoints points = {0};
    assert_true(level_volume(&volume, VOLUME_TRILINEAR, &field, NULL));
    SurfaceRequest request = request_for(&field, 1, 2e4);
    request.level = 0.5;
    const SurfaceResult result = sample(&request, &points);
    check_near(result.area, 1, 0.02, "area");
    check_near((double)points.count / 2e4, 1, 0.05, "points");
    for (size_t i = 0; i < points.count; i += 5)
        check_near(1e9 * (double)points.point[i].position[0], 0.5, 0.01, "height");
    surface_points_free(&points);
}

static void volumes_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    float value[8] = {0, 1, 2, NAN, 4, 5, INFINITY, 7};
    VolumeData volume = {{2, 2, 2}, {0, 0, 0}, {1, 1, 1}, value};
    LevelField field;
    Error error = {{0}};
    assert_false(level_volume(&volume, VOLUME_TRILINEAR, &field, &error));
    assert_string_equal(error.message, "2 values of the volume are no number, the first at [1, 1, 0]");
    volume.size[2] = 1;
    assert_false(level_volume(&volume, VOLUME_TRILINEAR, &field, &error));
    assert_string_equal(error.message, "the volume has 1 value along z; it needs 2 or more");
    volume.size[2] = 2;
    volume.spacing[0] = 0;
    assert_false(level_volume(&volume, VOLUME_TRILINEAR, &field, &error));
    assert_non_null(strstr(error.message, "along x are 0 m apart"));
}

/* A lattice that is out of order, in a ball, with a scalar; and particles that are none. */
enum { PARTICLES = 3000 };
static float position[4 * PARTICLES], scalar[PARTICLES];

static FieldParticles ball_of_particles(void)
{
    FieldParticles particles = {0, position, scalar, 0.105};
    for (int i = 0; particles.count < PARTICLES && i < 20 * 20 * 20; i++) {
        const int x = i % 20, y = i / 20 % 20, z = i / 400;
        const double p[3] = {(x - 9.5) * 0.05 + 0.01 * sin(i), (y - 9.5) * 0.05 + 0.01 * sin(3.0 * i),
                             (z - 9.5) * 0.05 + 0.01 * sin(5.0 * i)};
        if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 0.16)
            continue;
        float *to = position + 4 * particles.count;
        for (int k = 0; k < 3; k++)
            to[k] = (float)p[k];
        to[3] = 1.25e-4F;
        scalar[particles.count++] = (float)(2 + p[1]);
    }
    position[4] = NAN;
    scalar[7] = INFINITY;
    return particles;
}

static void the_particles_field_is_the_sum_over_all(void **state)
{
    (void)state;
    const FieldParticles particles = ball_of_particles();
    Error error = {{0}};
    SphField *sph = sph_field_create(&particles, &error);
    assert_non_null(sph);
    const LevelField field = level_sph(sph), value = level_sph_scalar(sph);
    for (int i = 0; i < 300; i++) {
        const double p[3] = {0.5 * sin(1.0 + 7 * i), 0.5 * sin(2.0 + 11 * i), 0.5 * sin(3.0 + 13 * i)};
        double weighted;
        const double right = field_at(&particles, p, &weighted);
        check_near((double)at(&field, p).value, right, 2e-6, "F");
        check_near((double)at(&value, p).value, right > 0 ? weighted / right : 0, right > 1e-4 ? 1e-4 : 3,
                   "the scalar");
    }
    for (int i = 0; i < 20; i++) { /* inside, where there is curvature enough */
        const double p[3] = {0.25 * sin(1.0 + 7 * i), 0.25 * sin(2.0 + 11 * i), 0.25 * sin(3.0 + 13 * i)};
        const double step = 1e-3;
        check_near((double)at(&field, p).bend / 100, bend_by_differences(&field, p, step) / 100, 0.02,
                   "bend of F");
        check_near((double)at(&value, p).bend / 100, bend_by_differences(&value, p, step) / 100, 0.02,
                   "bend of s");
    }
    const LevelSample far = at(&field, (double[]){50, -50, 1});
    assert_true(far.value == 0);
    sph_field_destroy(sph);
    sph_field_destroy(NULL);
    assert_null(sph_field_create(&(FieldParticles){0, position, NULL, 0.1}, &error));
    assert_string_equal(error.message, "there is no particle to make a field of");
}

/* The same field on a grid, as a view has it: interpolated, near the sum over all and with about its area. */
static void the_particles_field_on_a_grid_is_walked(void **state)
{
    (void)state;
    enum { CELLS = 40 };
    static float value[CELLS * CELLS * CELLS];
    const FieldParticles particles = ball_of_particles();
    const VolumeGrid grid = {{CELLS, CELLS, CELLS}, {-0.56, -0.52, -0.52}, 1.04 / CELLS};
    const double off[VOLUME_INTERPOLATIONS] = {0.2, 0.05}; /* cells; they are a quarter of h wide */
    FieldSlabs slabs = {0};
    Error error;
    assert_true(field_sum(&particles, &grid, 2, &slabs, value, NULL, &error));
    field_slabs_free(&slabs);
    const VolumeData volume = volume_of_grid(&grid, value);
    for (VolumeInterpolation way = 0; way < VOLUME_INTERPOLATIONS; way++) {
        LevelField field;
        SurfacePoints points = {0};
        assert_true(level_volume(&volume, way, &field, &error));
        SurfaceRequest request = request_for(&field, 2, 2e4);
        request.level = 0.5;
        const SurfaceResult result = sample(&request, &points);
        double squares = 0, count = 0;
        for (size_t i = 0; i < points.count; i += 20, count++) {
            const float *p = points.point[i].position;
            const double place[3] = {(double)p[0], (double)p[1], (double)p[2]};
            const LevelSample s = at(&field, place);
            const float *g = s.gradient;
            const double slope = sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]));
            squares += pow((field_at(&particles, place, NULL) - 0.5) / slope, 2);
            check_near(((double)s.value - 0.5) / slope, 0, 2e-5, "distance from what is interpolated");
        }
        check_near(sqrt(squares / count) / grid.cell, 0, off[way], volume_interpolation_name(way));
        check_near(result.area / (4 * M_PI * 0.41 * 0.41), 1, 0.15, "area of a bumpy ball");
        surface_points_free(&points);
    }
}

/* The fluid's surface, and a level of a scalar inside it, coloured by the other. */
static void the_particles_field_is_walked(void **state)
{
    (void)state;
    const FieldParticles particles = ball_of_particles();
    SphField *sph = sph_field_create(&particles, NULL);
    assert_non_null(sph);
    const LevelField field = level_sph(sph), value = level_sph_scalar(sph);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&field, 2, 2e4);
    request.level = 0.5;
    request.colour = &value;
    const SurfaceResult result = sample(&request, &points);
    check_near(result.area / (4 * M_PI * 0.41 * 0.41), 1, 0.15, "area of a bumpy ball");
    for (size_t i = 0; i < points.count; i++) {
        const float *p = points.point[i].position;
        check_near(field_at(&particles, (double[]){(double)p[0], (double)p[1], (double)p[2]}, NULL), 0.5,
                   1e-3, "F");
        check_near((double)points.point[i].value, 2 + (double)p[1], 0.06, "colour");
        i += 20;
    }
    surface_points_free(&points);
    sph_field_destroy(sph);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_are_those_of_the_value),
        cmocka_unit_test(formulas_have_exact_derivatives),
        cmocka_unit_test(volumes_interpolate_their_values),
        cmocka_unit_test(volumes_are_walked),
        cmocka_unit_test(volumes_as_flat_as_may_be_are_walked),
        cmocka_unit_test(volumes_that_make_no_sense_are_refused),
        cmocka_unit_test(the_particles_field_is_the_sum_over_all),
        cmocka_unit_test(the_particles_field_on_a_grid_is_walked),
        cmocka_unit_test(the_particles_field_is_walked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
