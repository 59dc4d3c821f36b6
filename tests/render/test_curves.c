/* Opacity, size and colour of particles by scalars through curves: the view `spheres` against formulas. */
#include "tests/render/fixture.h"

#include "render/frame/frame.h"
#include "render/particles/particles.h"

enum { WIDTH = 200, HEIGHT = 150 };

static const double FROM[3] = {0, 0.5, 4}, TO[3] = {0, 0.5, 0};

typedef struct Rig {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    size_t count;
    float position[4 * PARTICLES_MAX], velocity[4 * PARTICLES_MAX], scalar[SCALAR_STATE_COUNT][PARTICLES_MAX];
} Rig;

static Rig *rig_create(double spacing)
{
    Rig *rig = calloc(1, sizeof *rig);
    assert_non_null(rig);
    rig->def = bare_view();
    rig->world = bare_world();
    rig->def.camera_auto = false;
    memcpy(rig->def.camera.from, FROM, sizeof FROM);
    memcpy(rig->def.camera.to, TO, sizeof TO);
    rig->def.camera.fov_deg = 30;
    rig->def.radius = 0.5;
    rig->state = box_state(0, spacing);
    return rig;
}

static void add(Rig *rig, double x, double y, double z, double pressure, double speed)
{
    const size_t i = rig->count++;
    assert_true(i < PARTICLES_MAX);
    float *at = &rig->position[4 * i];
    at[0] = (float)x, at[1] = (float)y, at[2] = (float)z, at[3] = 1;
    rig->velocity[4 * i + 1] = (float)pressure; /* velocity_y too */
    rig->scalar[SCALAR_PRESSURE][i] = (float)pressure;
    rig->scalar[SCALAR_SPEED][i] = (float)speed;
    rig->scalar[SCALAR_ID][i] = (float)(7 * i + 3);
}

/* Depth (rows from the bottom up) and colours (3 bytes, rows from the top down) of the picture; either may be
 * NULL. */
