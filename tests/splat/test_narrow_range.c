/* The narrow-range filter of the view splat, on synthetic depth maps: against formulas in double, and
   invariants. */
#include "tests/splat/splat_fixture.h"

#include "render/views/splat/splat_private.h"
#include "shaders/splat/splat_bindings.h"

enum { W = 64, H = 48, N = W * H };

static const double radius = 0.06, nothing = SPLAT_NOTHING;

typedef struct Map {
    SplatDef splat;
    double range;    /* m */
    bool first_tile; /* the others are not listed */
    Frame frame;
    float before[N];
    float depth[N], normal[3 * N];
} Map;

static Map map_create(void)
{
    Map map = {.splat = splat_usual};
    map.range = map.splat.filter_range * radius;
    return map;
}

static unsigned upload_map(const Target *target, GLenum format, GLenum of, const float *values)
{
    const unsigned map = splat_map_create(format, target, "test");
    glTextureSubImage2D(map, 0, 0, 0, W, H, of, GL_FLOAT, values);
    return map;
}

static void keep(float *to, unsigned map, GLenum format, int components)
{
    float *values = read_map(map, format, N, components);
    memcpy(to, values, (size_t)(components * N) * sizeof *to);
    free(values);
}

/* All tiles of a new target are marked. */
static FluidTiles tiles_create(const Map *map, const Target *target)
{
    static const GLuint none = 0;
    Error error = {0};
    FluidTiles tiles;
    if (!fluid_tiles_create(&tiles, &error))
        fail_msg("%s", error.message);
    fluid_tiles_update(&tiles, target);
    if (map->first_tile)
        glClearNamedBufferSubData(tiles.marks, GL_R32UI, sizeof none,
                                  (W / TILE * (H / TILE) - 1) * sizeof none, GL_RED_INTEGER, GL_UNSIGNED_INT,
                                  &none);
    fluid_tiles_list(&tiles, &map->frame, false);
    return tiles;
}

static void run(const Map *map, const Target *target, float depth[N], float normal[3 * N])
{
    static const float facing[3 * N];
    Error error = {0};
    NarrowRange filter;
    SplatMaps maps = {.nearest = upload_map(target, GL_R32F, GL_RED, map->before),
                      .normal = upload_map(target, GL_RGBA32F, GL_RGB, facing)};
    FluidTiles tiles = tiles_create(map, target);
    if (!narrow_range_create(&filter, false, &error))
        fail_msg("%s", error.message);
    const SplatMaps shown = narrow_range_draw(&filter, &maps, &tiles, &map->frame);
    keep(depth, shown.nearest, GL_RED, 1);
    keep(normal, shown.normal, GL_RGB, 3);
    narrow_range_destroy(&filter);
    fluid_tiles_destroy(&tiles);
    glDeleteTextures(2, (GLuint[]){maps.nearest, maps.normal});
}

/* Fills depth and normal from before. The eye looks straight ahead, 40 degrees high. */
static void filter_map(Map *map)
{
    Error error = {0};
    Target target;
    ViewDef def = bare_view();
    const WorldDef world = bare_world();
    ParticleBuffers buffers = box_state(0, radius);
    assert_true(target_create(&target, W, H, &error));
    *splat_def(&def) = map->splat, def.radius = 1;
    def.camera_auto = false, def.camera = (CameraDef){{0, 0.5, 3}, {0, 0.5, 0}, 40};
    frame_make(&map->frame, &(Subject){&def, &world}, &buffers, &target, view_ball_radii(&def, &buffers, 1),
               (CoveredParts){0});
    memcpy(map->frame.extent.bounds, (float[4]){-1, 1, -1, 1}, sizeof map->frame.extent.bounds);
    const unsigned uniforms = frame_uniforms_create();
    frame_uniforms_update(uniforms, &map->frame, buffers.box_size, buffers.spacing);
    target_begin(&target);
    run(map, &target, map->depth, map->normal);
    map->frame.def = NULL, map->frame.world = NULL, map->frame.target = NULL;
    glDeleteBuffers(1, &uniforms);
    target_destroy(&target);
}

/* Slopes of the ray through a pixel, at a depth of 1. */
static void ray_of(const Map *map, int x, int y, double ray[2])
{
    ray[0] = (2 * (x + 0.5) / W - 1) * map->frame.camera.tangent[0];
    ray[1] = (2 * (y + 0.5) / H - 1) * map->frame.camera.tangent[1];
}

typedef struct Limits {
    double low, high;
} Limits;

/* Whether a 1 / depth counts; `range` is that at the middle. */
static bool admitted(double v, Limits *limits, double range)
{
    if (v < limits->low || v > limits->high)
        return false;
    limits->low = fmin(limits->low, v - range), limits->high = fmax(limits->high, v + range);
    return true;
}

