/* The view splat with filter: sheets of spheres become flat, outlines stay, and extremes of coverage are
   safe. */
#include "tests/splat/splat_fixture.h"

#define SPACING 0.05

/* Jittered spheres, with a front plane through the world's x axis, leaning back by the angle. */
static SplatScene sheet(double angle)
{
    SplatScene scene = splat_scene((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 30, SPACING);
    for (int i = -10; i <= 10; i++)
        for (int j = -10; j <= 10; j++) {
            const double x = SPACING * (i + 0.3 * sin(12.9 * i + 78.2 * j)),
                         y = SPACING * (j + 0.3 * sin(37.7 * i * j));
            const double z = SPACING * (-1 + 0.2 * sin(3.1 * i + 57.3 * j));
            particles_add(scene.particles, x, 0.5 + y * cos(angle) + z * sin(angle),
                          z * cos(angle) - y * sin(angle), 1, 0);
        }
    splat_def(&scene.def)->filter = SPLAT_NARROW_RANGE;
    return scene;
}

/* A clear fluid's thickness, in a coarser map, is made before the filter and independent; no cut without
   walls. */
static void the_same_with_each_shading(void **state)
{
    (void)state;
    SplatScene scene = sheet(0.3);
    const int count = scene.width * scene.height;
    for (int k = 0; k < 3; k++)
        scene.world.periodic[k] = true;
    SplatPixel *opaque = splat_drawn(&scene);
    splat_def(&scene.def)->shading = SPLAT_WATER;
    SplatPixel *clear = splat_drawn(&scene);
    assert_memory_equal(clear, opaque, (size_t)count * sizeof *clear);
    free(clear);
    free(opaque);
    free(scene.particles);
}

typedef struct Flatness {
    double rms, turn; /* of the depth beside its plane, m; greatest angle to the mean normal, rad */
} Flatness;

/* Depths of the sheet's middle as distances in front of a plane whose normal is n in the eye's frame. */
static Flatness flatness(const SplatScene *scene, const SplatPixel *pixels, const double n[3], bool filtered)
{
    double sum = 0, squares = 0, least = 1;
    int count = 0;
    for (int y = 45; y < 75; y++)
        for (int x = 60; x < 100; x++, count++) {
            const SplatPixel *p = &pixels[y * 160 + x];
            const double ray[3] = {(2 * (x + 0.5) / 160 - 1) * scene->frame.camera.tangent[0],
                                   (2 * (y + 0.5) / 120 - 1) * scene->frame.camera.tangent[1], -1};
            const double front = (filtered ? p->shown_depth : p->depth) * dot3(n, ray);
            const double *normal = filtered ? p->shown_normal : p->normal;
            sum += front, squares += front * front;
            least = fmin(least, dot3(normal, n) / sqrt(dot3(normal, normal)));
        }
    return (Flatness){sqrt(squares / count - sum * sum / count / count), acos(least)};
}

static void a_flat_surface_becomes_flatter(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        SplatScene scene = sheet(0.6 * i);
        const double n[3] = {0, sin(0.6 * i), cos(0.6 * i)};
        SplatPixel *pixels = splat_drawn(&scene);
        const Flatness before = flatness(&scene, pixels, n, false), after = flatness(&scene, pixels, n, true);
        if (after.rms > before.rms / 30 || after.turn > before.turn / 30)
            fail_msg("rms of depth %g before, %g after; turn of normals %g before, %g after", before.rms,
                     after.rms, before.turn, after.turn);
        free(pixels);
        free(scene.particles);
    }
}

/* Coverage is unchanged by the filter; a brim turns away, and a second sheet far behind is nearly
   undisturbed. */
