/* Walks that begin on triangles: on the particles' own field as evenly as its area, inside the fluid only. */
#include "fixture.h"

#include "sim/mesh.h"
#include "sim/points/points.h"

enum { ALONG = 17, PARTICLES_MOST = ALONG * ALONG * ALONG, CELLS = 40 };

static const double SPACING = 0.06, H = 0.126;

/* A ball of some 2,000 particles that are out of order, and their x as scalar. */
typedef struct Ball {
    float position[4 * PARTICLES_MOST], x[PARTICLES_MOST];
    FieldParticles particles;
    SphField *sph;
} Ball;

static float chance(size_t i)
{
    return (float)((uint32_t)(i + 1) * 2654435761U >> 16) * 0x1p-16F - 0.5F;
}

static Ball *ball_create(void)
{
    Ball *ball = calloc(1, sizeof *ball);
    Error error;
    assert_non_null(ball);
    size_t count = 0;
    for (size_t i = 0; i < PARTICLES_MOST; i++) {
        const size_t at[3] = {i % ALONG, i / ALONG % ALONG, i / ALONG / ALONG};
        float p[3], square = 0;
        for (size_t k = 0; k < 3; k++) {
            p[k] = (float)SPACING * ((float)((int)at[k] - ALONG / 2) + 0.3F * chance(3 * i + k));
            square += p[k] * p[k];
        }
        if (square > 0.45F * 0.45F)
            continue;
        memcpy(&ball->position[4 * count], p, sizeof p);
        ball->position[4 * count + 3] = (float)(SPACING * SPACING * SPACING);
        ball->x[count++] = p[0];
    }
    ball->particles = (FieldParticles){count, ball->position, ball->x, H};
    ball->sph = sph_field_create(&ball->particles, &error);
    assert_non_null(ball->sph);
    return ball;
}

static void ball_destroy(Ball *ball)
{
    sph_field_destroy(ball->sph);
    free(ball);
}

/* Marching cubes on a coarse grid. */
static Polygons triangles_of(const Ball *ball, bool weighted, float level)
{
    static float field[CELLS * CELLS * CELLS], sum[CELLS * CELLS * CELLS];
    const VolumeGrid grid = {{CELLS, CELLS, CELLS}, {-0.65, -0.65, -0.65}, 1.3 / CELLS};
    FieldSlabs slabs = {0};
    IsoMesh mesh;
    Polygons polygons = {0};
    Error error;
    assert_true(field_sum(&ball->particles, &grid, 2, &slabs, field, sum, &error));
    field_slabs_free(&slabs);
    for (int i = 0; i < CELLS * CELLS * CELLS; i++)
        sum[i] = field[i] > 0 ? sum[i] / field[i] : 0;
    assert_true(isosurface(grid.size, weighted ? sum : field, level, &mesh, &error));
    assert_true(polygons_reserve(&polygons, mesh.vertex_count, mesh.triangle_count, &error));
    for (size_t v = 0; v < mesh.vertex_count; v++) {
        double place[3];
        isosurface_place(&mesh, v, place);
        for (int k = 0; k < 3; k++) {
            polygons.place[v][k] = (float)(grid.corner[k] + (place[k] + 0.5) * grid.cell);
            polygons.normal[v][k] = 0;
        }
    }
    memcpy(polygons.corner, mesh.triangle, mesh.triangle_count * sizeof *mesh.triangle);
    isosurface_free(&mesh);
    return polygons;
}

static SurfaceResult walk_near(const SurfaceRequest *request, const Polygons *near, SurfacePoints *points)
{
    SurfaceResult result;
    Error error;
    if (!near_walk(request, near, points, &result, &error))
        fail_msg("%s", error.message);
    return result;
}

/* How far a value is from the level, by a sum over all particles and the slope of the fast one, m. */
static double off_level(const Ball *ball, const LevelField *field, bool weighted, const float p[3],
                        double level)
{
    const double at[3] = {(double)p[0], (double)p[1], (double)p[2]};
    LevelSample s;
    double sum;
    const double f = field_at(&ball->particles, at, &sum);
    level_at(field, at, &s);
    const double slope = sqrt((double)(s.gradient[0] * s.gradient[0] + s.gradient[1] * s.gradient[1] +
                                       s.gradient[2] * s.gradient[2]));
    return fabs((weighted ? sum / f : f) - level) / slope;
}

static void walks_lie_on_the_particles_field(void **state)
{
    (void)state;
    Ball *ball = ball_create();
    const LevelField field = level_sph(ball->sph);
    Polygons near = triangles_of(ball, false, 0.5F);
    SurfacePoints points = {0}, exact = {0};
    SurfaceRequest request = {.field = &field, .level = 0.5, .density = 2500, .sets = 40, .seed = 3};
    const SurfaceResult result = walk_near(&request, &near, &points);
    check_near((double)points.count / (result.area * 1e5), 1, 2e-3, "points");
    assert_int_equal(result.stayed, 0);
    for (size_t i = 0; i < points.count; i += 499)
        check_near(off_level(ball, &field, false, points.point[i].position, 0.5), 0, 2e-5, "distance");
    /* as much in each part as finer triangles have, all points of which are independent */
    request.sampler = SURFACE_TRIANGLES;
    request.cell = 0.01;
    const double area = sample(&request, &exact).area;
    check_near(result.area / area, 1, 0.01, "area");
    double share[2][8] = {{0}};
    for (size_t i = 0; i < points.count + exact.count; i++) {
        const bool other = i >= points.count;
        const float *p = other ? exact.point[i - points.count].position : points.point[i].position;
        share[other][(p[0] > 0) + 2 * (p[1] > 0.1F) + 4 * (p[2] > -0.1F)] +=
            1 / (double)(other ? exact.count : points.count);
    }
    const double walkers = (double)points.count / 16;
    for (int i = 0; i < 8; i++) /* four standard errors of walkers that do not come far */
        check_near(share[0][i] / share[1][i], 1, 4 / sqrt(share[1][i] * walkers), "share of a part");
    surface_points_free(&points);
    surface_points_free(&exact);
    polygons_free(&near);
    ball_destroy(ball);
}

