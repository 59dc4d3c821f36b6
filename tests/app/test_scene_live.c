/* Keys that change while a scene lives. */
#include "app/scene_keys.h"
#include "app/scene_live.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

static Scene scene;
static Error error;

static int load(void **state)
{
    (void)state;
    return scene_load("scenes/two_oils.yaml", NULL, &scene, NULL, &error) ? 0 : 1;
}

static void refuse(const char *setting, const char *words)
{
    static Scene before;
    before = scene;
    assert_false(scene_set_live(&scene, setting, NULL, &error));
    if (!strstr(error.message, words) || !(strstr(error.message, "; ") || strstr(error.message, "must be")))
        fail_msg("'%s' is no '%s'", error.message, words);
    assert_memory_equal(&before, &scene, sizeof scene);
}

static void values_arrive(void **state)
{
    (void)state;
    bool world;
    assert_true(scene_set_live(&scene, "gravity=[0, -3, 1]", &world, &error));
    assert_true(world && scene.world.gravity[1] == -3 && scene.world.gravity[2] == 1);
    assert_true(scene_set_live(&scene, "fluids[1].viscosity=0.25", &world, &error));
    assert_true(world && scene.world.fluids[1].viscosity == 0.25);
    assert_true(scene_set_live(&scene, "view.range=[1, 2]", &world, &error));
    assert_true(!world && !scene.view.range_auto && scene.view.range[1] == 2);
    assert_true(scene_set_live(&scene, "view.range=auto", &world, &error));
    assert_true(!world && scene.view.range_auto);
    assert_true(scene_set_live(&scene, "view.color_by=density", &world, &error));
    assert_true(scene.view.color_by == SCALAR_DENSITY);
    assert_true(scene_set_live(&scene, "fluids[0].color=[1, 0, 0]", &world, &error));
    assert_true(!world && scene.view.fluid_color[0][0] == 1 && scene.view.fluid_color[0][1] == 0);
    assert_true(scene_set_live(&scene, "view.camera.from=[1, 2, 3]", &world, &error));
    assert_true(!scene.view.camera_auto && scene.view.camera.from[2] == 3);
    assert_true(scene_set_live(&scene, "solver.step.realtime=false", &world, &error));
    assert_true(!world && !scene.realtime);
    assert_true(scene_set_live(&scene, "solver.step.substeps=7", NULL, &error));
    assert_int_equal(scene.world.substeps, 7);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    refuse("", "no setting");
    refuse("gravity", "no setting");
    refuse("gravity=", "no setting");
    refuse("=3", "no setting");
    refuse("graviti=[0,0,0]", "no such key");
    refuse("box.size=[1,1,1]", "cannot change while");
    refuse("fluids[0].density=3", "cannot change while");
    refuse("fluids[7].viscosity=3", "no such fluid");
    refuse("fluids[-1].viscosity=3", "no such key");
    refuse("fluids[0].viscosity=-1", "must be");
    refuse("gravity=[0, 1]", "gravity must be");
    refuse("gravity={a: 1}", "gravity must be");
    refuse("solver.step.dt=nan", "must be a finite");
    refuse("view.kind=teapot", "view.kind cannot be");
    refuse("view.range=[2, 1]", "view.range");
}

/* Every live key takes its own value back: what the panel writes, the scene reads. */
static void live_keys_take_their_own_values(void **state)
{
    (void)state;
    int count, live = 0;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        char value[256], setting[512], path[128];
        if (!(keys[i].flags & KEY_LIVE) || strncmp(keys[i].path, "view.camera", 11) == 0)
            continue;
        const bool fluid = strncmp(keys[i].path, "fluids[]", 8) == 0;
        snprintf(path, sizeof path, "%s%s", fluid ? "fluids[1]" : keys[i].path,
                 fluid ? keys[i].path + 8 : "");
        key_value_text(&keys[i], fluid ? (const void *)&scene.world.fluids[1] : &scene, value, sizeof value);
        snprintf(setting, sizeof setting, "%s=%s", path, value);
        if (!scene_set_live(&scene, setting, NULL, &error))
            fail_msg("%s: %s", setting, error.message);
        live++;
    }
    assert_true(live > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(values_arrive, load),
        cmocka_unit_test_setup(nonsense_is_refused, load),
        cmocka_unit_test_setup(live_keys_take_their_own_values, load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
