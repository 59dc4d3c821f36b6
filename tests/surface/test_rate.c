/* Points a second of each sampler on each kind of field, and evenness of large sets. Few points under
   ctest, as a smoke test. For figures SLOSH_POINTS=1e7 build/release/tests/test_surface rate on a quiet
   machine: by the clock, and by processor time, times two. */
#include "fixture.h"

#include "sim/points/points.h"
#include "sim/world.h"

#include <stdio.h>
#include <time.h>

enum { SIDE = 64 };

static double points_asked(void)
{
    const char *text = getenv("SLOSH_POINTS");
    return text ? fmin(fmax(atof(text), 1e4), 5e7) : 2e4;
}

/* Returns the worst of 100 patches; 0 without them. */
static double measure(const char *name, SurfaceRequest *request, Patch *patch)
{
    SurfacePoints points = {0};
    const double began = wall_ms(), worked = (double)clock();
    const SurfaceResult result = sample(request, &points);
    const double wall = 1e-3 * (wall_ms() - began), busy = ((double)clock() - worked) / CLOCKS_PER_SEC;
    const double worst = patch ? evenness(points.point, points.count, 1, patch, 10).worst : 0;
    const double count = (double)points.count;
    printf("%-12s %-10s %9.0f points  %8.3g/s  two processors %8.3g/s", name,
           surface_sampler_name(request->sampler), count, count / wall, 2 * count / busy);
    if (patch)
        printf("  worst patch %.1f %%", 100 * worst);
    printf("\n");
    assert_true(result.reached && points.count > 0);
    surface_points_free(&points);
    return worst;
}

static void analytic_fields(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, points = points_asked();
    const LevelField fields[] = {level_sphere(origin, 0.5),
                                 level_torus(origin, 1e-3 * RING_MM, 1e-3 * TUBE_MM),
                                 level_gyroid(low, high, 0.5), level_wave(low, high, 0, 0.1, 0.5)};
    static const char *const names[] = {"sphere", "torus", "gyroid", "wave"};
    const double area[] = {M_PI, 4e-6 * M_PI * M_PI * RING_MM * TUBE_MM, 6.2, 1.5};
    Patch *const patches[] = {sphere_patch, torus_patch, NULL, NULL};
    for (int i = 0; i < 4; i++) {
        SurfaceRequest request = request_for(&fields[i], area[i], points);
        request.step = i == 1 ? 0.03 : 0;
        const double worst = measure(names[i], &request, patches[i]);
        if (points >= 1e7)
            check_near(worst, 0, 0.03, "the worst of 100 patches");
        request.sampler = SURFACE_TRIANGLES;
        measure(names[i], &request, patches[i]);
    }
}

static void volumes(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    const LevelField gyroid = level_gyroid(low, high, 0.5);
    float *value = malloc(sizeof(float) * SIDE * SIDE * SIDE);
    assert_non_null(value);
    const double cell = 1.0 / (SIDE - 1);
    const VolumeData volume = {{SIDE, SIDE, SIDE}, {-0.5, -0.5, -0.5}, {cell, cell, cell}, value};
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        const int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
        LevelSample s;
        level_at(&gyroid, (double[]){-0.5 + cell * x, -0.5 + cell * y, -0.5 + cell * z}, &s);
        value[i] = s.value;
    }
    for (VolumeInterpolation way = 0; way < VOLUME_INTERPOLATIONS; way++) {
        LevelField field;
        assert_true(level_volume(&volume, way, &field, NULL));
        SurfaceRequest request = request_for(&field, 6.2, points_asked());
        measure(volume_interpolation_name(way), &request, NULL);
    }
    free(value);
}

/* Particles on a lattice in a ball. */
static void particles(void **state)
{
    (void)state;
    enum { ALONG = 20 };
    float *position = malloc(sizeof(float) * 4 * ALONG * ALONG * ALONG);
    assert_non_null(position);
    FieldParticles all = {.position = position, .support = 0.105};
    for (int i = 0; i < ALONG * ALONG * ALONG; i++) {
        const int x = i % ALONG - 10, y = i / ALONG % ALONG - 10, z = i / ALONG / ALONG - 10;
        const float p[3] = {0.05F * (float)x, 0.05F * (float)y, 0.05F * (float)z};
        float *to = position + 4 * all.count;
        memcpy(to, p, sizeof p);
        to[3] = 1.25e-4F;
        all.count += p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < 0.2F;
    }
    SphField *sph = sph_field_create(&all, NULL);
    assert_non_null(sph);
    const LevelField field = level_sph(sph);
    SurfaceRequest request = request_for(&field, 2.5, 0.1 * points_asked());
    request.level = 0.5;
    measure("particles", &request, NULL);
    sph_field_destroy(sph);
    free(position);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(analytic_fields),
        cmocka_unit_test(volumes),
        cmocka_unit_test(particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
