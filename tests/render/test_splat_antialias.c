/* The outlines of the view splat against the truth: a picture of 8 x 8 times as many pixels, its light
 * averaged. */
#include "tests/render/solids_fixture.h"

enum { FINE = 8, W = 80, H = 60, N = W * H, WIDE = FINE * W, HIGH = FINE * H };

static const double spacing = 0.06;

typedef struct Fine {
    uint8_t rgb[3 * WIDE * HIGH];
    float depth[WIDE * HIGH]; /* rows from the top down, as in rgb */
} Fine;

static void draw_at(const Scene *scene, int width, int height, uint8_t *rgb, float *depth)
{
    Error error = {0};
    ParticleBuffers buffers;
    ParticleBuffers state = scene->state;
    state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, width, height, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    if (depth)
        renderer_read_depth(renderer, depth);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static void turn_over(float depth[WIDE * HIGH])
{
    for (int y = 0; y < HIGH / 2; y++)
        for (int x = 0; x < WIDE; x++) {
            const float below = depth[y * WIDE + x];
            depth[y * WIDE + x] = depth[(HIGH - 1 - y) * WIDE + x];
            depth[(HIGH - 1 - y) * WIDE + x] = below;
        }
}

static void draw_fine(const Scene *scene, Fine *to)
{
    Scene plain = *scene;
    plain.def.splat.antialias = false;
    draw_at(&plain, WIDE, HIGH, to->rgb, to->depth);
    turn_over(to->depth);
}

static double linear_of(int code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double code_of(double linear)
{
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055);
}

/* sRGB codes of a pixel's mean light. */
static void truth(const Fine *of, int x, int y, double rgb[3])
{
    static double linear[256];
    if (linear[255] == 0)
        for (int i = 0; i < 256; i++)
            linear[i] = linear_of(i);
    double sums[3] = {0};
    for (int j = 0; j < FINE; j++)
        for (int i = 0; i < FINE; i++)
            for (int k = 0; k < 3; k++)
                sums[k] += linear[of->rgb[3 * ((FINE * y + j) * WIDE + FINE * x + i) + k]];
    for (int k = 0; k < 3; k++)
        rgb[k] = code_of(sums[k] / FINE / FINE);
}

static Fine fine, empty; /* the same without fluid */

typedef enum Place { INSIDE, OUTLINE, ELSEWHERE } Place;

/* Fluid is where the depth is not that of the picture without; an outline where a pixel has some, or some
   more than a radius behind the rest. */
static Place place_of(double apart, int x, int y)
{
    int fluid = 0;
    double least = INFINITY, most = 0;
    for (int j = 0; j < FINE; j++)
        for (int i = 0; i < FINE; i++) {
            const int at = (FINE * y + j) * WIDE + FINE * x + i;
            fluid += fine.depth[at] > empty.depth[at];
            least = fmin(least, 1 / fine.depth[at]), most = fmax(most, 1 / fine.depth[at]);
        }
    if (fluid == 0)
        return ELSEWHERE;
    return fluid < FINE * FINE || most > apart * least ? OUTLINE : INSIDE;
}

typedef struct Measured {
    double with, without; /* rms of the difference to the truth on outlines, codes of 255 */
    int pixels;
} Measured;

static Measured measure(Scene *scene)
{
    static uint8_t with[3 * N], without[3 * N];
    Measured m = {0};
    Scene solids = *scene;
    solids.particles = calloc(1, sizeof(Particles));
    particles_add(solids.particles, 0, -100, 0, 1, 0);
    draw_fine(scene, &fine);
    draw_fine(&solids, &empty);
    scene->def.splat.antialias = true;
    draw_at(scene, W, H, with, NULL);
    scene->def.splat.antialias = false;
    draw_at(scene, W, H, without, NULL);
    for (int i = 0; i < N; i++) {
        const int x = i % W, y = i / W;
        double wanted[3];
        truth(&fine, x, y, wanted);
        if (place_of(1.1, x, y) != OUTLINE)
            continue;
        m.pixels++;
        for (int k = 0; k < 3; k++) {
            m.with += pow(with[3 * i + k] - wanted[k], 2);
            m.without += pow(without[3 * i + k] - wanted[k], 2);
        }
    }
    m.with = sqrt(m.with / m.pixels / 3), m.without = sqrt(m.without / m.pixels / 3);
    free(solids.particles);
    return m;
}

static Scene scene_of(double fov_deg)
{
    Scene scene = scene_create();
    text_set(scene.def.kind, "splat");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera.fov_deg = fov_deg;
    scene.state.spacing = spacing;
    free(scene.particles);
    scene.particles = particles_wave(spacing);
    return scene;
}

static void expect_nearer(const char *what, Scene *scene, double factor)
{
    const Measured m = measure(scene);

    if (m.pixels < 100 || m.with * factor > m.without)
        fail_msg("%s: on %d pixels off by %g with, %g without; %g times less, not %g", what, m.pixels, m.with,
                 m.without, m.without / m.with, factor);
    free(scene->particles);
}

/* Spheres of 6, 3 and 1.2 pixels' radius; the last of the paper's shape. */
static void outlines_are_nearer_to_the_truth(void **state)
{
    (void)state;
    Scene scene = scene_of(10);
    expect_nearer("near", &scene, 3);
    scene = scene_of(22);
    expect_nearer("usual", &scene, 2.2);
    scene = scene_of(50);
    expect_nearer("far", &scene, 1.3);
    scene = scene_of(20);
    scene.def.splat.shape = SPLAT_PAPER;
    expect_nearer("paper", &scene, 2.5);
    scene = scene_of(20);
    scene.def.splat.filter = SPLAT_NARROW_RANGE;
    expect_nearer("filter", &scene, 2.5);
}

/* By rows: a level's outline is none of spheres. */
static void outlines_of_a_level(void **state)
{
    (void)state;
    Scene scene = scene_of(20);
    scene.def.radius = 2;
    scene.def.splat.level = 0.3;
    expect_nearer("level", &scene, 1.6);
}

/* Threads as thick as a pixel, bright on dark, each over the one before and longer. */
static Scene threads(void)
{
    Scene scene = scene_of(45);
    scene.particles->count = 0;
    for (int i = 0; i < 600; i++) {
        const int thread = i / 50;
        const double along = 0.0075 * (i % 50);
        particles_add(scene.particles, -0.9 + along * (1 + thread % 3),
                      0.08 * thread + 0.13 * along * (thread % 4), 0, 1, 0);
    }
    for (int k = 0; k < 3; k++)
        scene.def.background[k] = 0.02, scene.def.fluid_color[0][k] = 1;
    scene.def.splat.level = 0.3;
    return scene;
}

/* What is mixed at the ends of threads, by outlines on both sides, is no darker or brighter than all around.
 */
static void outlines_of_threads(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    Scene scene = threads();
    draw_at(&scene, W, H, with, NULL);
    scene.def.splat.antialias = false;
    draw_at(&scene, W, H, without, NULL);
    for (int y = 1; y < H - 1; y++)
        for (int x = 1; x < W - 1; x++) {
            const int here = with[3 * (y * W + x)];
            int low = 255, high = 0;
            for (int k = 0; k < 9; k++) {
                const int at = without[3 * ((y + k / 3 - 1) * W + x + k % 3 - 1)];
                low = at < low ? at : low, high = at > high ? at : high;
            }
            if (here < low - 1 || here > high + 1)
                fail_msg("pixel %d %d: %d, around it %d to %d", x, y, here, low, high);
        }
    expect_nearer("threads", &scene, 1.4);
}

static void outlines_of_drops_and_ellipsoids(void **state)
{
    (void)state;
    Scene scene = scene_of(20);
    for (size_t i = 0; i < scene.particles->count; i++) /* half of them are far from each other */
        if (i % 2)
            for (int k = 0; k < 3; k++)
                scene.particles->position[4 * i + k] =
                    (k == 1 ? 0.5F : 0.0F) + (k ? 0.5F : 1.0F) * (float)sin(12.9 * (double)i + 7.3 * k);
    scene.def.splat.drops = true;
    expect_nearer("drops", &scene, 2);
    scene = scene_of(20);
    scene.def.splat.shape = SPLAT_ELLIPSOID;
    expect_nearer("ellipsoids", &scene, 1.9);
}

/* One before the fluid, one that is half in it, one behind: outlines of the fluid before a solid, of a solid
   before the fluid, and where they meet. */
static void outlines_with_solids(void **state)
{
    (void)state;
    Scene scene = scene_of(30);
    scene_add(&scene, SOLID_SPHERE, 0.3, 0.4, 0.6);
    scene_add(&scene, SOLID_SPHERE, -0.5, 0.5, 0.3);
    scene_add(&scene, SOLID_BOX, 0.6, 0.6, -0.7);
    expect_nearer("solids", &scene, 1.6);
}

/* A pixel with no outline in it or next to it is what it is without; so is a solid before fluid that it
 * hides. */
static void the_inside_stays(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    Scene scene = scene_of(20), nothing = scene_of(20);
    scene_add(&scene, SOLID_SPHERE, 0.6, 0.8, 0.7);
    scene_add(&nothing, SOLID_SPHERE, 0.6, 0.8, 0.7);
    nothing.particles->count = 0;
    particles_add(nothing.particles, 0, -100, 0, 1, 0);
    draw_fine(&scene, &fine);
    draw_fine(&nothing, &empty);
    scene.def.splat.antialias = true;
    draw_at(&scene, W, H, with, NULL);
    scene.def.splat.antialias = false;
    draw_at(&scene, W, H, without, NULL);
    int inside = 0, changed = 0;
    for (int y = 1; y < H - 1; y++)
        for (int x = 1; x < W - 1; x++) {
            const Place here = place_of(1.025, x, y);
            bool all = true;
            for (int k = 0; k < 9; k++)
                all = all && place_of(1.025, x + k % 3 - 1, y + k / 3 - 1) == here;
            const bool same = memcmp(&with[3 * (y * W + x)], &without[3 * (y * W + x)], 3) == 0;
            if (all && here != OUTLINE && !same)
                fail_msg("pixel %d %d is changed", x, y);
            inside += all && here == INSIDE, changed += !same;
        }
    assert_true(inside > 1000 && changed > 150);
    free(scene.particles), free(nothing.particles);
}

static void what_came_before_shading_stays(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    for (int show = SPLAT_DEPTH; show <= SPLAT_WEIGHT; show++) {
        Scene scene = scene_of(100);
        scene.def.splat.show = (SplatShow)show;
        draw_at(&scene, W, H, with, NULL);
        scene.def.splat.antialias = false;
        draw_at(&scene, W, H, without, NULL);
        assert_memory_equal(with, without, sizeof with);
        free(scene.particles);
    }
}

/* Drops 0.3 pixels in radius, far from each other. */
static Scene drops(double radius_pixels)
{
    Scene scene = scene_of(30);
    scene.def.camera = (CameraDef){{0, 0.5, 3}, {0, 0.5, 0}, 30};
    scene.state.spacing = radius_pixels * 3 * tan(15 * M_PI / 180) / (H / 2.0);
    scene.particles->count = 0;
    for (int i = 0; i < 40; i++)
        particles_add(scene.particles, 0.8 * sin(12.9 * i), 0.5 + 0.6 * sin(78.2 * i), 0, 1, 1);
    return scene;
}

/* Light that they take from a picture; mean over a camera that moves by parts of a pixel, and its deviation.
 */
static void darkening(const Scene *scene, bool antialias, double *mean, double *deviation)
{
    static uint8_t rgb[3 * N], clear[3 * N];
    const double pixel = 3 * tan(15 * M_PI / 180) / (H / 2.0);
    double sum = 0, squares = 0;
    Error error = {0};
    ParticleBuffers buffers, state = scene->state;
    ViewDef def = scene->def, none = scene->def;
    def.splat.antialias = antialias;
    text_set(none.kind, "none");
    state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &state, &buffers);
    Renderer *renderer = renderer_create(&none, W, H, &error);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, clear);
    for (int i = 0; i < 16; i++) {
        def.camera.from[0] = def.camera.to[0] = (i % 8) * pixel / 8;
        def.camera.from[1] = def.camera.to[1] = 0.5 + (0.37 * i + (i > 7)) * pixel / 2;
        assert_true(renderer_set_def(renderer, &def, &error));
        renderer_draw(renderer, &buffers, NULL);
        renderer_read(renderer, rgb);
        double light = 0;
        for (int k = 0; k < N; k++) /* of blue, which the drops have next to none of */
            light += linear_of(clear[3 * k + 2]) - linear_of(rgb[3 * k + 2]);
        sum += light, squares += light * light;
    }
    *mean = sum / 16, *deviation = sqrt(fmax(squares / 16 - pow(sum / 16, 2), 0));
    renderer_destroy(renderer);
    upload_destroy(upload);
}

