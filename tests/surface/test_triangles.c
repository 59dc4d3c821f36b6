/* Points on the triangles of marching cubes: uniform, near the surface, not on what closes the mesh. */
#include "fixture.h"

#include "sim/points/points.h"

static SurfaceRequest on_triangles(const LevelField *field, double area, double points)
{
    SurfaceRequest request = request_for(field, area, points);
    request.sampler = SURFACE_TRIANGLES;
    return request;
}

static void triangles_get_points_by_area(void **state)
{
    (void)state;
    const LevelField field = level_sphere(origin, 0.5);
    SurfacePoints points = {0};
    const SurfaceRequest request = on_triangles(&field, M_PI, 1e6);
    const SurfaceResult result = sample(&request, &points);
    assert_true(result.reached);
    check_near(result.area / M_PI, 1, 2e-3, "area");
    const Evenness even = evenness(points.point, points.count, 1, sphere_patch, 10);
    check_near(even.worst, 0, 0.04, "the worst of 100 patches"); /* four standard errors */
    /* one set of twenty: independent, so its counts are binomial */
    const Evenness set = evenness(points.point, points.count, 20, sphere_patch, 60);
    check_near(set.chi_square, 3599, 3 * sqrt(2 * 3599.0), "chi-square of one set");
    for (size_t i = 0; i < points.count; i += 7) {
        const float *p = points.point[i].position, *c = p;
        float normal[3];
        const double r = sqrt((double)(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]));
        check_near(r, 0.5, 7e-4, "distance"); /* the longest edge^2 / 8 R */
        surface_normal_unpack(points.point[i].normal, normal);
        check_near((double)-(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]) / r, 1, 2e-3, "normal");
    }
    surface_points_free(&points);
}

static void an_open_surface_stays_open(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, up[3] = {1, 2, 3};
    const LevelField field = level_plane(low, high, origin, up);
    SurfacePoints points = {0};
    SurfaceRequest request = on_triangles(&field, 1, 1e4);
    const double area = sample(&request, &points).area;
    request.sampler = SURFACE_WALK;
    request.density *= 10;
    check_near(area / sample(&request, &points).area, 1, 0.03, "area");
    for (size_t i = 0; i < points.count; i++) {
        const float *p = points.point[i].position;
        assert_true(fabsf(p[0]) <= 0.50001F && fabsf(p[1]) <= 0.50001F && fabsf(p[2]) <= 0.50001F);
        check_near((double)(p[0] + 2 * p[1] + 3 * p[2]), 0, 1e-4, "on the plane");
    }
    surface_points_free(&points);
}

static void threads_make_no_difference(void **state)
{
    (void)state;
    const LevelField field = level_torus(origin, 0.3, 0.1);
    SurfacePoints points[2] = {0};
    SurfaceRequest request = on_triangles(&field, 1, 1e5);
    for (int k = 0; k < 2; k++) {
        request.threads = k + 1;
        sample(&request, &points[k]);
    }
    assert_int_equal(points[0].count, points[1].count);
    assert_memory_equal(points[0].point, points[1].point, points[0].count * sizeof *points[0].point);
    surface_points_free(&points[0]);
    surface_points_free(&points[1]);
}

/* Of a field at the finest resolution; and of a field with different axes, each scaled. */
static void cells_are_as_fine_as_memory_allows(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    const LevelField coarse = level_gyroid(low, high, 1), fine = level_gyroid(low, high, 1e-3);
    SurfaceRequest request = on_triangles(&coarse, 1, 1);
    const float value[8] = {0};
    const VolumeData volume = {{2, 2, 2}, {0, 0, 0}, {1e-9, 1, 1}, value};
    LevelField flat;
    int size[3];
    double cell[3];
    assert_true(triangles_grid(&request, 1, size, cell) == 1 && size[0] == 32 + 3);
    request.field = &fine;
    const double times = triangles_grid(&request, 1, size, cell),
                 values = (double)size[0] * size[1] * size[2];
    assert_true(times > 40 && values <= 0x1p28 && values > 0x1p28 / 1.4);
    check_near(cell[2] / (times * fine.march[2]), 1, 2e-3, "larger cells");
    request.cell = 1e-4; /* stays: errors name the user's file */
    assert_true(triangles_grid(&request, 1, size, cell) == 1 && size[0] == 10003);
    assert_true(level_volume(&volume, VOLUME_TRILINEAR, &flat, NULL));
    request = on_triangles(&flat, 1, 1);
    assert_true(triangles_grid(&request, 1, size, cell) == 1 && size[0] == 5 && size[1] == 5);
    assert_true(triangles_grid(&request, 2, size, cell) == 2 && size[0] == 5);
}

