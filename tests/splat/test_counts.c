/* Coverage and fragments that the view splat counts, against circles and numbers of spheres. */
#include "tests/render/fixture.h"

enum { WIDTH = 320, HEIGHT = 240 };
static const double distance = 3, radius = 0.5, fov_deg = 30;

static ViewCounts counts_with(const Particles *particles, ViewDef def)
{
    Error error = {0};
    def.color_by = SCALAR_FLUID;
    def.camera_auto = false;
    memcpy(def.camera.from, (double[]){0, 0, distance}, sizeof def.camera.from);
    memcpy(def.camera.to, (double[]){0, 0, 0}, sizeof def.camera.to);
    def.camera.fov_deg = fov_deg;
    def.radius = 1;
    ParticleBuffers state = box_state(particles->count, radius), buffers;
    ViewCounts counts;
    Upload *upload = upload_particles(particles, &state, &buffers);
    Renderer *renderer = renderer_create(&def, NULL, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw_counted(renderer, &buffers, &counts);
    renderer_destroy(renderer);
    upload_destroy(upload);
    return counts;
}

static ViewCounts counts_of(const Particles *particles, const char *kind, bool cull)
{
    ViewDef def = bare_view();
    text_set(def.kind, kind);
    splat_def(&def)->cull = cull;
    return counts_with(particles, def);
}

/* The silhouette in the middle of the picture is a circle: pi r^2 over the picture's area. */
static double circle(void)
{
    const double tangent = radius / sqrt(distance * distance - radius * radius);
    const double pixels = tangent / tan(fov_deg * M_PI / 360) * HEIGHT / 2;
    return M_PI * pixels * pixels / (WIDTH * HEIGHT);
}

/* Of a quad's pixels to its sphere's, and some for its rounding. */
static const double corners = 4 / M_PI + 0.05;

/* One sphere, and more in its place: as many fragments a pixel. */
static void spheres_in_one_place(void **state)
{
    (void)state;
    for (int spheres = 1; spheres <= 3; spheres++) {
        Particles particles = {0};
        for (int i = 0; i < spheres; i++)
            particles_add(&particles, 0, 0, 0, 1, 0);
        const ViewCounts counts = counts_of(&particles, "splat", false);
        printf("%d: coverage %.4f of %.4f, fragments %.3f and %.3f\n", spheres, counts.coverage, circle(),
               counts.fragments[STAGE_VISIBILITY], counts.fragments[STAGE_BLEND]);
        assert_true(counts.counted);
        assert_true(fabs(counts.coverage / circle() - 1) < 0.005);
        for (int stage = STAGE_VISIBILITY; stage <= STAGE_BLEND; stage++) {
            const double each = counts.fragments[stage] / spheres;
            assert_true(each > 0.995 && each < corners);
        }
        assert_true(counts.fragments[STAGE_SHADE] == 0);
    }
}

/* Spheres far behind another: pass 1 meets them, blending does not. */
static void hidden_spheres_are_not_blended(void **state)
{
    (void)state;
    Particles particles = {0};
    particles_add(&particles, 0, 0, 0, 1, 0);
    for (int i = 1; i < 5; i++)
        particles_add(&particles, 0, 0, -2.0 * i, 1, 0);
    const ViewCounts all = counts_of(&particles, "splat", false),
                     culled = counts_of(&particles, "splat", true);
    assert_true(all.fragments[STAGE_VISIBILITY] > 1.4 && all.fragments[STAGE_BLEND] < corners);
    assert_true(culled.fragments[STAGE_VISIBILITY] <= all.fragments[STAGE_VISIBILITY]);
    assert_true(fabs(all.coverage - culled.coverage) < 1e-9);
}

/* A level's search splats the sphere for its depth, for the field's samples and for the root. */
static void each_splat_of_a_level_counts(void **state)
{
    (void)state;
    ViewDef def = bare_view();
    Particles particles = {0};
    text_set(def.kind, "splat");
    splat_def(&def)->level = 1e-3;
    particles_add(&particles, 0, 0, 0, 1, 0);
    const ViewCounts counts = counts_with(&particles, def);
    assert_true(counts.fragments[STAGE_VISIBILITY] > 2.9);
    assert_true(counts.fragments[STAGE_BLEND] > 0.995 && counts.fragments[STAGE_BLEND] < 1.5);
}

static void nothing_in_view_is_no_coverage(void **state)
{
    (void)state;
    Particles particles = {0};
    particles_add(&particles, 0, 0, 2 * distance, 1, 0);
    const ViewCounts counts = counts_of(&particles, "splat", false);
    assert_true(counts.counted && counts.coverage == 0 && counts.fragments[STAGE_BLEND] == 0);
}

static void other_views_count_nothing(void **state)
{
    (void)state;
    Particles particles = {0};
    particles_add(&particles, 0, 0, 0, 1, 0);
    const ViewCounts counts = counts_of(&particles, "spheres", false);
    assert_true(!counts.counted && counts.coverage == 0 && counts.fragments[STAGE_VISIBILITY] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(spheres_in_one_place, no_gl_errors),
        cmocka_unit_test_teardown(hidden_spheres_are_not_blended, no_gl_errors),
        cmocka_unit_test_teardown(each_splat_of_a_level_counts, no_gl_errors),
        cmocka_unit_test_teardown(nothing_in_view_is_no_coverage, no_gl_errors),
        cmocka_unit_test_teardown(other_views_count_nothing, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