/* The mean of 1 / z over pairs of opposite pixels; 0 ends the offsets. */
static double mean(const Map *map, const double *z, int at, const int (*offsets)[2], const double *weights,
                   bool by_side)
{
    const double middle = 1 / z[at], range = map->range * middle * middle;
    Limits one = {middle - range, middle + range}, other = one;
    double sum = middle, total = 1;
    for (; (*offsets)[0] || (*offsets)[1]; offsets++, weights++) {
        const int x = at % W, y = at / W, dx = abs((*offsets)[0]), dy = abs((*offsets)[1]);
        if (x < dx || x + dx >= W || y < dy || y + dy >= H)
            continue;
        const int step = (*offsets)[1] * W + (*offsets)[0];
        const double a = 1 / z[at + step], b = 1 / z[at - step];
        const bool first = admitted(a, &one, range), second = admitted(b, by_side ? &other : &one, range);
        if (first && second)
            sum += *weights * (a + b), total += 2 * *weights;
    }
    return total / sum;
}

static double bell(double q2)
{
    return pow(1 - q2, 3);
}

static double pass_along(const Map *map, const double *z, int at, int dx, int dy)
{
    int offsets[NARROW_RANGE_TAPS + 1][2] = {{0}}, count = 0;
    double weights[NARROW_RANGE_TAPS];
    const double reach = map->splat.filter_size * radius / z[at] * H / (2 * map->frame.camera.tangent[1]);
    const int stride = (int)fmax(ceil(reach / NARROW_RANGE_TAPS), 1);
    for (int k = stride; k < reach; k += stride, count++) {
        offsets[count][0] = k * dx, offsets[count][1] = k * dy;
        weights[count] = bell(k * k / (reach * reach));
    }
    return mean(map, z, at, (const int(*)[2])offsets, weights, true);
}

static double clean_up(const Map *map, const double *z, int at)
{
    static const int offsets[][2] = {{1, 0},  {0, 1}, {1, 1},  {1, -1}, {2, 0},  {0, 2}, {2, 1},
                                     {2, -1}, {1, 2}, {-1, 2}, {2, 2},  {2, -2}, {0, 0}};
    double weights[12];
    for (int i = 0; i < 12; i++)
        weights[i] = bell((offsets[i][0] * offsets[i][0] + offsets[i][1] * offsets[i][1]) / 9.0);
    return mean(map, z, at, offsets, weights, false);
}

static void wanted(const Map *map, double z[N])
{
    static double from[N];
    for (int i = 0; i < N; i++)
        z[i] = map->before[i];
    for (int pass = 0; pass <= 2 * map->splat.filter_iterations; pass++) {
        const bool last = pass == 2 * map->splat.filter_iterations;
        memcpy(from, z, sizeof from);
        for (int i = 0; i < N; i++)
            if (from[i] < 1e29)
                z[i] = last ? clean_up(map, from, i) : pass_along(map, from, i, pass % 2 == 0, pass % 2);
    }
}

/* Bumps, steps of less and of more than the range, and a hole. */
static double rough(int x, int y)
{
    const double bumps = 0.05 * sin(1.3 * x + 0.2 * y) * cos(0.9 * y) + 0.01 * sin(78.2 * x + 12.9 * y);
    if ((x - 20) * (x - 20) + (y - 30) * (y - 30) < 40)
        return nothing;
    return (x > 40 ? 2.6 : x > 30 ? 2.3 : 2.2) + bumps + (y > 25 ? 0.004 * (y - 25) * (y - 25) : 0);
}

static void as_its_formulas_in_double(void **state)
{
    (void)state;
    static double z[N];
    const double sizes[] = {4, 7.5, 50}; /* the last takes each third pixel or so */
    for (int i = 0; i < 3; i++) {
        Map map = map_create();
        double moved = 0;
        map.splat.filter_size = sizes[i], map.splat.filter_iterations = 1 + i % 2;
        for (int k = 0; k < N; k++)
            map.before[k] = (float)rough(k % W, k / W);
        filter_map(&map);
        wanted(&map, z);
        for (int k = 0; k < N; k++) {
            moved = fmax(moved, fabs((double)map.depth[k] - (double)map.before[k]));
            if (fabs(map.depth[k] - z[k]) > 4e-6 * z[k])
                fail_msg("size %g, pixel %d %d: %.8g, formula %.8g", sizes[i], k % W, k / W, map.depth[k],
                         z[k]);
        }
        assert_true(moved > 0.02);
    }
}

static void a_constant_stays_to_the_bit(void **state)
{
    (void)state;
    Map map = map_create();
    for (int i = 0; i < N; i++)
        map.before[i] = 2.345F;
    filter_map(&map);
    assert_memory_equal(map.depth, map.before, sizeof map.before);
}

