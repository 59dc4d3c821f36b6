/* Foam of a breaking dam: no foam during the fall, foam from the impact on. */
#include "tests/render/fixture.h"
#include "tests/sim/fixture.h"

#include "app/run/offscreen.h"
#include "app/scene/scene.h"

enum { WIDE = 320, HIGH = 180, BYTES = 3 * WIDE * HIGH };

static void open_picture(Offscreen *offscreen, Scene *scene, World *world, double foam)
{
    Error error = {0};
    scene->view.foam = foam;
    if (!offscreen_open(offscreen, &scene->view, &scene->world, world, WIDE, HIGH, &error))
        fail_msg("%s", error.message);
}

/* The pixels where two pictures of a state differ. */
static int apart(Offscreen picture[2], World *world)
{
    static uint8_t rgb[2][BYTES];
    Error error = {0};
    int differ = 0;
    for (int k = 0; k < 2; k++) {
        if (!offscreen_draw(&picture[k], world, NULL, NULL, &error))
            fail_msg("%s", error.message);
        renderer_read(picture[k].renderer, rgb[k]);
    }
    for (int i = 0; i < BYTES; i += 3)
        differ += memcmp(&rgb[0][i], &rgb[1][i], 3) != 0;
    return differ;
}

static double time_of(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info.time;
}

/* The front meets the far wall at 0.43 s. */
static void dam_of(size_t particles)
{
    static Scene scene;
    SceneSettings settings = {
        .particles = particles, .count = 2, .set = {"view.legend=false", "solver.backend=cpu"}};
    Error error = {0};
    Offscreen picture[2];
    if (!scene_load(SLOSH_SOURCE_DIR "/scenes/dam_break.yaml", &settings, &scene, NULL, &error))
        fail_msg("%s", error.message);
    World *world = fixture_world(&scene.world);
    for (int k = 0; k < 2; k++)
        open_picture(&picture[k], &scene, world, k);
    for (int part = 1; part <= 6; part++) {
        while (time_of(world) < 0.12 + 0.05 * part)
            fixture_step(world, 1);
        const int falls = apart(picture, world);
        printf("%zu particles, %.2f s: foam in %d pixels\n", particles, time_of(world), falls);
        assert_int_equal(falls, 0);
    }
    while (time_of(world) < 0.5)
        fixture_step(world, 1);
    const int hits = apart(picture, world);
    printf("%zu particles, %.2f s: foam in %d pixels\n", particles, time_of(world), hits);
    assert_true(hits > 20);
    offscreen_close(&picture[0]), offscreen_close(&picture[1]);
    world_destroy(world);
}

static void a_dam_that_falls_has_no_foam(void **state)
{
    (void)state;
    dam_of(2048);
    dam_of(8192);
}

static int setup(void **state)
{
    if (context_setup(state) != 0)
        return 1;
    backends_add();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_teardown(a_dam_that_falls_has_no_foam, no_gl_errors)};
    return cmocka_run_group_tests(tests, setup, context_teardown);
}
