/* Solids in a picture: shadows on and of solids, and changes during a renderer's life. */
#include "tests/render/solids_fixture.h"

#include "render/frame/frame.h"

typedef struct Darker {
    double by;  /* mean over these pixels, levels of green */
    int pixels; /* that are darker by more than 4 levels */
} Darker;

/* Of the rows from `first` down: solid pixels, or floor and sky only. */
static Darker compare(const uint8_t *without, const uint8_t *with, const float *depth, bool something,
                      int first)
{
    Darker darker = {0};
    for (int row = first; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++) {
            const int at = 3 * (row * WIDTH + column) + 1, less = without[at] - with[at];
            if ((depth[(HEIGHT - 1 - row) * WIDTH + column] > 0) != something || less <= 4)
                continue;
            darker.by += less;
            darker.pixels++;
        }
    darker.by /= darker.pixels ? darker.pixels : 1;
    return darker;
}

/* A square of particles, side by side. */
static void add_layer(SolidsScene *scene, int side, double y, unsigned fluid)
{
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++)
            particles_add(scene->particles, 0.1 * (i - 0.5 * (side - 1)), y, 0.1 * (k - 0.5 * (side - 1)), 1,
                          fluid);
}

static void test_shadow_on_the_floor(void **state)
{
    (void)state;
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    static float depth[PIXELS];
    SolidsScene scene = scene_create();
    scene.def.floor = true;
    scene_add(&scene, SOLID_SPHERE, 0, 0.4, 0);
    draw_rgb(&scene, false, with);
    draw_depth(&scene, depth);
    scene.world.solid_count = 0;
    draw_rgb(&scene, false, without);
    const Darker darker = compare(without, with, depth, false, 0);
    assert_true(darker.by > 15);
    assert_true(darker.pixels > 300 && darker.pixels < 4000);
    free(scene.particles);
}

/* A ball in front of the box, beyond the box's shadow: the ball's shadow is complete. */
/* Beside and above the box are neither parts of solids nor shadows of such parts. */
static void test_no_shadow_of_what_is_cut_off(void **state)
{
    (void)state;
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    for (int above = 0; above <= 1; above++) {
        SolidsScene scene = scene_create();
        scene.def.floor = true;
        SolidDef *solid = scene_add(&scene, SOLID_BOX, above ? 0 : 1.31, above ? 1.2 : 0.5, 0);
        draw_rgb(&scene, false, with);
        solid->size[0] = solid->size[1] = solid->size[2] = 0.01;
        draw_rgb(&scene, false, without);
        assert_memory_equal(with, without, sizeof with);
        free(scene.particles);
    }
}

static void test_shadow_before_the_box(void **state)
{
    (void)state;
    static uint8_t rgb[3 * PIXELS];
    SolidsScene scene = scene_create();
    Camera camera;
    double pixel[2], depth;
    scene.def.floor = true;
    scene.def.camera = (CameraDef){{1.5, 1.5, 3}, {0, 0, 0.9}, 40};
    SolidDef *ball = scene_add(&scene, SOLID_SPHERE, 0, 0.3, 1);
    ball->radius = 0.15, ball->density = 500; /* afloat: not cut off at the box */
    draw_rgb(&scene, false, rgb);
    camera_make(&scene.def, scene.state.box_size, &scene.state.box, (double)WIDTH / HEIGHT, (CoveredParts){0},
                &camera);
    const double drop = (0.3 + 0.11) / 0.84, ground[3] = {0.40 * drop, -0.11, 1 - 0.3666 * drop};
    assert_true(camera_project(&camera, ground, WIDTH, HEIGHT, pixel, &depth));
    const uint8_t *at = rgb + 3 * ((int)pixel[1] * WIDTH + (int)pixel[0]);
    assert_true(at[1] + 25 < rgb[1]); /* than the corner of the picture */
    free(scene.particles);
}

/* Seen from the side: a receiver in the lower half of the picture, a caster in the upper half. */
static SolidsScene side_view(void)
{
    SolidsScene scene = scene_create();
    scene.def.camera = (CameraDef){{0, 0.9, 3.4}, {0, 0.2, 0}, 40};
    scene.def.color_by = SCALAR_FLUID;
    return scene;
}

static void add_plate(SolidsScene *scene, double y, double width, double depth)
{
    SolidDef *plate = scene_add(scene, SOLID_BOX, 0, y, 0);
    plate->size[0] = width, plate->size[1] = 0.06, plate->size[2] = depth;
    plate->color[1] = 0.8F;
}

static Darker shade_by_plate(bool fluid, bool plain)
{
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    static float depth[PIXELS];
    SolidsScene scene = side_view();
    if (fluid)
        add_layer(&scene, 20, 0.05, 1);
    else
        add_plate(&scene, 0.05, 2, 1);
    draw_rgb(&scene, plain, without);
    add_plate(&scene, 0.7, 0.6, 0.5);
    draw_rgb(&scene, plain, with);
    draw_depth(&scene, depth);
    free(scene.particles);
    return compare(without, with, depth, true, HEIGHT / 2);
}

static void test_shadow_on_fluid_and_on_solids(void **state)
{
    (void)state;
    for (int fluid = 0; fluid < 2; fluid++) {
        const Darker darker = shade_by_plate(fluid, false);
        assert_true(darker.by > 15);
        assert_true(darker.pixels > 100 && darker.pixels < 1000);
        assert_int_equal(shade_by_plate(fluid, true).pixels, 0);
    }
}