/* As much light as their area does, and alike wherever their centres are in pixels. */
static void small_drops_neither_vanish_nor_sparkle(void **state)
{
    (void)state;
    const double radii[] = {0.15, 0.3, 0.6};
    double one = 0;
    for (int i = 0; i < 3; i++) {
        Scene scene = drops(radii[i]);
        double with, without, flicker, flicker_without;
        darkening(&scene, true, &with, &flicker);
        darkening(&scene, false, &without, &flicker_without);
        one = i == 0 ? with / pow(radii[i], 2) : one;
        const double area = with / pow(radii[i], 2) / one; /* 1 where they take their area's share */
        if (flicker > 0.03 * with || flicker > flicker_without / 1.5 || area < 0.75 || area > 1.1)
            fail_msg("%g pixels: %g +- %g with, %g +- %g without; %g of its area", radii[i], with, flicker,
                     without, flicker_without, area);
        free(scene.particles);
    }
}

static int blue_pixels(const Scene *scene, bool antialias)
{
    static uint8_t rgb[3 * N];
    Scene other = *scene;
    int count = 0;
    other.def.splat.antialias = antialias;
    draw_at(&other, W, H, rgb, NULL);
    for (int i = 0; i < N; i++)
        count += rgb[3 * i] < 0.6 * rgb[3 * i + 2];
    return count;
}

