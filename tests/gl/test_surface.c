/* Walks on surfaces by compute shaders against those of the CPU: the same seeds and random numbers, so the
   same points but for rounding, whatever the work groups are. */
#include "tests/render/fixture.h"
#include "tests/surface/fixture.h"

#include "sim/gpu/points/points_gpu.h"
#include "sim/points/points.h"
#include "sim/points/walk.h"
#include "sim/world.h"

enum { SIDE = 20 };

static const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {0.5, 0.5, 0.5};

/* Values of a field on a grid whose axes are of different sizes. */
static VolumeData volume_of(const LevelField *field, float value[SIDE * (SIDE + 1) * (SIDE + 2)])
{
    VolumeData volume = {.size = {SIDE, SIDE + 1, SIDE + 2}, .value = value};
    for (int k = 0; k < 3; k++) {
        volume.corner[k] = -0.5;
        volume.spacing[k] = 1.0 / (volume.size[k] - 1);
    }
    for (int i = 0; i < SIDE * (SIDE + 1) * (SIDE + 2); i++) {
        const int at[3] = {i % SIDE, i / SIDE % (SIDE + 1), i / SIDE / (SIDE + 1)};
        LevelSample s;
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = -0.5 + at[k] * volume.spacing[k];
        level_at(field, p, &s);
        value[i] = s.value;
    }
    return volume;
}

/* A block of particles, with their height for a scalar. */
static SphField *particles_field(void)
{
    enum { ROW = 8, COUNT = ROW * ROW * ROW };
    static float position[4 * COUNT], scalar[COUNT];
    const float spacing = 0.1F;
    Error error = {0};
    for (int i = 0; i < COUNT; i++) {
        const int at[3] = {i % ROW, i / ROW % ROW, i / ROW / ROW};
        for (int k = 0; k < 3; k++)
            position[4 * i + k] = spacing * ((float)at[k] - 3.5F);
        position[4 * i + 3] = spacing * spacing * spacing;
        scalar[i] = 2 * position[4 * i + 1];
    }
    const FieldParticles particles = {COUNT, position, scalar, 0.21};
    SphField *field = sph_field_create(&particles, &error);
    assert_non_null(field);
    return field;
}

/* How far two points are apart, m. */
static double apart(const SurfacePoint *a, const SurfacePoint *b)
{
    double square = 0;
    for (int k = 0; k < 3; k++)
        square += pow((double)a->position[k] - (double)b->position[k], 2);
    return sqrt(square);
}

/* To first order: the distance of a point from the surface; the normal equals the field's. */
static double distance_of(const SurfaceRequest *request, const SurfacePoint *point, const char *what)
{
    const float *p = point->position;
    LevelSample s;
    float normal[3];
    level_at(request->field, (double[3]){(double)p[0], (double)p[1], (double)p[2]}, &s);
    const double length = sqrt((double)(s.gradient[0] * s.gradient[0] + s.gradient[1] * s.gradient[1] +
                                        s.gradient[2] * s.gradient[2]));
    surface_normal_unpack(point->normal, normal);
    for (int k = 0; k < 3; k++)
        check_near((double)normal[k], (double)s.gradient[k] / length, 2e-3, what);
    return fabs((double)s.value - request->level) / length;
}