/* A software driver pays for every pixel of a pass: the filter runs where there may be fluid. */
static void only_listed_tiles_are_filtered(void **state)
{
    (void)state;
    Map map = map_create();
    map.first_tile = true;
    for (int i = 0; i < N; i++)
        map.before[i] = 2.345F;
    filter_map(&map);
    for (int i = 0; i < N; i++) {
        const float wanted = i % W < TILE && i / W < TILE ? 2.345F : SPLAT_NOTHING;
        assert_float_equal(map.depth[i], wanted, 0);
    }
}

/* Normal n, through a point 3 m ahead; with the picture's borders. */
static void planes_stay_planes(void **state)
{
    (void)state;
    static const double normals[][3] = {{0, 0, 1}, {0.6, 0, 0.8}, {-0.36, 0.48, 0.8}, {0.1, 0.97, 0.22}};
    for (int i = 0; i < 4; i++) {
        Map map = map_create();
        const double *n = normals[i], length = sqrt(dot3(n, n));
        filter_map(&map); /* for the camera */
        for (int k = 0; k < N; k++) {
            double ray[2];
            ray_of(&map, k % W, k / W, ray);
            map.before[k] = (float)(-3 * n[2] / (n[0] * ray[0] + n[1] * ray[1] - n[2]));
            if (!(map.before[k] > 0 && map.before[k] < 30))
                map.before[k] = SPLAT_NOTHING; /* beyond a horizon; its brim is no plane */
        }
        filter_map(&map);
        for (int k = 0; k < N; k++) {
            const int x = k % W, y = k / W;
            if (i == 3 && (y < 12 || y > 30))
                continue;
            if (fabs((double)map.depth[k] - (double)map.before[k]) > 3e-6 * map.before[k])
                fail_msg("plane %d, pixel %d %d: %.8g before, %.8g after", i, x, y, map.before[k],
                         map.depth[k]);
            for (int c = 0; c < 3; c++)
                if (fabs(map.normal[3 * k + c] - n[c] / length) > 2e-3)
                    fail_msg("plane %d, pixel %d %d: normal %g in %d, not %g", i, x, y, map.normal[3 * k + c],
                             c, n[c] / length);
        }
    }
}

/* A near sheet on the left, a far wall or empty space on the right: the greatest shifts towards each
   other. */
static void edge_moves(double near, double far, double *front, double *back)
{
    Map map = map_create();
    *front = *back = 0;
    for (int i = 0; i < N; i++)
        map.before[i] = (float)(i % W < W / 2 ? near : far);
    filter_map(&map);
    for (int i = 0; i < N; i++) {
        const double moved = (double)map.depth[i] - (double)map.before[i];
        if (i % W < W / 2)
            *front = fmax(*front, fabs(moved));
        else
            *back = fmax(*back, fabs(moved));
    }
}

/* Neither knows anything of the other. A gap that is just above the range closes a little in later passes. */
static void edges_stay(void **state)
{
    (void)state;
    const double fars[] = {2 + 5 * radius, 2.5, 9, nothing};
    for (int i = 0; i < 4; i++) {
        double front, back;
        edge_moves(2, fars[i], &front, &back);
        if (front > 0 || back > 0)
            fail_msg("wall at %g: the sheet moves by %g radii, the wall by %g", fars[i], front / radius,
                     back / radius);
    }
}

/* Steps within the range are smoothed, from both sides. */
static void one_surface_is_smoothed(void **state)
{
    (void)state;
    double front, back;
    edge_moves(2, 2 + 2 * radius, &front, &back);
    assert_true(front > 0.5 * radius && back > 0.5 * radius);
}

/* Those of a sheet and of a wall behind it. */
static void normals_do_not_cross_edges(void **state)
{
    (void)state;
    Map map = map_create();
    for (int i = 0; i < N; i++)
        map.before[i] = i % W < W / 2 ? 2 : 3;
    filter_map(&map);
    for (int i = 0; i < N; i++) {
        const float *n = &map.normal[3 * i];
        if (!(n[2] > (gl_renderer_is_software() ? 0.999999F : 0.999F))) /* halves there */
            fail_msg("pixel %d %d: normal %g %g %g", i % W, i / W, n[0], n[1], n[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(as_its_formulas_in_double, no_gl_errors),
        cmocka_unit_test_teardown(a_constant_stays_to_the_bit, no_gl_errors),
        cmocka_unit_test_teardown(only_listed_tiles_are_filtered, no_gl_errors),
        cmocka_unit_test_teardown(planes_stay_planes, no_gl_errors),
        cmocka_unit_test_teardown(edges_stay, no_gl_errors),
        cmocka_unit_test_teardown(one_surface_is_smoothed, no_gl_errors),
        cmocka_unit_test_teardown(normals_do_not_cross_edges, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
