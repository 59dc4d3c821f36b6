/* Points of the walk: uniform, on the surface, as many as asked for, on all parts, and the same each time. */
#include "fixture.h"

#include "sim/points/walk.h"

static const double torus_area = 4e-6 * M_PI * M_PI * RING_MM * TUBE_MM;

/* Walkers that all begin on the equator, which is far from uniform, after so many steps. */
static Evenness evenness_from_equator(const LevelField *field, float step, uint32_t steps, Patch *patch)
{
    enum { WALKERS = 50000 };
    float *place = calloc(3 * WALKERS, sizeof *place);
    uint32_t *taken = calloc(WALKERS, sizeof *taken);
    SurfacePoint *out = calloc(WALKERS, sizeof *out);
    assert_non_null(place);
    assert_non_null(taken);
    assert_non_null(out);
    const Walkers walkers = {WALKERS, {place, place + WALKERS, place + 2 * WALKERS}, taken};
    for (int i = 0; i < WALKERS; i++) {
        walkers.place[0][i] = (float)(0.5 * cos(2.399963 * i));
        walkers.place[2][i] = (float)(0.5 * sin(2.399963 * i));
    }
    Walk walk = {.field = field, .walkers = &walkers, .low = {-1, -1, -1}, .high = {1, 1, 1}, .step = step};
    walk.close = 1e-5F;
    walk.reach = 6 * step;
    walk.key = philox_key(3);
    walk.count = steps;
    field->kind->walk[simd_wide()](&walk, 0, WALKERS);
    walk.first = steps;
    walk.count = 1;
    walk.out = out;
    field->kind->walk[simd_wide()](&walk, 0, WALKERS);
    const Evenness even = evenness(out, WALKERS, 1, patch, 100);
    free(place);
    free(taken);
    free(out);
    return even;
}

/* One place of each walker over 10,000 equal patches. */
static void walks_become_uniform(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5),
                     torus = level_torus(origin, 1e-3 * RING_MM, 1e-3 * TUBE_MM);
    const double bound = chi_square_bound(9999),
                 short_of = evenness_from_equator(&sphere, 0.1F, 3, sphere_patch).chi_square;
    if (short_of < 2 * bound)
        fail_msg("3 steps from the equator should not be enough: chi-square %g", short_of);
    const double on_sphere = evenness_from_equator(&sphere, 0.1F, 180, sphere_patch).chi_square;
    const double on_torus = evenness_from_equator(&torus, 0.05F, 120, torus_patch).chi_square;
    if (on_sphere > bound || on_torus > bound)
        fail_msg("chi-square of 9999 degrees: sphere %g, torus %g; 1 %% exceed %g", on_sphere, on_torus,
                 bound);
}

/* A step from (R, 0, 0): the tangent leads outwards by step^2 / R on average, corrected by the drift. All
   places are close enough here, so Newton's method is idle. */
static void the_drift_keeps_walkers_at_their_distance(void **state)
{
    (void)state;
    enum { WALKERS = 40000 };
    static float place[3][WALKERS];
    static uint32_t taken[WALKERS];
    static SurfacePoint out[WALKERS];
    const double radius = 0.5, step = 0.05;
    const LevelField sphere = level_sphere(origin, radius);
    const Walkers walkers = {WALKERS, {place[0], place[1], place[2]}, taken};
    Walk walk = {.field = &sphere, .walkers = &walkers, .low = {-9, -9, -9}, .high = {9, 9, 9}, .count = 1};
    walk.step = (float)step;
    walk.close = 9;
    walk.reach = 9;
    walk.key = philox_key(5);
    walk.out = out;
    for (int i = 0; i < WALKERS; i++)
        place[0][i] = (float)radius;
    sphere.kind->walk[simd_wide()](&walk, 0, WALKERS);
    double sum = 0, squares = 0;
    for (int i = 0; i < WALKERS; i++) {
        const float *p = out[i].position;
        const double off = sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])) - radius;
        sum += off;
        squares += off * off;
    }
    const double error = sqrt(squares) / WALKERS; /* step^2 / R / sqrt(walkers) */
    check_near(error, step * step / radius / sqrt(WALKERS), 0.1 * error, "standard error");
    check_near(sum / WALKERS, 0, 4 * error, "mean distance from the sphere");
}