static void draw(Rig *rig, unsigned attributes, float *depth, uint8_t *rgb)
{
    Error error = {0};
    ParticleBuffers buffers;
    rig->state.count = rig->count;
    Upload *upload = upload_create(rig->count, attributes, &error);
    ParticleArrays arrays = {.position = rig->position, .velocity = rig->velocity};
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        arrays.scalar[s] = rig->scalar[s];
    assert_non_null(upload);
    assert_true(upload_write_arrays(upload, &arrays, &rig->state, &error) && upload_take(upload, &buffers));
    Renderer *renderer = renderer_create(&rig->def, &rig->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    if (depth)
        renderer_read_depth(renderer, depth);
    if (rgb)
        renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static const unsigned ALL = PARTICLE_VELOCITY | PARTICLE_SCALAR(SCALAR_SPEED) |
                            PARTICLE_SCALAR(SCALAR_PRESSURE) | PARTICLE_SCALAR(SCALAR_ID);

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Reversed depth of the nearest hit of the ray through a pixel, and how near the ray passes a rim, in radii
 * or in four pixels: points stand on the rasteriser's grid, of 256 places a pixel.
 */
static double trace(const Rig *rig, const double *radius, const Camera *camera, double px, double py,
                    double *rim)
{
    const double ray[3] = {(2 * px / WIDTH - 1) * camera->tangent[0],
                           (2 * py / HEIGHT - 1) * camera->tangent[1], -1};
    double best = 0;
    *rim = 1;
    for (size_t i = 0; i < rig->count; i++) {
        float eye[3];
        matrix_transform(camera->view, &rig->position[4 * i], eye);
        const double c[3] = {eye[0], eye[1], eye[2]}, r = radius[i], dd = dot(ray, ray), b = dot(ray, c);
        const double miss = sqrt(fmax(0, dot(c, c) - b * b / dd));
        if (r <= 0 || b <= 0)
            continue;
        const double pixel = 2 * camera->tangent[1] / HEIGHT * -c[2];
        *rim = fmin(*rim, fmin(fabs(miss - r) / r, fabs(miss - r) / (4 * pixel)));
        if (miss < r)
            best = fmax(best, camera->near_plane * dd / (b - sqrt(b * b - dd * (dot(c, c) - r * r))));
    }
    return best;
}

/* By hand: weights of two neighbours. */
static double curve(const ScalarCurve *said, double value)
{
    const ControlPoints *p = &said->curve;
    const double x = fmin(fmax((value - said->range[0]) / (said->range[1] - said->range[0]), 0), 1);
    int k = p->count - 1;
    while (k > 0 && p->x[k] > x)
        k--;
    if (x <= p->x[0] || k == p->count - 1)
        return p->y[x <= p->x[0] ? 0 : k];
    const double share = (x - p->x[k]) / (p->x[k + 1] - p->x[k]);
    return (1 - share) * p->y[k] + share * p->y[k + 1];
}

static const ScalarCurve bent = {
    .by = 1 + SCALAR_PRESSURE, .range = {100, 500}, .curve = {4, {0, 0.3, 0.6, 1}, {0.2, 1.4, 0, 0.9}}};

static void scatter(Rig *rig, int count)
{
    for (int i = 0; i < count; i++)
        add(rig, 0.8 * sin(12.9 * i), 0.5 + 0.4 * sin(78.2 * i), 0.4 * sin(37.7 * i), 50 + 500.0 * i / count,
            i);
}

/* Hit or miss at every pixel but those near a rim, and how far away. */
static void compare_depths(Rig *rig, const double *radius, double bound)
{
    static float depth[WIDTH * HEIGHT];
    Camera camera;
    int hits = 0;
    double worst = 0;
    camera_make(&rig->def, rig->state.box_size, &rig->state.box, (double)WIDTH / HEIGHT, (CoveredParts){0},
                &camera);
    draw(rig, ALL, depth, NULL);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double rim;
            const double wanted = trace(rig, radius, &camera, x + 0.5, y + 0.5, &rim),
                         drawn = depth[y * WIDTH + x];
            hits += drawn > 0;
            if (rim < 2e-3)
                continue;
            if ((wanted > 0) != (drawn > 0))
                fail_msg("pixel %d %d: depth %g, formula %g", x, y, drawn, wanted);
            if (wanted > 0)
                worst = fmax(worst, fabs(wanted / drawn - 1));
        }
    printf("distances are off by %.1e of them\n", worst);
    assert_true(hits > 500 && worst < (snaps() ? fmax(bound, 2e-4) : bound));
}

/* Points and, with the eye among them, quads; some are of no size. */
static void sizes_are_exact(void **state)
{
    (void)state;
    static double radius[PARTICLES_MAX];
    Rig *rig = rig_create(0.12);
    rig->def.size = bent;
    scatter(rig, 120);
    for (size_t i = 0; i < rig->count; i++)
        radius[i] = 0.06 * curve(&bent, rig->scalar[SCALAR_PRESSURE][i]);
    compare_depths(rig, radius, 1.5e-4); /* a tenth of a pixel wide, spheres show the grid of points */
    memcpy(rig->def.camera.from, (double[]){0.3, 0.6, 0.7}, sizeof FROM);
    compare_depths(rig, radius, 1e-5);
    free(rig);
}

/* Spheres of the view splat, each with a separate size and gaps between, against `spheres`. */
static void splats_have_the_same_sizes(void **state)
{
    (void)state;
    static float sphere[WIDTH * HEIGHT], splat[WIDTH * HEIGHT];
    Rig *rig = rig_create(0.12);
    rig->def.size = bent;
    rig->def.size.curve = (ControlPoints){4, {0, 0.1, 0.5, 1}, {0, 0, 2, 0.8}};
    for (int i = 0; i < 18; i++)
        add(rig, -0.75 + 0.3 * (i % 6), 0.2 + 0.3 * (int)(i / 6), 0, 60 + 26 * i, i);
    draw(rig, ALL, sphere, NULL);
    text_set(rig->def.kind, "splat");
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++) {
        int differ = 0, hits = 0;
        splat_def(&rig->def)->antialias = false, splat_def(&rig->def)->sprite = (SplatSprite)sprite;
        draw(rig, ALL, splat, NULL);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            hits += sphere[i] > 0;
            differ += (sphere[i] > 0) != (splat[i] > 0) || fabs(sphere[i] - splat[i]) > 1e-3 * sphere[i];
        }
        printf("%d of %d pixels differ\n", differ, hits);
        assert_true(hits > 1000 && differ == 0);
    }
    free(rig);
}

