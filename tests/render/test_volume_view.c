/* View `volume`, with a slice: the colours of the field, from any direction. */
#include "tests/render/volume_fixture.h"

#include "render/frame/frame.h"
#include "render/views/volume/volume.h"

enum { SIZE = 96 };

static ViewDef slice_def(const VolumeScene *scene, const double from[3], const double to[3])
{
    ViewDef def = bare_view();
    text_set(def.kind, "volume");
    *volume_def(&def) = scene->def;
    volume_def(&def)->show = VOLUME_SLICE;
    def.camera_auto = false;
    def.camera.fov_deg = 30;
    memcpy(def.camera.from, from, sizeof def.camera.from);
    memcpy(def.camera.to, to, sizeof def.camera.to);
    return def;
}

static void picture_of(const ViewDef *def, VolumeScene *scene, uint8_t *rgb)
{
    Error error = {0};
    ParticleBuffers buffers;
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(def, NULL, SIZE, SIZE, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

/* True if the colour is the map's for a value within the tolerance. */
static bool has_color_of(const uint8_t *rgb, double value, double within)
{
    uint8_t map[3 * COLORMAP_SIZE];
    assert_true(colormap_fill("viridis", map));
    for (int i = 0; i < COLORMAP_SIZE; i++)
        if (fabs(i * 1.25 / 255 - fmin(value, 1.25)) <= within && abs(map[3 * i] - rgb[0]) <= 2 &&
            abs(map[3 * i + 1] - rgb[1]) <= 2 && abs(map[3 * i + 2] - rgb[2]) <= 2)
            return true;
    return false;
}

/* The slice ends at the box, though the grid is larger. */
static void test_slice_ends_at_the_box(void **state)
{
    (void)state;
    Error error = {0};
    static float depth[SIZE * SIZE];
    ParticleBuffers buffers;
    VolumeScene scene = volume_scene(0.08, 128);
    add_fluid(&scene);
    scene.def.slice_axis = 2;
    scene.def.slice = 0.5;
    const ViewDef def = slice_def(&scene, (double[3]){0, 0.5, 5}, (double[3]){0, 0.5, 0});
    scene.state.count = scene.particles->count;
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    Renderer *renderer = renderer_create(&def, NULL, SIZE, SIZE, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, depth);
    const double pixel = 2 * 5 * tan(15 * 3.14159265358979 / 180) / SIZE;
    int covered = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int column = i % SIZE, row = i / SIZE;
        const double x = (column + 0.5 - SIZE / 2.0) * pixel, y = (row + 0.5 - SIZE / 2.0) * pixel;
        covered += depth[i] > 0;
        assert_true(depth[i] == 0 || (fabs(x) < 1 && fabs(y) < 0.5));
    }
    assert_true(covered > SIZE * SIZE / 5);
    renderer_destroy(renderer);
    upload_destroy(upload);
    volume_scene_free(&scene);
}

/* Looks along an axis at the slice across it. */
static void compare_slice(VolumeMethod method, int axis, double place, double within)
{
    VolumeScene scene = volume_scene(0.08, 128);
    add_fluid(&scene);
    scene.def.method = method;
    scene.def.slice_axis = axis;
    scene.def.slice = place;
    const double low[3] = {-1, 0, -0.5}, size[3] = {2, 1, 1}, middle = low[axis] + place * size[axis];
    double to[3] = {-0.75, 0.2, -0.2}, from[3];
    to[axis] = middle;
    memcpy(from, to, sizeof from);
    from[axis] += 2;
    if (axis == 1)
        from[2] += 1e-3; /* up is not along the sight */
    const ViewDef def = slice_def(&scene, from, to);
    uint8_t rgb[3 * SIZE * SIZE];
    picture_of(&def, &scene, rgb);
    static const int across[3] = {2, 0, 0}, upward[3] = {1, 2, 1}, across_sign[3] = {-1, 1, 1},
                     up_sign[3] = {1, -1, 1};
    const double pixel = 2 * 2 * tan(15 * 3.14159265358979 / 180) / SIZE; /* m in the slice */
    int inside = 0;
    for (int y = 2; y < SIZE; y += 5)
        for (int x = 2; x < SIZE; x += 5) {
            double at[3], field, scalar;
            memcpy(at, to, sizeof at);
            at[across[axis]] += across_sign[axis] * (x + 0.5 - SIZE / 2.0) * pixel;
            at[upward[axis]] += up_sign[axis] * (SIZE / 2.0 - y - 0.5) * pixel;
            if (at[0] < -0.98 || at[1] < 0.02 || at[2] < -0.48)
                continue; /* beside the box */
            brute_field(&scene, at, &field, &scalar);
            inside += field > 0.5;
            if (!has_color_of(&rgb[3 * (y * SIZE + x)], field, within))
                fail_msg("%s, axis %d: at %g %g %g, where F is %g, the colour is %d %d %d",
                         volume_method_names[method], axis, at[0], at[1], at[2], field,
                         rgb[3 * (y * SIZE + x)], rgb[3 * (y * SIZE + x) + 1], rgb[3 * (y * SIZE + x) + 2]);
        }
    assert_true(inside > 20);
    volume_scene_free(&scene);
}

static void a_slice_shows_the_field(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        compare_slice(VOLUME_DIRECT, axis, axis == 2 ? 0.25 : 0.1, 0.02);
        compare_slice(VOLUME_SLABS, axis, axis == 2 ? 0.25 : 0.1, 0.04);
    }
}

