/* Fields without a surface at the level, or with a bad surface: each ends with a message. */
#include "fixture.h"

#include "sim/points/walk.h"

static const double box[2][3] = {{-1, -1, -1}, {1, 1, 1}};

static LevelField field_of(const LevelKind *kind)
{
    return (LevelField){kind, {-1, -1, -1}, {1, 1, 1}, 2, 0.02, {0.03, 0.03, 0.03}, {{0}}};
}

static void check_refusal(const LevelField *field, double level, const char *says)
{
    SurfaceRequest request = request_for(field, 1, 1000);
    Error error;
    request.level = level;
    const char *message = refusal(&request, &error);
    if (!strstr(message, says))
        fail_msg("%s: %s", says, message);
}

/* (|x| - 0.5)^2: touches 0 on a sphere and is never below. */
SIMD_INLINE void touching_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    const f8 r = f8_sqrt(p->x * p->x + p->y * p->y + p->z * p->z), d = r - f8_splat(0.5F),
             s = f8_splat(2) * d / r;
    *out = (LaneSample){d * d, s * p->x, s * p->y, s * p->z, f8_splat(4) * d / r};
}

/* -1 or 1: a jump, without a gradient. */
SIMD_INLINE void jumping_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    const f8 none = f8_splat(0);
    *out = (LaneSample){f8_select(p->x > none, f8_splat(1), f8_splat(-1)), none, none, none, none};
}

SIMD_INLINE void constant_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field, (void)p;
    *out = (LaneSample){f8_splat(3), f8_splat(0), f8_splat(0), f8_splat(0), f8_splat(0)};
}

/* The root of x: no number for x < 0. */
SIMD_INLINE void broken_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    *out = (LaneSample){f8_sqrt(p->x), f8_splat(0.5F) / f8_sqrt(p->x), f8_splat(0), f8_splat(0), f8_splat(0)};
}

/* A double cone: its cusp has no normal. */
SIMD_INLINE void cone_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    const f8 two = f8_splat(2), squares = p->x * p->x + p->z * p->z;
    *out = (LaneSample){squares - p->y * p->y, two * p->x, -two * p->y, two * p->z, f8_splat(0)};
    out->bend = two - f8_splat(8) * (squares - p->y * p->y) / lane_square(out);
}

/* x^3: its gradient is zero all over level 0. */
SIMD_INLINE void cubic_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    *out = (LaneSample){p->x * p->x * p->x, f8_splat(3) * p->x * p->x, f8_splat(0), f8_splat(0), f8_splat(0)};
}

LEVEL_KIND(touching)
LEVEL_KIND(jumping)
LEVEL_KIND(constant)
LEVEL_KIND(broken)
LEVEL_KIND(cone)
LEVEL_KIND(cubic)

static void what_has_no_surface_says_why(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5), gyroid = level_gyroid(box[0], box[1], 1);
    const LevelField touch = field_of(&touching_kind), jump = field_of(&jumping_kind);
    const LevelField same = field_of(&constant_kind), no_number = field_of(&broken_kind);
    check_refusal(&sphere, 0.51, "level 0.51 is out of range: the field goes from -0.");
    check_refusal(&gyroid, -1.6, "level -1.6 is out of range");
    check_refusal(&touch, 0, "it is touched, if at all, and not crossed");
    check_refusal(&jump, 0, "its gradient is zero there");
    check_refusal(&same, 3, "the field is 3 everywhere");
    check_refusal(&no_number, 0.5, "the field is no number at (");
}

static void triangles_say_it_too(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5), no_number = field_of(&broken_kind);
    SurfaceRequest request = request_for(&sphere, 1, 1000);
    Error error;
    request.sampler = SURFACE_TRIANGLES;
    request.level = 0.51;
    assert_non_null(strstr(refusal(&request, &error),
                           "level 0.51 is out of range: at the corners of cells the field goes from -0."));
    request.field = &no_number;
    assert_non_null(strstr(refusal(&request, &error), "the field is no number at (-1"));
    request.field = &sphere;
    request.level = 0;
    request.cell = 1e-4;
    assert_non_null(strstr(refusal(&request, &error), "take larger ones"));
}

/* A level near the top of a ball, which lines through the bounds cross 0.0003 times each: some 20 crossings
   of 61,440 lines, some 700 of all. There are more walkers than that. */