static void check_same(SurfaceGpu *gpu, SurfaceRequest *request, const char *what)
{
    SurfacePoints by_cpu = {0}, by_gpu = {0};
    request->device = NULL;
    const SurfaceResult cpu = sample(request, &by_cpu);
    request->device = &gpu->device;
    const SurfaceResult found = sample(request, &by_gpu);
    size_t others = 0;
    double farthest = 0;
    check_near((double)by_gpu.count / (double)by_cpu.count, 1, 2e-3, what);
    check_near(found.density / cpu.density, 1, 2e-3, what);
    check_near((double)found.stayed, (double)cpu.stayed, 2 + 1e-3 * (double)by_cpu.count, what);
    assert_true(found.reached && found.points == by_gpu.count && found.area == cpu.area);
    const size_t count = by_cpu.count < by_gpu.count ? by_cpu.count : by_gpu.count;
    for (size_t i = 0; i < count; i++) {
        farthest = fmax(farthest, distance_of(request, &by_gpu.point[i], what));
        const bool other = apart(&by_cpu.point[i], &by_gpu.point[i]) > 1e-4;
        others += other;
        assert_int_equal(by_gpu.point[i].surface, request->surface);
        if (!other)
            check_near((double)by_gpu.point[i].value, (double)by_cpu.point[i].value, 1e-3, what);
    }
    if (others * 1000 > count) /* measured: none */
        fail_msg("%s: %zu of %zu points are elsewhere than on the CPU", what, others, count);
    check_near(farthest, 0, 2e-5, what); /* of a size of 1; measured: 1e-5 */
    surface_points_free(&by_cpu);
    surface_points_free(&by_gpu);
}

static void points_are_those_of_the_cpu(void **state)
{
    (void)state;
    static float value[SIDE * (SIDE + 1) * (SIDE + 2)];
    const LevelField sphere = level_sphere(origin, 0.4), torus = level_torus(origin, 0.35, 0.15);
    const LevelField gyroid = level_gyroid(low, high, 0.9), wave = level_wave(low, high, 0, 0.1, 0.8);
    const LevelField plane = level_plane(low, high, origin, (double[]){1, -2, 3});
    const VolumeData volume = volume_of(&gyroid, value);
    SphField *particles = particles_field();
    const LevelField sph = level_sph(particles), scalar = level_sph_scalar(particles);
    LevelField trilinear, spline;
    Error error = {0};
    assert_true(level_volume(&volume, VOLUME_TRILINEAR, &trilinear, &error));
    assert_true(level_volume(&volume, VOLUME_CATMULL_ROM, &spline, &error));
    const struct {
        const LevelField *field, *colour;
        double level;
        const char *what;
    } cases[] = {{&sphere, NULL, 0.05, "sphere"},        {&torus, NULL, 0, "torus"},
                 {&gyroid, NULL, 0.2, "gyroid"},         {&wave, NULL, 0, "wave"},
                 {&plane, &gyroid, 0, "plane"},          {&trilinear, NULL, 0.2, "trilinear"},
                 {&spline, &sphere, 0.2, "catmull_rom"}, {&sph, &scalar, 0.5, "particles"}};
    SurfaceGpu gpu;
    surface_gpu_create(&gpu);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        SurfaceRequest request = request_for(cases[k].field, 2, 2e4);
        request.level = cases[k].level;
        request.colour = cases[k].colour;
        request.walkers = 2000;
        request.surface = (uint32_t)k;
        check_same(&gpu, &request, cases[k].what);
    }
    surface_gpu_destroy(&gpu);
    sph_field_destroy(particles);
    assert_int_equal(gl_debug_errors(), 0);
}

/* Small blocks and dispatches have no effect on results. Also points that stay. */
static void work_groups_are_of_no_account(void **state)
{
    (void)state;
    const LevelField field = level_gyroid(low, high, 0.7);
    SurfacePoints points[2] = {{0}}, none = {0};
    SurfaceRequest request = request_for(&field, 4, 5e4);
    SurfaceGpu gpu;
    surface_gpu_create(&gpu);
    request.device = &gpu.device;
    request.burn_in = 3;
    sample(&request, &points[0]);
    gpu.group_most = 3;
    gpu.block_bytes = 100000;
    sample(&request, &points[1]);
    assert_int_equal(points[0].count, points[1].count);
    assert_memory_equal(points[0].point, points[1].point, points[0].count * sizeof *points[0].point);
    request.stay = true;
    const SurfaceResult result = sample(&request, &none);
    assert_int_equal(none.count, 0);
    assert_int_equal(result.points, points[0].count);
    unsigned buffer = surface_gpu_take_points(&gpu);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(result.points * sizeof(SurfacePoint)), points[1].point);
    assert_memory_equal(points[0].point, points[1].point, points[0].count * sizeof *points[0].point);
    glDeleteBuffers(1, &buffer);
    surface_points_free(&points[0]);
    surface_points_free(&points[1]);
    surface_gpu_destroy(&gpu);
    assert_int_equal(gl_debug_errors(), 0);
}