/* A sphere by the root of the distance, over which Newton's method leaps from d to -d for ever. */
SIMD_INLINE void leaping_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    const f8 r = f8_sqrt(p->x * p->x + p->y * p->y + p->z * p->z), d = f8_splat(0.5F) - r;
    const f8 root = f8_sqrt(greater(f8_abs(d), f8_splat(1e-9F))), slope = f8_splat(-0.5F) / root / r;
    *out = (LaneSample){f8_copysign(root, d), slope * p->x, slope * p->y, slope * p->z, f8_splat(2) * slope};
}

LEVEL_KIND(leaping)

/* The part of all steps that walkers took; how far their points are from the sphere. */
static double part_taken(bool no_bisection, double *worst)
{
    enum { WALKERS = 64, STEPS = 40 };
    float place[3][WALKERS] = {{0}};
    uint32_t taken[WALKERS] = {0};
    SurfacePoint out[WALKERS * STEPS];
    const LevelField field = {.kind = &leaping_kind};
    const Walkers walkers = {WALKERS, {place[0], place[1], place[2]}, taken};
    Walk walk = {.field = &field, .walkers = &walkers, .low = {-1, -1, -1}, .high = {1, 1, 1}, .step = 0.01F};
    walk.close = 1e-5F;
    walk.reach = 0.06F;
    walk.no_bisection = no_bisection;
    walk.count = STEPS;
    walk.out = out;
    for (int i = 0; i < WALKERS; i++)
        place[0][i] = 0.5F;
    field.kind->walk[simd_wide()](&walk, 0, WALKERS);
    double sum = 0;
    for (int i = 0; i < WALKERS; i++)
        sum += taken[i];
    for (int i = 0; i < WALKERS * STEPS; i++) {
        const float *p = out[i].position;
        *worst = fmax(*worst, fabs(sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2])) - 0.5));
    }
    return sum / (WALKERS * STEPS);
}

static void bisection_finds_what_newton_does_not(void **state)
{
    (void)state;
    double worst = 0;
    const double without = part_taken(true, &worst), with = part_taken(false, &worst);
    if (!(without < 0.2 && with > 0.95))
        fail_msg("%g of all steps were taken without bisection, %g with it", without, with);
    check_near(worst, 0, 1e-5, "distance from the sphere");
}

/* A whole set over 100 equal patches; its size and the area; the distance of each point. */
static void check_set(const LevelField *field, double area, Patch *patch, double step)
{
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(field, area, 1e6);
    request.step = step;
    const SurfaceResult result = sample(&request, &points);
    assert_true(result.reached && result.lack[0] == '\0' && result.note[0] == '\0');
    assert_int_equal(result.stayed, 0);
    check_near(result.area / area, 1, 0.02, "area by lines");
    check_near((double)points.count / request.sets / area / request.density, 1, 0.02, "density");
    check_near(evenness(points.point, points.count, 1, patch, 10).worst, 0, 0.1,
               "the worst of 100 patches"); /* 62,500 walkers: three standard errors of 625 */
    for (size_t i = 0; i < points.count; i += 7) {
        const SurfacePoint *p = &points.point[i];
        LevelSample s;
        float normal[3];
        level_at(field, (double[3]){(double)p->position[0], (double)p->position[1], (double)p->position[2]},
                 &s);
        check_near((double)s.value, 0, 2e-5, "distance"); /* of the size, 1; the fields are distances */
        surface_normal_unpack(p->normal, normal);
        for (int k = 0; k < 3; k++)
            check_near((double)normal[k], (double)s.gradient[k], 2e-4, "normal");
    }
    surface_points_free(&points);
}

static void a_set_is_uniform_and_as_dense_as_asked(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5),
                     torus = level_torus(origin, 1e-3 * RING_MM, 1e-3 * TUBE_MM);
    check_set(&sphere, M_PI, sphere_patch, 0);
    check_set(&torus, torus_area, torus_patch, 0.05);
}