static void a_small_part_is_found_and_as_dense_as_asked(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5);
    const double area = 4 * M_PI * 1e-4;
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&sphere, area, 2e4);
    request.level = 0.49;
    const SurfaceResult result = sample(&request, &points);
    check_near(result.area / area, 1, 0.05, "area of a ball of 1 cm");
    check_near((double)points.count / request.sets / area / request.density, 1, 0.05, "density");
    assert_true(result.reached);
    surface_points_free(&points);
}

/* No line covers all of the field; the crossings would fill any memory. */
static void what_is_too_fine_for_its_bounds_is_refused(void **state)
{
    (void)state;
    const LevelField gyroid = level_gyroid(box[0], box[1], 1e-5);
    const SurfaceRequest request = request_for(&gyroid, 1, 1000);
    Error error;
    assert_non_null(
        strstr(refusal(&request, &error), "its bounds are 2 m wide along x: more than 100000 places"));
}

static void requests_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5);
    SurfaceRequest request = request_for(&sphere, M_PI, 1000);
    Error error;
    request.sets = 0;
    assert_non_null(strstr(refusal(&request, &error), "points for 0 sets are asked for"));
    request = request_for(&sphere, M_PI, 0);
    assert_non_null(strstr(refusal(&request, &error), "ask for more than 0"));
    request = request_for(&sphere, M_PI, 1000);
    request.level = NAN;
    assert_non_null(strstr(refusal(&request, &error), "it is a finite number"));
    request.level = 0;
    request.low[1] = 2;
    request.high[1] = 3;
    assert_non_null(strstr(refusal(&request, &error), "the bounds of a surface are empty along"));
}

/* Walks go on past a cusp and along a zero gradient, each point on the surface. */
static void hard_surfaces_are_walked(void **state)
{
    (void)state;
    const LevelField fields[2] = {field_of(&cone_kind), field_of(&cubic_kind)};
    for (int f = 0; f < 2; f++) {
        SurfacePoints points = {0};
        const SurfaceRequest request = request_for(&fields[f], 4, 3e4);
        const SurfaceResult result = sample(&request, &points);
        check_near(result.area / (f == 0 ? 2 * sqrt(2) * M_PI : 4), 1, 0.03, "area");
        size_t nan = 0;
        double worst = 0;
        for (size_t i = 0; i < points.count; i++) {
            const float *p = points.point[i].position;
            nan += !(isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]));
            const double cone_off = (hypot((double)p[0], (double)p[2]) - fabs((double)p[1])) / sqrt(2);
            worst = fmax(worst, f == 0 ? fabs(cone_off) : fabs((double)p[0]));
        }
        assert_int_equal(nan, 0);
        check_near(worst, 0, 2e-4, f == 0 ? "distance from the cone" : "distance from the plane");
        surface_points_free(&points);
    }
}

static void what_was_reached_is_said(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&sphere, M_PI, 1e9);
    request.points_most = 100000;
    for (request.sampler = 0; request.sampler < SURFACE_SAMPLERS; request.sampler++) {
        points.count = 0;
        const SurfaceResult result = sample(&request, &points);
        assert_false(result.reached);
        assert_int_equal(points.count, 100000);
        check_near(result.density / request.density, 1e-4, 5e-6, "density reached");
        assert_non_null(strstr(result.lack, "100000 points are the most"));
    }
    surface_points_free(&points);
}

/* A number of points is whole: half a point off is no lack. */
static void few_points_are_reached_too(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5);
    SurfacePoints points = {0};
    for (double wanted = 0.1; wanted < 1000; wanted *= 3.1) {
        SurfaceRequest request = request_for(&sphere, M_PI, wanted);
        points.count = 0;
        const SurfaceResult result = sample(&request, &points);
        assert_int_equal(result.points, points.count);
        check_near((double)points.count, wanted, 0.5 + 0.05 * wanted, "points");
        assert_true(result.reached == (points.count > 0));
        assert_true(points.count > 0 ? result.lack[0] == '\0'
                                     : strstr(result.lack, "are less than one in all") != NULL);
    }
    surface_points_free(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_has_no_surface_says_why),
        cmocka_unit_test(triangles_say_it_too),
        cmocka_unit_test(a_small_part_is_found_and_as_dense_as_asked),
        cmocka_unit_test(what_is_too_fine_for_its_bounds_is_refused),
        cmocka_unit_test(requests_that_make_no_sense_are_refused),
        cmocka_unit_test(hard_surfaces_are_walked),
        cmocka_unit_test(what_was_reached_is_said),
        cmocka_unit_test(few_points_are_reached_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