/* A state without the scalar is drawn as without the curve. */
static void what_is_not_there_changes_nothing(void **state)
{
    (void)state;
    static float with[WIDTH * HEIGHT], without[WIDTH * HEIGHT];
    Rig *rig = rig_create(0.12);
    scatter(rig, 60);
    draw(rig, PARTICLE_SCALAR(SCALAR_SPEED), without, NULL);
    rig->def.size = rig->def.opacity = bent;
    draw(rig, PARTICLE_SCALAR(SCALAR_SPEED), with, NULL);
    assert_memory_equal(with, without, sizeof with);
    rig->def.size.curve = rig->def.opacity.curve = (ControlPoints){1, {0}, {1}}; /* nor does a curve of 1 */
    draw(rig, ALL, with, NULL);
    assert_memory_equal(with, without, sizeof with);
    rig->def.opacity.curve = (ControlPoints){1, {0}, {0}};
    draw(rig, ALL, with, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_true(with[i] == 0);
    free(rig);
}

/* A scalar that no backend writes, and the range of up to a hundred particles: least and greatest. */
static void a_derived_scalar_does_as_well(void **state)
{
    (void)state;
    static float said[WIDTH * HEIGHT], found[WIDTH * HEIGHT];
    Rig *rig = rig_create(0.12);
    scatter(rig, 80);
    rig->def.size = rig->def.opacity = bent;
    rig->def.opacity.curve = (ControlPoints){2, {0, 1}, {0.3, 1}};
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        const double high = rig->scalar[SCALAR_PRESSURE][79], low = symmetric ? -high : 50;
        memcpy(rig->def.size.range, (double[]){low, high}, sizeof rig->def.size.range);
        memcpy(rig->def.opacity.range, (double[]){low, high}, sizeof rig->def.opacity.range);
        rig->def.size.by = rig->def.opacity.by = 1 + SCALAR_PRESSURE;
        rig->def.size.range_auto = rig->def.opacity.range_auto = false;
        draw(rig, ALL, said, NULL);
        rig->def.size.by = rig->def.opacity.by = 1 + SCALAR_VELOCITY_Y;
        rig->def.size.range_auto = rig->def.opacity.range_auto = true;
        rig->def.size.range_symmetric = rig->def.opacity.range_symmetric = symmetric;
        draw(rig, ALL, found, NULL);
        assert_memory_equal(said, found, sizeof said);
    }
    free(rig);
}

static int covered(const float *depth)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += depth[i] > 0;
    return count;
}

/* `deep` particles in a row: covered share of a disc of some 700 pixels. */
static double coverage(double opacity, int deep, int id)
{
    static float depth[WIDTH * HEIGHT];
    double share[2];
    for (int veiled = 0; veiled < 2; veiled++) {
        Rig *rig = rig_create(0.4);
        for (int i = 0; i < deep; i++) {
            add(rig, 0, 0.5, 0, 1, 1);
            rig->scalar[SCALAR_ID][i] = (float)(id + i);
        }
        rig->def.opacity =
            (ScalarCurve){.by = 1 + SCALAR_PRESSURE, .range = {0, 1}, .curve = {1, {0}, {opacity}}};
        rig->def.opacity.by *= veiled;
        draw(rig, ALL, depth, NULL);
        share[veiled] = covered(depth);
        free(rig);
    }
    assert_true(share[0] > 500);
    return share[1] / share[0];
}

/* A single particle by an even threshold; several particles like blending, 1 - (1 - a)^n, in the mean
   over ids. */
static void doors_cover_as_much_as_is_opaque(void **state)
{
    (void)state;
    double worst = 0, mean[4] = {0};
    enum { IDS = 24 };
    for (int k = 1; k < 10; k++)
        worst = fmax(worst, fabs(coverage(0.1 * k, 1, 100 * k) - 0.1 * k));
    for (int deep = 2; deep < 4; deep++)
        for (int id = 0; id < IDS; id++)
            mean[deep] += coverage(0.4, deep, 10 * id) / IDS;
    printf("one: off by %.4f; two of 0.4: %.4f, %.4f wanted; three: %.4f, %.4f wanted\n", worst, mean[2],
           1 - 0.6 * 0.6, mean[3], 1 - 0.6 * 0.6 * 0.6);
    assert_true(worst < 0.01);
    assert_true(fabs(mean[2] - (1 - 0.36)) < 0.05 && fabs(mean[3] - (1 - 0.216)) < 0.05);
    assert_true(coverage(0, 1, 5) == 0 && coverage(1, 1, 5) == 1);
}