/* Several sheets are in each counting sphere, without information from the known places. */
static void what_is_folded_finely_is_as_dense_as_asked(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, period = 0.05;
    const LevelField field = level_gyroid(low, high, period);
    const double area = 3.0915 / period; /* Schoen 1970: 3.0915 of a unit cell */
    SurfacePoints points = {0};
    const SurfaceRequest request = request_for(&field, area, 3e5);
    const SurfaceResult result = sample(&request, &points);
    check_near((double)points.count / request.sets / area / request.density, 1, 0.05, "density");
    check_near(result.density / request.density, 1, 1e-3, "density that is said");
    assert_true(result.reached);
    assert_non_null(strstr(result.note, "its points are counted by its area: spheres on it hold "));
    surface_points_free(&points);
}

static void the_same_seed_gives_the_same_bits(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};
    const LevelField field = level_gyroid(low, high, 0.7);
    SurfacePoints points[3] = {0};
    SurfaceRequest request = request_for(&field, 4, 1e5);
    sample(&request, &points[0]);
    request.threads = 1;
    sample(&request, &points[1]);
    request.seed++;
    sample(&request, &points[2]);
    assert_int_equal(points[0].count, points[1].count);
    assert_memory_equal(points[0].point, points[1].point, points[0].count * sizeof *points[0].point);
    assert_memory_not_equal(points[0].point, points[2].point, 1000 * sizeof *points[0].point);
    for (int k = 0; k < 3; k++)
        surface_points_free(&points[k]);
}

/* Each instruction set. */
static void lanes_have_the_same_bits_at_any_width(void **state)
{
    (void)state;
    enum { WALKERS = 64, STEPS = 40 };
    SurfacePoint out[2][WALKERS * STEPS];
    const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    const LevelField field = level_gyroid(low, high, 1);
    if (!simd_wide())
        skip();
    for (int wide = 0; wide < 2; wide++) {
        float place[3][WALKERS] = {{0}};
        uint32_t taken[WALKERS] = {0};
        const Walkers walkers = {WALKERS, {place[0], place[1], place[2]}, taken};
        Walk walk = {
            .field = &field, .walkers = &walkers, .low = {-1, -1, -1}, .high = {1, 1, 1}, .step = 0.03F};
        walk.close = 1e-5F;
        walk.reach = 0.2F;
        walk.count = STEPS;
        walk.out = out[wide];
        field.kind->walk[wide](&walk, 0, WALKERS);
    }
    assert_memory_equal(out[0], out[1], sizeof out[0]);
}

/* Three balls apart from each other, the greater of their values. */
static const float balls[3][4] = {{-0.5F, 0, 0, 0.4F}, {0.5F, 0.2F, 0, 0.3F}, {0.6F, -0.6F, 0.3F, 0.1F}};

SIMD_INLINE void three_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)field;
    for (int k = 0; k < 3; k++) {
        const f8 x = p->x - f8_splat(balls[k][0]), y = p->y - f8_splat(balls[k][1]),
                 z = p->z - f8_splat(balls[k][2]);
        const f8 r = f8_sqrt(x * x + y * y + z * z), i = f8_splat(1) / r;
        const LaneSample s = {f8_splat(balls[k][3]) - r, -x * i, -y * i, -z * i, f8_splat(-2) * i};
        if (k == 0)
            *out = s;
        else
            lane_keep(s.value > out->value, &(LanePlace){x, y, z}, &s, &(LanePlace){x, y, z}, out);
    }
}

LEVEL_KIND(three)

static void separate_parts_all_have_their_share(void **state)
{
    (void)state;
    const LevelField field = {&three_kind, {-1, -1, -1}, {1, 1, 1}, 1, 0.01, {0.02, 0.02, 0.02}, {{0}}};
    const double area = 4 * M_PI * (0.16 + 0.09 + 0.01);
    SurfacePoints points = {0};
    const SurfaceRequest request = request_for(&field, area, 1e6);
    const SurfaceResult result = sample(&request, &points);
    double share[3] = {0};
    for (size_t i = 0; i < points.count; i++)
        for (int k = 0; k < 3; k++) {
            const float *p = points.point[i].position, *b = balls[k];
            const float d[3] = {p[0] - b[0], p[1] - b[1], p[2] - b[2]};
            share[k] += d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 1.1F * b[3] * b[3];
        }
    check_near(share[0] + share[1] + share[2], (double)points.count, 0, "points on balls");
    for (int k = 0; k < 3; k++) {
        const double right = 4 * M_PI * (double)(balls[k][3] * balls[k][3]) * request.density * request.sets;
        check_near(share[k] / right, 1, k < 2 ? 0.03 : 0.08,
                   "a ball's share"); /* walkers do not change balls */
    }
    check_near(result.area / area, 1, 0.02, "area");
    surface_points_free(&points);
}