static void outlines_stay(void **state)
{
    (void)state;
    SplatScene scene = sheet(0);
    const size_t count = scene.particles->count;
    for (size_t i = 0; i < count; i++) {
        const float *at = &scene.particles->position[4 * i];
        particles_add(scene.particles, at[0] - 0.5, at[1] + 0.2, at[2] - 1.5, 1, 1);
    }
    SplatPixel *both = splat_drawn(&scene);
    memmove(scene.particles->position, &scene.particles->position[4 * count], 4 * count * sizeof(float));
    scene.particles->count = count;
    SplatPixel *alone = splat_drawn(&scene);
    double moved[2] = {0};
    int front = 0, back = 0;
    for (int i = 0; i < 160 * 120; i++) {
        const bool covered = both[i].depth < 1e29, near = both[i].depth < 3.2;
        assert_int_equal(covered, both[i].shown_depth < 1e29);
        if (covered)
            assert_true(near == (both[i].shown_depth < 3.2 + SPACING));
        front += near, back += covered && !near;
        if (near)
            moved[0] = fmax(moved[0], fabs(both[i].shown_depth - both[i].depth));
        else if (covered)
            moved[1] = fmax(moved[1], fabs(both[i].shown_depth - alone[i].shown_depth));
    }
    if (moved[0] > 2.5 * SPACING || moved[1] > 0.5 * SPACING)
        fail_msg("the front sheet moves by up to %g radii; that behind is by %g where it would be alone",
                 moved[0] / SPACING, moved[1] / SPACING);
    assert_true(front > 2000 && back > 500);
    free(both);
    free(alone);
    free(scene.particles);
}

/* Drawn by the whole renderer; gives how many pixels the target's depth says are covered. */
static int covered(SplatScene *scene, int width, int height)
{
    Error error = {0};
    ParticleBuffers buffers;
    int count = 0;
    float *depth = calloc((size_t)width * (size_t)height, sizeof *depth);
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    buffers.count = scene->empty ? 0 : buffers.count;
    Renderer *renderer = renderer_create(&scene->def, &scene->world, width, height, &error);
    assert_true(depth && renderer);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, depth);
    for (int i = 0; i < width * height; i++)
        count += depth[i] > 0;
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(depth);
    return count;
}

static void strange_pictures(void **state)
{
    (void)state;
    SplatScene scene = sheet(0.3);
    assert_int_equal(covered(&scene, 1, 1), 1);
    assert_true(covered(&scene, 4096, 64) > 1000); /* each fourth pixel of the kernel or so */
    const int usual = covered(&scene, 160, 120);
    particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
    particles_add(scene.particles, 0.1, 0.5, NAN, 1, 0);
    particles_add(scene.particles, INFINITY, 0.5, 0, 1, 0);
    assert_int_equal(covered(&scene, 160, 120), usual);
    splat_def(&scene.def)->filter_size = 100, splat_def(&scene.def)->filter_iterations = 20;
    assert_int_equal(covered(&scene, 160, 120), usual);
    scene.empty = true;
    assert_int_equal(covered(&scene, 160, 120), 0);
    free(scene.particles);
}

/* `auto` is one smooth surface, opaque or clear, but where spheres or a level are asked for. */
static void what_auto_makes(void **state)
{
    (void)state;
    static const struct {
        SplatDef def;
        bool smooth;
    } cases[] = {
        {{.shading = SPLAT_PHONG, .weights = SPLAT_W1W2}, true},
        {{.shading = SPLAT_WATER, .weights = SPLAT_W1W2}, true},
        {{.shading = SPLAT_WATER, .weights = SPLAT_W1}, true},
        {{.shading = SPLAT_PHONG, .weights = SPLAT_W1}, false},
        {{.shading = SPLAT_PHONG, .weights = SPLAT_W1W2, .level = 0.1F}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        SplatDef def = cases[i].def;
        def.shape = SPLAT_SHAPE_AUTO, def.filter = SPLAT_FILTER_AUTO;
        assert_int_equal(splat_shape(&def), cases[i].smooth ? SPLAT_ELLIPSOID : SPLAT_PERSPECTIVE);
        assert_int_equal(splat_filter(&def), cases[i].smooth ? SPLAT_NARROW_RANGE : SPLAT_NO_FILTER);
        def.shape = SPLAT_PAPER, def.filter = SPLAT_NO_FILTER;
        assert_int_equal(splat_shape(&def), SPLAT_PAPER);
        assert_int_equal(splat_filter(&def), SPLAT_NO_FILTER);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_flat_surface_becomes_flatter, no_gl_errors),
        cmocka_unit_test_teardown(the_same_with_each_shading, no_gl_errors),
        cmocka_unit_test_teardown(outlines_stay, no_gl_errors),
        cmocka_unit_test_teardown(strange_pictures, no_gl_errors),
        cmocka_unit_test(what_auto_makes),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