/* Drops of the other fluid, smaller than pixels, before a wall of large ones: it is seen through them. */
static void small_drops_leave_no_hole(void **state)
{
    (void)state;
    static uint8_t rgb[3 * N];
    Scene scene = drops(0.4);
    const size_t count = scene.particles->count;
    const double r = scene.state.spacing;
    scene.def.fluid_color[1][0] = 0.03F, scene.def.fluid_color[1][1] = 0.22F,
    scene.def.fluid_color[1][2] = 0.55F;
    const int wide = (int)(1.2 / r), high = (int)(0.8 / r);
    for (int i = 0; i < wide * high; i++)
        particles_add(scene.particles, -0.6 + r * (i % wide), 0.1 + r * floor((double)i / wide), -0.5, 1, 0);
    const int wall = blue_pixels(&scene, false), with = blue_pixels(&scene, true);
    if (wall < 1000 || abs(with - wall) > wall / 10)
        fail_msg("of a wall of %d pixels %d are left behind small drops", wall, with);
    draw_at(&scene, W, H, rgb, NULL);
    for (int y = H / 2 - 10; y < H / 2 + 10; y++)
        for (int x = W / 2 - 10; x < W / 2 + 10; x++)
            if (rgb[3 * (y * W + x)] > 0.6 * rgb[3 * (y * W + x) + 2])
                fail_msg("a hole in the wall at %d %d, before %zu drops", x, y, count);
    free(scene.particles);
}

