/* View `pbsr` in every shipped scene: its fluid is in the picture. */
#include "tests/render/fixture.h"
#include "tests/sim/fixture.h"

#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "render/views/pbsr/pbsr.h"
#include "sim/gpu/gl.h"

#include <dirent.h>

enum { WIDE = 64, HIGH = 48, BYTES = 3 * WIDE * HIGH };

static int setup(void **state)
{
    if (context_setup(state) != 0)
        return 1;
    backends_add();
    return 0;
}

/* As few particles as the solids allow, or as the start needs. */
static void load(const char *name, Scene *scene)
{
    static const size_t counts[] = {400, 2000, 0};
    SceneSettings settings = {
        .count = 4,
        .set = {"view.kind=pbsr", "view.pbsr.repeat=1", "view.legend=false", "solver.backend=cpu"}};
    Error error = {0};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        settings.particles = counts[i];
        if (scene_load(name, &settings, scene, NULL, &error))
            return;
    }
    fail_msg("%s", error.message);
}

static void picture_of(const ViewDef *view, const WorldDef *def, World *world, uint8_t *rgb)
{
    Offscreen offscreen;
    Error error = {0};
    if (!offscreen_open(&offscreen, view, def, world, WIDE, HIGH, &error) ||
        !offscreen_draw(&offscreen, world, NULL, NULL, &error))
        fail_msg("%s", error.message);
    renderer_read(offscreen.renderer, rgb);
    offscreen_close(&offscreen);
}

/* What emits has some after a while. */
static void fill(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    for (int i = 0; i < 60 && info.count < 30; i++) {
        fixture_step(world, 1);
        world_info(world, &info);
    }
    assert_true(info.count > 0);
}

/* Without layers the picture differs. */
static void check(const char *name)
{
    static Scene scene;
    static uint8_t with[BYTES], without[BYTES];
    int differ = 0;
    load(name, &scene);
    World *world = fixture_world(&scene.world);
    fill(world);
    ViewDef view = scene.view;
    PbsrDef *own = pbsr_def(&view);
    picture_of(&view, &scene.world, world, with);
    if (own->layer_count == 0)
        own->layers[own->layer_count++] = (PbsrLayer){.of = PBSR_SURFACE, .level = 0.5};
    for (int i = 0; i < own->layer_count; i++)
        own->layers[i].opacity = 0;
    picture_of(&view, &scene.world, world, without);
    for (int i = 0; i < BYTES; i += 3)
        differ += memcmp(&with[i], &without[i], 3) != 0;
    if (differ < 4)
        fail_msg("%s: %d pixels have its layers", name, differ);
    world_destroy(world);
}

static void it_draws_every_scene(void **state)
{
    (void)state;
    DIR *scenes = opendir(SLOSH_SOURCE_DIR "/scenes");
    assert_non_null(scenes);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(scenes));) {
        const size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml") != 0)
            continue;
        entry->d_name[length - 5] = '\0';
        check(entry->d_name);
        count++;
    }
    closedir(scenes);
    assert_true(count >= 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_teardown(it_draws_every_scene, no_gl_errors)};
    return cmocka_run_group_tests(tests, setup, context_teardown);
}