/* The threshold depends on the id only, not on order or further particles. */
static void a_door_is_of_an_id(void **state)
{
    (void)state;
    static float one[WIDTH * HEIGHT], other[WIDTH * HEIGHT];
    Rig *rig = rig_create(0.4);
    rig->def.opacity = (ScalarCurve){.by = 1 + SCALAR_PRESSURE, .range = {0, 1}, .curve = {1, {0}, {0.5}}};
    add(rig, 0, 0.5, 0, 1, 1);
    rig->scalar[SCALAR_ID][0] = 77;
    draw(rig, ALL, one, NULL);
    rig->count = 0;
    add(rig, 50, 50, 50, 1, 1);
    add(rig, 0, 0.5, 0, 1, 1);
    rig->scalar[SCALAR_ID][1] = 77;
    draw(rig, ALL, other, NULL);
    assert_memory_equal(one, other, sizeof one);
    rig->scalar[SCALAR_ID][1] = 78;
    draw(rig, ALL, other, NULL);
    assert_memory_not_equal(one, other, sizeof one);
    free(rig);
}

/* NaN is as large and as opaque as the high end of the range. */
static void nan_is_seen(void **state)
{
    (void)state;
    static float high[WIDTH * HEIGHT], none[WIDTH * HEIGHT];
    Rig *rig = rig_create(0.4);
    rig->def.size = rig->def.opacity = bent;
    rig->def.opacity.curve = control_points_straight();
    add(rig, 0, 0.5, 0, 500, 1);
    draw(rig, ALL, high, NULL);
    rig->scalar[SCALAR_PRESSURE][0] = NAN;
    draw(rig, ALL, none, NULL);
    assert_true(covered(high) > 100);
    assert_memory_equal(high, none, sizeof high);
    free(rig);
}

/* A curve on the colours is the colormap read elsewhere; pictures and legend have it from the same table. */
static void a_curve_bends_the_colormap(void **state)
{
    (void)state;
    uint8_t straight[3 * COLORMAP_SIZE], back[3 * COLORMAP_SIZE], flat[3 * COLORMAP_SIZE];
    const ControlPoints falling = {2, {0, 1}, {1, 0}}, half = {1, {0}, {0.5}};
    assert_true(colormap_fill("viridis", straight) && colormap_fill_bent("viridis", &falling, back) &&
                colormap_fill_bent("viridis", &half, flat));
    for (int i = 0; i < COLORMAP_SIZE; i++) {
        const int mirror = COLORMAP_SIZE - 1 - i;
        for (int k = 0; k < 3; k++)
            assert_true(abs(straight[3 * i + k] - back[3 * mirror + k]) <= 1);
        assert_memory_equal(&flat[3 * i], flat, 3);
    }
}

/* The colour in a picture follows at once, also where the renderer stays. */
static void a_picture_has_the_bent_colors(void **state)
{
    (void)state;
    static uint8_t rising[3 * WIDTH * HEIGHT], falling[3 * WIDTH * HEIGHT], swapped[3 * WIDTH * HEIGHT];
    Rig *rig = rig_create(0.4);
    rig->def.range_auto = false;
    rig->def.range[0] = 0, rig->def.range[1] = 1;
    add(rig, 0, 0.5, 0, 1, 0.25);
    draw(rig, ALL, NULL, rising);
    rig->def.color_curve = (ControlPoints){2, {0, 1}, {1, 0}};
    draw(rig, ALL, NULL, falling);
    rig->scalar[SCALAR_SPEED][0] = 0.75;
    draw(rig, ALL, NULL, swapped);
    assert_memory_not_equal(rising, falling, sizeof rising);
    int off = 0;
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        off = abs(rising[i] - swapped[i]) > off ? abs(rising[i] - swapped[i]) : off;
    assert_true(off <= 2);
    free(rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(sizes_are_exact, no_gl_errors),
        cmocka_unit_test_teardown(splats_have_the_same_sizes, no_gl_errors),
        cmocka_unit_test_teardown(what_is_not_there_changes_nothing, no_gl_errors),
        cmocka_unit_test_teardown(a_derived_scalar_does_as_well, no_gl_errors),
        cmocka_unit_test_teardown(doors_cover_as_much_as_is_opaque, no_gl_errors),
        cmocka_unit_test_teardown(a_door_is_of_an_id, no_gl_errors),
        cmocka_unit_test_teardown(nan_is_seen, no_gl_errors),
        cmocka_unit_test_teardown(a_curve_bends_the_colormap, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_has_the_bent_colors, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