static void walks_on_a_scalar_stay_inside(void **state)
{
    (void)state;
    Ball *ball = ball_create();
    const LevelField field = level_sph_inside(ball->sph), fluid = level_sph(ball->sph);
    Polygons near = triangles_of(ball, true, 0.1F);
    SurfacePoints points = {0};
    const SurfaceRequest request = {.field = &field, .level = 0.1, .density = 2500, .sets = 10, .seed = 3};
    const SurfaceResult result = walk_near(&request, &near, &points);
    assert_true(result.stayed > 0); /* those of triangles outside, where the mean falls to 0 */
    assert_true(points.count > 10000);
    double out = 0;
    for (size_t i = 0; i < points.count; i += 97) {
        const float *p = points.point[i].position;
        LevelSample s;
        check_near(off_level(ball, &field, true, p, 0.1), 0, 2e-5, "distance");
        level_at(&fluid, (double[]){(double)p[0], (double)p[1], (double)p[2]}, &s);
        assert_true((double)s.value >= 0.5 - 1e-4);
        out = fmax(out, hypot((double)p[1], (double)p[2]));
    }
    assert_true(out > 0.4); /* up to the surface: a disc of radius 0.44 */
    check_near((double)points.count / (25000 * M_PI * 0.44 * 0.44), 1, 0.1, "area of the disc");
    surface_points_free(&points);
    polygons_free(&near);
    ball_destroy(ball);
}

/* Where pixels are large a walker has one point, and neighbours in the array are strangers. */
static void sets_of_small_pictures_are_independent(void **state)
{
    (void)state;
    Ball *ball = ball_create();
    const LevelField field = level_sph(ball->sph);
    Polygons near = triangles_of(ball, false, 0.5F);
    for (int large = 0; large < 2; large++) {
        SurfacePoints points = {0};
        const SurfaceRequest request = {.field = &field,
                                        .level = 0.5,
                                        .density = 250,
                                        .sets = 16,
                                        .seed = 3,
                                        .pixel = large ? field.step : field.step / 10};
        walk_near(&request, &near, &points);
        double close = 0;
        for (size_t i = 1; i < points.count; i++) {
            const float *p = points.point[i].position, *q = points.point[i - 1].position;
            close += hypot(hypot((double)(p[0] - q[0]), (double)(p[1] - q[1])), (double)(p[2] - q[2])) <
                     2 * field.step;
        }
        check_near(close / (double)points.count, large ? 0.03 : 0.9, large ? 0.03 : 0.1, "pairs");
        surface_points_free(&points);
    }
    polygons_free(&near);
    ball_destroy(ball);
}

static void threads_make_no_difference(void **state)
{
    (void)state;
    Ball *ball = ball_create();
    const LevelField field = level_sph(ball->sph);
    Polygons near = triangles_of(ball, false, 0.5F);
    SurfacePoints points[2] = {0};
    SurfaceRequest request = {.field = &field, .level = 0.5, .density = 2500, .sets = 4, .seed = 3};
    for (int k = 0; k < 2; k++) {
        request.threads = k + 1;
        walk_near(&request, &near, &points[k]);
    }
    assert_int_equal(points[0].count, points[1].count);
    assert_memory_equal(points[0].point, points[1].point, points[0].count * sizeof *points[0].point);
    surface_points_free(&points[0]);
    surface_points_free(&points[1]);
    polygons_free(&near);
    ball_destroy(ball);
}

static void what_has_no_level_is_said(void **state)
{
    (void)state;
    Ball *ball = ball_create();
    const LevelField field = level_sph(ball->sph);
    Polygons near = triangles_of(ball, false, 0.5F);
    SurfacePoints points = {0};
    SurfaceResult result;
    Error error;
    SurfaceRequest request = {.field = &field, .level = 9, .density = 2500, .sets = 1, .seed = 3};
    assert_false(near_walk(&request, &near, &points, &result, &error));
    assert_string_equal(error.message, "none of the field has the level 9 near its triangles");
    near.triangle_count = 0;
    request.level = 0.5;
    assert_false(near_walk(&request, &near, &points, &result, &error));
    assert_string_equal(error.message, "there are no triangles near the level 0.5");
    assert_int_equal(points.count, 0);
    surface_points_free(&points);
    polygons_free(&near);
    ball_destroy(ball);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walks_lie_on_the_particles_field),
        cmocka_unit_test(walks_on_a_scalar_stay_inside),
        cmocka_unit_test(sets_of_small_pictures_are_independent),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(what_has_no_level_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