static void test_fluid_shades_solids(void **state)
{
    (void)state;
    static uint8_t with[3 * PIXELS], without[3 * PIXELS];
    static float depth[PIXELS];
    SolidsScene scene = side_view();
    add_plate(&scene, 0.05, 2, 1);
    draw_rgb(&scene, false, without);
    add_layer(&scene, 8, 0.7, 0);
    draw_rgb(&scene, false, with);
    draw_depth(&scene, depth);
    const Darker darker = compare(without, with, depth, true, HEIGHT / 2);
    assert_true(darker.by > 15);
    assert_true(darker.pixels > 100 && darker.pixels < 1000);
    free(scene.particles);
}

/* Alone in the light no solid has a shadow on itself: a plate is as bright all over. */
static void test_no_shadow_of_its_own(void **state)
{
    (void)state;
    static uint8_t rgb[3 * PIXELS];
    static float depth[PIXELS];
    SolidsScene scene = side_view();
    int least = 255, most = 0, seen = 0;
    add_plate(&scene, 0.05, 2, 1);
    scene.def.camera = (CameraDef){{0, 20, 0.01}, {0, 0, 0}, 10}; /* far from the highlight */
    draw_rgb(&scene, false, rgb);
    draw_depth(&scene, depth);
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++) {
            const int green = rgb[3 * ((HEIGHT - 1 - row) * WIDTH + column) + 1];
            if (depth[row * WIDTH + column] == 0)
                continue;
            least = green < least ? green : least;
            most = green > most ? green : most;
            seen++;
        }
    assert_true(seen > 1000);
    assert_true(least > 150);
    assert_true(most - least <= 3);
    free(scene.particles);
}

static void assert_like_new(Renderer *renderer, SolidsScene *scene, int width, int height)
{
    static uint8_t seen[3 * PIXELS], wanted[3 * PIXELS];
    Error error = {0};
    draw(scene, renderer);
    renderer_read(renderer, seen);
    Renderer *fresh = renderer_create(&scene->def, &scene->world, width, height, &error);
    assert_non_null(fresh);
    draw(scene, fresh);
    renderer_read(fresh, wanted);
    renderer_destroy(fresh);
    assert_memory_equal(seen, wanted, 3 * (size_t)width * (size_t)height);
}

static void test_def_and_size_follow(void **state)
{
    (void)state;
    Error error = {0};
    SolidsScene scene = scene_create();
    scene.def.floor = true;
    for (int i = 0; i < 60; i++)
        particles_add(scene.particles, 0.9 * sin(12.9 * i), 0.5 + 0.4 * sin(78.2 * i), 0.4 * sin(37.7 * i), 1,
                      0);
    Renderer *renderer = drawn(&scene);
    scene_add(&scene, SOLID_SPHERE, 0, 0.5, 0);
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_like_new(renderer, &scene, WIDTH, HEIGHT);
    scene_add(&scene, SOLID_BOWL, 0.5, 0.5, 0);
    scene.world.solids[0].radius = 0.3;
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_like_new(renderer, &scene, WIDTH, HEIGHT);
    assert_true(renderer_resize(renderer, 90, 50, &error));
    scene.world.solids[0].color[1] = 0.7F;
    scene.world.solids[1].centre[0] = -0.5;
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_like_new(renderer, &scene, 90, 50);
    text_set(scene.def.kind, "none");
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_like_new(renderer, &scene, 90, 50);
    scene.world.solid_count = 0;
    text_set(scene.def.kind, "spheres");
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_like_new(renderer, &scene, 90, 50);
    ViewDef bad = scene.def; /* fails once the solids were made */
    scene.world.solid_count = 1;
    text_set(bad.colormap, "mud");
    assert_false(renderer_set_def(renderer, &bad, &scene.world, &error));
    scene.world.solid_count = 0;
    assert_like_new(renderer, &scene, 90, 50);
    renderer_destroy(renderer);
    free(scene.particles);
}

static void test_stage_only_with_solids(void **state)
{
    (void)state;
    Error error = {0};
    for (int solids = 0; solids < 2; solids++) {
        SolidsScene scene = scene_create();
        ParticleBuffers buffers;
        StageTimes times = {0};
        if (solids)
            scene_add(&scene, SOLID_SPHERE, 0, 0.5, 0);
        particles_add(scene.particles, 0, 0.5, 0.4, 1, 0);
        scene.state.count = 1;
        Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
        Renderer *renderer = renderer_create(&scene.def, &scene.world, WIDTH, HEIGHT, &error);
        GlTimer *timer = gl_timer_create(GL_CLOCK_FINISH);
        renderer_draw(renderer, &buffers, timer);
        assert_true(gl_timer_frame(timer, &times));
        assert_int_equal(times.ran[STAGE_SOLIDS], solids);
        scene.world.solid_count = 0;
        assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
        times = (StageTimes){0};
        renderer_draw(renderer, &buffers, timer);
        assert_true(gl_timer_frame(timer, &times));
        assert_false(times.ran[STAGE_SOLIDS]);
        gl_timer_destroy(timer);
        renderer_destroy(renderer);
        upload_destroy(upload);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_shadow_on_the_floor, no_gl_errors),
        cmocka_unit_test_teardown(test_no_shadow_of_what_is_cut_off, no_gl_errors),
        cmocka_unit_test_teardown(test_shadow_before_the_box, no_gl_errors),
        cmocka_unit_test_teardown(test_shadow_on_fluid_and_on_solids, no_gl_errors),
        cmocka_unit_test_teardown(test_fluid_shades_solids, no_gl_errors),
        cmocka_unit_test_teardown(test_no_shadow_of_its_own, no_gl_errors),
        cmocka_unit_test_teardown(test_def_and_size_follow, no_gl_errors),
        cmocka_unit_test_teardown(test_stage_only_with_solids, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
