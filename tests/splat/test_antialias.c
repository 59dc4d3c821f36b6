/* The outlines of the view splat against the truth: a picture of 8 x 8 times as many pixels, its light
 * averaged. */
#include "tests/splat/outlines_fixture.h"

enum { FINE = 8, WIDE = FINE * W, HIGH = FINE * H };

typedef struct Fine {
    uint8_t rgb[3 * WIDE * HIGH];
    float depth[WIDE * HIGH]; /* rows from the top down, as in rgb */
} Fine;

static void turn_over(float depth[WIDE * HIGH])
{
    for (int y = 0; y < HIGH / 2; y++)
        for (int x = 0; x < WIDE; x++) {
            const float below = depth[y * WIDE + x];
            depth[y * WIDE + x] = depth[(HIGH - 1 - y) * WIDE + x];
            depth[(HIGH - 1 - y) * WIDE + x] = below;
        }
}

static void draw_fine(const SolidsScene *scene, Fine *to)
{
    SolidsScene plain = *scene;
    splat_def(&plain.def)->antialias = false;
    draw_at(&plain, WIDE, HIGH, to->rgb, to->depth);
    turn_over(to->depth);
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

static Measured measure(SolidsScene *scene)
{
    static uint8_t with[3 * N], without[3 * N];
    Measured m = {0};
    SolidsScene solids = *scene;
    solids.particles = calloc(1, sizeof(Particles));
    particles_add(solids.particles, 0, -100, 0, 1, 0);
    draw_fine(scene, &fine);
    draw_fine(&solids, &empty);
    splat_def(&scene->def)->antialias = true;
    draw_at(scene, W, H, with, NULL);
    splat_def(&scene->def)->antialias = false;
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

static void expect_nearer(const char *what, SolidsScene *scene, double factor)
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
    SolidsScene scene = scene_of(10);
    expect_nearer("near", &scene, 3);
    scene = scene_of(22);
    expect_nearer("usual", &scene, 2.2);
    scene = scene_of(50);
    expect_nearer("far", &scene, 1.3);
    scene = scene_of(20);
    splat_def(&scene.def)->shape = SPLAT_PAPER;
    expect_nearer("paper", &scene, 2.5);
    scene = scene_of(20);
    splat_def(&scene.def)->filter = SPLAT_NARROW_RANGE;
    expect_nearer("filter", &scene, 2.4);
}

/* By rows: a level's outline is none of spheres. */
static void outlines_of_a_level(void **state)
{
    (void)state;
    SolidsScene scene = scene_of(20);
    scene.def.radius = 2;
    splat_def(&scene.def)->level = 0.3;
    expect_nearer("level", &scene, 1.6);
}

/* Threads as thick as a pixel, bright on dark, each over the one before and longer. */
static SolidsScene threads(void)
{
    SolidsScene scene = scene_of(45);
    scene.particles->count = 0;
    for (int i = 0; i < 600; i++) {
        const int thread = i / 50;
        const double along = 0.0075 * (i % 50);
        particles_add(scene.particles, -0.9 + along * (1 + thread % 3),
                      0.08 * thread + 0.13 * along * (thread % 4), 0, 1, 0);
    }
    for (int k = 0; k < 3; k++)
        scene.def.background[k] = 0.02, scene.world.fluids[0].color[k] = 1;
    splat_def(&scene.def)->level = 0.3;
    return scene;
}

/* What is mixed at the ends of threads, by outlines on both sides, is no darker or brighter than all around.
 */
static void outlines_of_threads(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    SolidsScene scene = threads();
    draw_at(&scene, W, H, with, NULL);
    splat_def(&scene.def)->antialias = false;
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
    SolidsScene scene = scene_of(20);
    for (size_t i = 0; i < scene.particles->count; i++) /* half are far apart */
        if (i % 2)
            for (int k = 0; k < 3; k++)
                scene.particles->position[4 * i + k] =
                    (k == 1 ? 0.5F : 0.0F) + (k ? 0.5F : 1.0F) * (float)sin(12.9 * (double)i + 7.3 * k);
    splat_def(&scene.def)->drops = true;
    expect_nearer("drops", &scene, 2);
    scene = scene_of(20);
    splat_def(&scene.def)->shape = SPLAT_ELLIPSOID;
    expect_nearer("ellipsoids", &scene, 1.9);
}

/* A solid before the fluid, half inside, and behind: outlines of fluid before a solid, of a solid before
   fluid, and the contact line. */
static void outlines_with_solids(void **state)
{
    (void)state;
    SolidsScene scene = scene_of(30);
    scene_add(&scene, SOLID_SPHERE, 0.3, 0.4, 0.6);
    scene_add(&scene, SOLID_SPHERE, -0.5, 0.5, 0.3);
    scene_add(&scene, SOLID_BOX, 0.6, 0.6, -0.7);
    expect_nearer("solids", &scene, 1.6);
}

/* A pixel without an outline nearby is unchanged; a solid in front of hidden fluid too. */
static void the_inside_stays(void **state)
{
    (void)state;
    static uint8_t with[3 * N], without[3 * N];
    SolidsScene scene = scene_of(20), nothing = scene_of(20);
    scene_add(&scene, SOLID_SPHERE, 0.6, 0.8, 0.7);
    scene_add(&nothing, SOLID_SPHERE, 0.6, 0.8, 0.7);
    nothing.particles->count = 0;
    particles_add(nothing.particles, 0, -100, 0, 1, 0);
    draw_fine(&scene, &fine);
    draw_fine(&nothing, &empty);
    splat_def(&scene.def)->antialias = true;
    draw_at(&scene, W, H, with, NULL);
    splat_def(&scene.def)->antialias = false;
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
        SolidsScene scene = scene_of(100);
        splat_def(&scene.def)->show = (SplatShow)show;
        draw_at(&scene, W, H, with, NULL);
        splat_def(&scene.def)->antialias = false;
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
        SolidsScene scene = scene_of(30);
        splat_def(&scene.def)->shape = (SplatShape)shape;
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
        cmocka_unit_test_teardown(strange_pictures, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