/* A grid that fits, most edges of which cross the level. */
static void a_mesh_too_large_is_refused(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    const LevelField gyroid = level_gyroid(low, high, 0.01);
    SurfaceRequest request = on_triangles(&gyroid, 1, 1000);
    Error error;
    request.cell = 0.0042;
    assert_non_null(strstr(refusal(&request, &error), " vertices; take larger ones"));
    const LevelField finest = level_gyroid(low, high, 1e-3);
    request = on_triangles(&finest, 1, 1000);
    assert_non_null(strstr(refusal(&request, &error), "would miss it; take the sampler walk"));
}

/* So thin that there is no point: said, and nothing is touched. */
static void too_thin_for_a_point(void **state)
{
    (void)state;
    const LevelField field = level_torus(origin, 0.3, 0.1);
    SurfacePoints points = {0};
    SurfaceResult result = {.reached = true};
    Error error;
    const SurfaceRequest request = on_triangles(&field, 1, 1e-7);
    assert_true(surface_sample(&request, &points, &result, &error));
    assert_int_equal(points.count, 0);
    assert_false(result.reached);
    check_near(result.area, 4 * M_PI * M_PI * 0.03, 0.01, "area");
    surface_points_free(&points);
}

/* A unit square in the plane y = 0.25, of triangles as unequal as 1 : 32: strips along x, each of two. */
enum { STRIPS = 6 };

static void make_strips(Polygons *strips)
{
    Error error;
    assert_true(polygons_reserve(strips, 2 * STRIPS + 2, 2 * STRIPS, &error));
    for (uint32_t i = 0; i <= STRIPS; i++)
        for (uint32_t k = 0; k < 2; k++) {
            const float x = (ldexpf(1, (int)i) - 1) / (ldexpf(1, STRIPS) - 1);
            const float place[3] = {x - 0.5F, 0.25F, (float)k - 0.5F}, up[3] = {0, 2, 0};
            memcpy(strips->place[2 * i + k], place, sizeof place);
            memcpy(strips->normal[2 * i + k], up, sizeof up);
        }
    for (uint32_t i = 0; i < STRIPS; i++) {
        memcpy(strips->corner[2 * i], (uint32_t[3]){2 * i, 2 * i + 1, 2 * i + 2}, 3 * sizeof(uint32_t));
        memcpy(strips->corner[2 * i + 1], (uint32_t[3]){2 * i + 1, 2 * i + 3, 2 * i + 2},
               3 * sizeof(uint32_t));
    }
}

static int square_patch(const float p[3], int side)
{
    const int a = (int)((p[0] + 0.5F) * (float)side), b = (int)((p[2] + 0.5F) * (float)side);
    return (a < side ? a : side - 1) * side + (b < side ? b : side - 1);
}

static void polygons_are_even_whatever_their_triangles(void **state)
{
    (void)state;
    Polygons strips = {0};
    SurfacePoints points = {0};
    SurfaceResult result;
    Error error;
    double low[3], high[3];
    make_strips(&strips);
    polygons_bounds(&strips, low, high);
    check_near(high[0] - low[0], 1, 1e-6, "bounds");
    const SurfaceRequest request = {.density = 2e4, .sets = 20, .seed = 5, .surface = 3, .level = 7};
    assert_true(polygons_sample(&strips, &request, &points, &result, &error));
    check_near(result.area, 1, 1e-6, "area");
    assert_int_equal(points.count, 400000);
    const Evenness even = evenness(points.point, points.count, 20, square_patch, 30);
    check_near(even.chi_square, 899, 3 * sqrt(2 * 899.0), "chi-square of one set");
    for (size_t i = 0; i < points.count; i += 999) {
        float normal[3];
        surface_normal_unpack(points.point[i].normal, normal);
        check_near((double)points.point[i].position[1], 0.25, 1e-6, "height");
        check_near((double)normal[1], 1, 1e-4, "normal");
        assert_int_equal(points.point[i].surface, 3);
        check_near((double)points.point[i].value, 7, 0, "value");
    }
    strips.triangle_count = 0;
    assert_false(polygons_sample(&strips, &request, &points, &result, &error));
    assert_string_equal(error.message, "its 0 triangles have no area");
    assert_int_equal(points.count, 400000);
    polygons_free(&strips);
    surface_points_free(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_get_points_by_area),
        cmocka_unit_test(an_open_surface_stays_open),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(cells_are_as_fine_as_memory_allows),
        cmocka_unit_test(a_mesh_too_large_is_refused),
        cmocka_unit_test(too_thin_for_a_point),
        cmocka_unit_test(polygons_are_even_whatever_their_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