static void a_set_is_uniform_and_as_dense_as_asked(void **state)
{
    (void)state;
    const LevelField sphere = level_sphere(origin, 0.5);
    SurfacePoints points = {0};
    SurfaceRequest request = request_for(&sphere, M_PI, 2e5);
    SurfaceGpu gpu;
    surface_gpu_create(&gpu);
    request.device = &gpu.device;
    const SurfaceResult result = sample(&request, &points);
    assert_true(result.reached && result.stayed == 0);
    check_near((double)points.count / request.sets / M_PI / request.density, 1, 0.03, "density");
    check_near(evenness(points.point, points.count, 1, sphere_patch, 10).worst, 0, 0.25,
               "the worst of 100 patches"); /* 12,500 walkers: three standard errors of 125 */
    request.points_most = 50000;
    points.count = 0;
    const SurfaceResult fewer = sample(&request, &points);
    assert_true(!fewer.reached && fewer.lack[0] && points.count == 50000);
    check_near(fewer.density / request.density, 0.25, 0.02, "what was reached");
    surface_points_free(&points);
    surface_gpu_destroy(&gpu);
}

static void what_is_not_for_a_gpu_is_refused(void **state)
{
    (void)state;
    static const LevelKind unknown = {.name = "unheard_of"};
    LevelField sphere = level_sphere(origin, 0.5);
    LevelKind own = *sphere.kind;
    Error error;
    SurfaceRequest request = request_for(&sphere, M_PI, 1e4);
    SurfaceGpu gpu;
    surface_gpu_create(&gpu);
    request.device = &gpu.device;
    assert_true(surface_gpu_knows(&sphere));
    assert_false(surface_gpu_knows(&(LevelField){.kind = &unknown}));
    own.name = unknown.name;
    sphere.kind = &own;
    assert_non_null(strstr(refusal(&request, &error), "no shader surface/unheard_of.glsl"));
    own.name = "sphere";
    gpu.block_bytes = 1000;
    assert_non_null(strstr(refusal(&request, &error), "this driver allows shaders 1000"));
    request.sampler = SURFACE_TRIANGLES;
    assert_non_null(strstr(refusal(&request, &error), "takes the steps of a walk"));
    surface_gpu_destroy(&gpu);
}

/* For figures SLOSH_POINTS=1e7 build/release/tests/test_gl surface: persistent points, with seeds. */
static void points_a_second(void **state)
{
    (void)state;
    const char *text = getenv("SLOSH_POINTS");
    const LevelField sphere = level_sphere(origin, 0.5), gyroid = level_gyroid(low, high, 0.5);
    const LevelField *const fields[] = {&sphere, &gyroid};
    const double area[] = {M_PI, 6.2};
    SurfaceGpu gpu;
    surface_gpu_create(&gpu);
    for (int k = 0; k < 2; k++) {
        SurfacePoints none = {0};
        SurfaceRequest request = request_for(fields[k], area[k], text ? atof(text) : 1e4);
        request.device = &gpu.device;
        request.stay = true;
        sample(&request, &none); /* programs are compiled */
        const double began = wall_ms();
        const SurfaceResult result = sample(&request, &none);
        assert_true(result.reached && none.count == 0);
        printf("%-7s %9zu points  %8.3g/s\n", fields[k]->kind->name, result.points,
               1e3 * (double)result.points / (wall_ms() - began));
    }
    surface_gpu_destroy(&gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_those_of_the_cpu),
        cmocka_unit_test(work_groups_are_of_no_account),
        cmocka_unit_test(a_set_is_uniform_and_as_dense_as_asked),
        cmocka_unit_test(what_is_not_for_a_gpu_is_refused),
        cmocka_unit_test(points_a_second),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