/* Where the view's radius is less than a spacing, spheres within eps do not cover a far body: what is behind
 * them does. */
static void a_far_body_is_opaque(void **state)
{
    (void)state;
    static uint8_t far[3 * N];
    Scene scene = scene_of(30);
    scene.def.camera = (CameraDef){{2.3, 3, 11}, {-0.7, 0.2, 0}, 20};
    scene.def.radius = 0.5;
    memcpy(scene.def.fluid_color[1], scene.def.fluid_color[0], sizeof(float[3]));
    memcpy(scene.def.background, (double[]){1, 0, 0}, sizeof scene.def.background);
    draw_at(&scene, W, H, far, NULL);
    int inside = 0;
    for (int y = H / 2 - 2; y < H / 2 + 2; y++)
        for (int x = W / 2 - 4; x < W / 2 + 4; x++)
            inside += 2 * far[3 * (y * W + x)] < far[3 * (y * W + x) + 2]; /* blue, not red */
    if (inside < 32)
        fail_msg("the background shows in %d of 32 pixels", 32 - inside);
    free(scene.particles);
}

/* Culling changes nothing, where spheres are smaller than pixels too. */
static void culling_changes_no_pixel(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    const double fov[] = {10, 60, 150};
    for (int i = 0; i < 4; i++) {
        Scene scene = scene_of(fov[i < 3 ? i : 2]);
        scene.def.splat.shape = i < 3 ? SPLAT_PERSPECTIVE : SPLAT_ELLIPSOID;
        draw_at(&scene, W, H, with, NULL);
        scene.def.splat.cull = false;
        draw_at(&scene, W, H, without, NULL);
        assert_memory_equal(with, without, sizeof with);
        free(scene.particles);
    }
}