/* An open surface, cut by the box: as dense at its edge as inside. */
static void a_surface_ends_at_its_bounds(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, up[3] = {0, 2, 0};
    const LevelField field = level_plane(low, high, origin, up);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&field, 1, 1e6);
    request.step = 0.05;
    const SurfaceResult result = sample(&request, &points);
    size_t edge = 0;
    for (size_t i = 0; i < points.count; i++) {
        const float *p = points.point[i].position;
        if (!(fabsf(p[0]) <= 0.5F && fabsf(p[2]) <= 0.5F && fabsf(p[1]) < 1e-5F))
            fail_msg("(%g, %g, %g) is not on the slice", (double)p[0], (double)p[1], (double)p[2]);
        edge += fabsf(p[0]) > 0.48F || fabsf(p[2]) > 0.48F;
    }
    check_near((double)edge / (double)points.count / (1 - 0.96 * 0.96), 1, 0.02, "density at the edge");
    assert_true(result.stayed > 0); /* at the edge steps are not taken */
    request.low[0] = 0;             /* and cut in two by the request */
    request.low[1] = request.low[2] = -1;
    request.high[0] = request.high[1] = request.high[2] = 1;
    points.count = 0;
    check_near(sample(&request, &points).area, 0.5, 0.01, "half a slice");
    for (size_t i = 0; i < points.count; i++)
        assert_true(points.point[i].position[0] >= 0);
    surface_points_free(&points);
}

/* Steps as long as the slice is wide leave it, nearly all of them. */
static void a_walk_that_does_not_move_is_said(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, up[3] = {0, 1, 0};
    const LevelField field = level_plane(low, high, origin, up);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&field, 1, 1e5);
    request.step = 2;
    const SurfaceResult result = sample(&request, &points);
    assert_true(result.reached);
    assert_non_null(strstr(result.note, " % of all steps found no way along it: take a smaller step"));
    check_near((double)points.count / 1e5, 1, 0.03, "points");
    surface_points_free(&points);
}

/* A slice with point values from a second field; and appended to earlier points. */
static void points_take_their_value_from_a_field(void **state)
{
    (void)state;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5}, up[3] = {0, 1, 0};
    const LevelField slice = level_plane(low, high, origin, up), ball = level_sphere(origin, 0.5);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&slice, 1, 10001);
    request.colour = &ball;
    request.surface = 1;
    sample(&request, &points);
    const size_t first = points.count;
    request.field = &ball;
    request.level = 0.1;
    request.colour = NULL;
    request.surface = 2;
    sample(&request, &points);
    assert_true(first > 9000 && points.count > first + 9000);
    for (size_t i = 0; i < points.count; i++) {
        const SurfacePoint *p = &points.point[i];
        const double r = hypot((double)p->position[0], (double)p->position[2]);
        assert_int_equal(p->surface, i < first ? 1 : 2);
        check_near((double)p->value, i < first ? 0.5 - r : 0.1, 1e-5, "value");
    }
    surface_points_free(&points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walks_become_uniform),
        cmocka_unit_test(the_drift_keeps_walkers_at_their_distance),
        cmocka_unit_test(bisection_finds_what_newton_does_not),
        cmocka_unit_test(a_set_is_uniform_and_as_dense_as_asked),
        cmocka_unit_test(what_is_folded_finely_is_as_dense_as_asked),
        cmocka_unit_test(the_same_seed_gives_the_same_bits),
        cmocka_unit_test(lanes_have_the_same_bits_at_any_width),
        cmocka_unit_test(separate_parts_all_have_their_share),
        cmocka_unit_test(a_surface_ends_at_its_bounds),
        cmocka_unit_test(a_walk_that_does_not_move_is_said),
        cmocka_unit_test(points_take_their_value_from_a_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
