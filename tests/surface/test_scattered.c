/* Surfaces through scattered points: a sphere and a box of known size. */
#include "fixture.h"

#include "sim/points/scattered.h"

enum { POINTS = 4000 };

static float place[POINTS][3], normal[POINTS][3];

/* Along a spiral, evenly: R. Swinbank, R. J. Purser, "Fibonacci grids", 2006. */
static ScatteredPoints sphere(size_t count, double radius, double length)
{
    for (size_t i = 0; i < count; i++) {
        const double z = 1 - (2 * (double)i + 1) / (double)count, r = sqrt(1 - z * z),
                     phi = 2.399963 * (double)i;
        const double n[3] = {r * cos(phi), r * sin(phi), z};
        for (int k = 0; k < 3; k++) {
            normal[i][k] = (float)(length * n[k]);
            place[i][k] = (float)(radius * n[k] + 0.1 * k);
        }
    }
    return (ScatteredPoints){count, (const float(*)[3])place, (const float(*)[3])normal};
}

static float value_at(const VolumeData *volume, const double at[3])
{
    LevelField field;
    LevelSample sample;
    Error error = {{0}};
    assert_true(level_volume(volume, VOLUME_TRILINEAR, &field, &error));
    level_at(&field, at, &sample);
    return sample.value;
}

/* Where the value is 0.5 from the middle outwards in a direction. */
static double radius_along(const VolumeData *volume, const double way[3], double most)
{
    double low = 0, high = most;
    for (int i = 0; i < 30; i++) {
        const double r = (low + high) / 2, at[3] = {r * way[0], 0.1 + r * way[1], 0.2 + r * way[2]};
        if (value_at(volume, at) > 0.5F)
            low = r;
        else
            high = r;
    }
    return low;
}

/* Few points and many; whatever the lengths of normals. */
static void a_sphere_has_its_radius(void **state)
{
    (void)state;
    static const size_t counts[] = {200, POINTS};
    for (int c = 0; c < 2; c++) {
        const ScatteredPoints points = sphere(counts[c], 0.3, c ? 1 : 20);
        VolumeData volume;
        float *values;
        Error error = {{0}};
        if (!scattered_volume(&points, &volume, &values, &error))
            fail_msg("%s", error.message);
        for (int i = 0; i < 20; i++) {
            const double z = cos(0.7 * i), r = sqrt(1 - z * z), way[3] = {r * cos(i), z, r * sin(i)};
            const double found = radius_along(&volume, way, 0.4);
            if (fabs(found - 0.3) > (c ? 0.003 : 0.015))
                fail_msg("%zu points: radius %g, not 0.3", counts[c], found);
        }
        assert_true(value_at(&volume, (double[]){0, 0.1, 0.2}) > 0.95F);
        for (int k = 0; k < 8; k++) { /* outside in all corners */
            double at[3];
            for (int a = 0; a < 3; a++)
                at[a] = volume.corner[a] + (k >> a & 1) * (volume.size[a] - 1) * volume.spacing[a];
            assert_float_equal(value_at(&volume, at), 0, 1e-6);
        }
        free(values);
    }
}

static void what_is_no_surface_is_refused(void **state)
{
    (void)state;
    VolumeData volume;
    float *values;
    Error error = {{0}};
    ScatteredPoints points = sphere(10, 0.3, 1);
    points.count = 2;
    assert_false(scattered_volume(&points, &volume, &values, &error));
    assert_string_equal(error.message, "2 points make no surface; at least three at different places do");
    points = sphere(10, 0, 1);
    assert_false(scattered_volume(&points, &volume, &values, &error));
    points = sphere(10, 0.3, 1);
    normal[7][1] = NAN;
    assert_false(scattered_volume(&points, &volume, &values, &error));
    assert_string_equal(error.message, "point 7 has no finite place and normal");
    assert_null(values);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_has_its_radius),
        cmocka_unit_test(what_is_no_surface_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