static void strange_pictures(void **state)
{
    (void)state;
    static uint8_t rgb[3 * 4096 * 16], with[3 * N];
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_ELLIPSOID; shape += 2) {
        Scene scene = scene_of(30);
        scene.def.splat.shape = (SplatShape)shape;
        draw_at(&scene, 1, 1, rgb, NULL);
        draw_at(&scene, 4096, 16, rgb, NULL);
        draw_at(&scene, W, H, rgb, NULL);
        particles_add(scene.particles, NAN, 0.5, 0, 1, 0);
        draw_at(&scene, W, H, with, NULL);
        assert_memory_equal(rgb, with, sizeof with);
        particles_add(scene.particles, 1.2, 1.1, 2.99, 1, 0); /* around the eye */
        scene_add(&scene, SOLID_SPHERE, 0.3, 0.4, 0.6);
        draw_at(&scene, W, H, rgb, NULL);
        scene.particles->count = 0;
        particles_add(scene.particles, INFINITY, NAN, 0, 1, 0);
        draw_at(&scene, W, H, rgb, NULL);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(outlines_are_nearer_to_the_truth, no_gl_errors),
        cmocka_unit_test_teardown(outlines_of_a_level, no_gl_errors),
        cmocka_unit_test_teardown(outlines_of_threads, no_gl_errors),
        cmocka_unit_test_teardown(outlines_of_drops_and_ellipsoids, no_gl_errors),
        cmocka_unit_test_teardown(outlines_with_solids, no_gl_errors),
        cmocka_unit_test_teardown(the_inside_stays, no_gl_errors),
        cmocka_unit_test_teardown(what_came_before_shading_stays, no_gl_errors),
        cmocka_unit_test_teardown(small_drops_neither_vanish_nor_sparkle, no_gl_errors),
        cmocka_unit_test_teardown(small_drops_leave_no_hole, no_gl_errors),
        cmocka_unit_test_teardown(a_far_body_is_opaque, no_gl_errors),
        cmocka_unit_test_teardown(culling_changes_no_pixel, no_gl_errors),
        cmocka_unit_test_teardown(strange_pictures, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