/* In the slice, in the volume, behind, along; without particles, and with non-finite positions. */
static void from_wherever_one_looks(void **state)
{
    (void)state;
    static const double froms[][3] = {{0, 0.5, 0},
                                      {-0.8, 0.2, -0.3},
                                      {0, 0.5, -6},
                                      {3, 0.5, 0},
                                      {0, 40, 1e-3}},
                        tos[][3] = {{1, 0.5, 0}, {-0.8, 0.2, 1}, {0, 0.5, -9}, {0, 0.5, 0}, {0, 0.5, 0}};
    uint8_t rgb[3 * SIZE * SIZE];
    VolumeScene scene = volume_scene(0.08, 32);
    for (int i = 0; i < 5; i++)
        for (int bounds = VOLUME_BOX; bounds <= VOLUME_FLUID; bounds++) {
            scene.def.bounds = (VolumeBounds)bounds;
            const ViewDef def = slice_def(&scene, froms[i], tos[i]);
            scene.particles->count = 0;
            picture_of(&def, &scene, rgb);
            add_fluid(&scene);
            add_volume(&scene, NAN, NAN, NAN, NAN, NAN);
            picture_of(&def, &scene, rgb);
        }
    volume_scene_free(&scene);
}

static void methods_are_swapped_while_it_runs(void **state)
{
    (void)state;
    Error error = {0};
    ParticleBuffers buffers;
    VolumeScene scene = volume_scene(0.08, 64);
    add_fluid(&scene);
    scene.state.count = scene.particles->count;
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    ViewDef def = slice_def(&scene, (double[]){-0.7, 0.3, 2}, (double[]){-0.7, 0.2, 0});
    volume_def(&def)->slice = 0.2;
    uint8_t first[3 * SIZE * SIZE], rgb[3 * SIZE * SIZE];
    Renderer *renderer = renderer_create(&def, NULL, SIZE, SIZE, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, first);
    for (int turn = 0; turn < 2 * VOLUME_DIRECT; turn++) {
        volume_def(&def)->method = (VolumeMethod)(turn % VOLUME_DIRECT); /* direct does not interpolate */
        volume_def(&def)->bounds = (VolumeBounds)(turn / VOLUME_DIRECT);
        assert_true(renderer_set_def(renderer, &def, NULL, &error));
        renderer_draw(renderer, &buffers, NULL);
        renderer_read(renderer, rgb);
        int apart = 0;
        for (int i = 0; i < SIZE * SIZE; i++)
            apart += abs(rgb[3 * i] - first[3 * i]) > 4;
        if (turn < VOLUME_DIRECT && apart > SIZE * SIZE / 200)
            fail_msg("%s: %d pixels differ", volume_method_names[volume_def(&def)->method], apart);
    }
    renderer_destroy(renderer);
    upload_destroy(upload);
    volume_scene_free(&scene);
}

/* The legend describes the colormap: the field of a slice, the number of steps, or the scalar. */
static void a_legend_is_of_what_is_shown(void **state)
{
    (void)state;
    static const struct {
        VolumeShow show;
        const char *shown;
        double most;
    } cases[] = {{VOLUME_SHADED, "speed", 3}, {VOLUME_SLICE, "field", 1.25}, {VOLUME_STEPS, "steps", 64}};
    for (int i = 0; i < 3; i++) {
        ViewDef def = bare_view();
        Frame frame = {.colors = {.name = "speed", .unit = "m/s", .range = {0, 3}, .by_fluid = i > 0}};
        volume_def(&def)->show = cases[i].show;
        view_volume.show(&def, &frame);
        assert_string_equal(frame.colors.name, cases[i].shown);
        assert_string_equal(frame.colors.unit, i > 0 ? "" : "m/s");
        assert_true(frame.colors.range[0] == 0 && frame.colors.range[1] == cases[i].most &&
                    !frame.colors.by_fluid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_slice_ends_at_the_box, no_gl_errors),
        cmocka_unit_test_teardown(a_slice_shows_the_field, no_gl_errors),
        cmocka_unit_test_teardown(from_wherever_one_looks, no_gl_errors),
        cmocka_unit_test_teardown(methods_are_swapped_while_it_runs, no_gl_errors),
        cmocka_unit_test(a_legend_is_of_what_is_shown),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
