/* solver.preset: fills in missing keys by method and dimensions, and no further keys. */
#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/methods/wcsph/wcsph.h"
#include "tests/scene/scene_text.h"

#include "app/bench/cases/case.h"
#include "app/scene/scene.h"
#include "sim/world.h"

#include <stdlib.h>

#define ACCURATE LEAST "solver:\n  preset: accurate\n"
#define PLANE                                                                                                \
    "box: {size: [1, 1]}\nparticles: {spacing: 0.1}\n"                                                       \
    "fluids: [{fill: [{block: {min: [-0.5, 0], max: [0.5, 0.5]}}]}]\nsolver: {preset: accurate}\n"
#define TWO_FLUIDS                                                                                           \
    "box: {size: [1, 1]}\nparticles: {spacing: 0.1}\nfluids:\n"                                              \
    "  - {name: a, fill: [{block: {min: [-0.5, 0], max: [0.5, 0.5]}}]}\n"                                    \
    "  - {name: b, fill: [{block: {min: [-0.5, 0.5], max: [0.5, 1]}}]}\nsolver: {preset: accurate}\n"

static Scene scene;

static const WorldDef *world_of(const char *text, const char *setting)
{
    Error error;
    if (!(setting ? parse_set(text, setting, &scene, &error) : parse_text(text, NULL, &scene, &error)))
        fail_msg("%s", error.message);
    return &scene.world;
}

static void it_fills_in_what_is_not_named(void **state)
{
    (void)state;
    const WorldDef *def = world_of(ACCURATE, NULL);
    assert_string_equal(def->method, "wcsph");
    assert_string_equal(wcsph_def(def)->kernel, "wendland_c2");
    assert_float_equal(def->support, 2.6, 0);
    assert_float_equal(wcsph_def(def)->delta_sph, 0.1, 0);
    assert_float_equal(wcsph_def(def)->artificial_viscosity, 0.02, 0);
    assert_int_equal(def->step_mode, STEP_CFL);
    assert_true(def->reproducible);
    assert_float_equal(world_of(PLANE, NULL)->support, 3.5, 0);
    assert_float_equal(world_of(PLANE, "solver.method=mueller")->support, 2.6, 0);
    assert_float_equal(world_of(PLANE, "solver.method=dfsph")->support, 3.1, 0);
    assert_float_equal(dfsph_def(world_of(PLANE, "solver.method=dfsph"))->rest_viscosity, 0.15, 0);
    assert_string_equal(wcsph_def(world_of(PLANE, NULL))->kernel, "wendland_c2");
    assert_string_equal(wcsph_def(world_of(TWO_FLUIDS, NULL))->kernel, "quintic");
    assert_string_equal(wcsph_def(world_of(TWO_FLUIDS, "solver.kernel=cubic"))->kernel, "cubic");
    def = world_of(TWO_FLUIDS, "solver.method=mueller");
    assert_true(mueller_def(def)->numerical_viscosity == 0.01);
    assert_true(def->support == 3 && strcmp(mueller_def(def)->density_kernel, "quintic") == 0);
}

static void it_gives_way_to_scene_and_command_line(void **state)
{
    (void)state;
    const WorldDef *def = world_of(ACCURATE "  kernel: quintic\n  step: {mode: fixed}\n", NULL);
    assert_string_equal(wcsph_def(def)->kernel, "quintic");
    assert_int_equal(def->step_mode, STEP_FIXED);
    assert_float_equal(wcsph_def(def)->delta_sph, 0.1, 0);
    assert_float_equal(wcsph_def(world_of(ACCURATE, "solver.delta_sph=0"))->delta_sph, 0, 0);
    assert_string_equal(wcsph_def(world_of(LEAST, "solver.preset=accurate"))->kernel, "wendland_c2");
}

/* Settings unused by the method stay at default: no warnings. */
static void a_method_gets_its_own_keys(void **state)
{
    (void)state;
    const WorldDef *def = world_of(ACCURATE "  method: mueller\n", NULL), none = world_def_default();
    assert_string_equal(def->method, "mueller");
    assert_int_equal(def->step_mode, STEP_CFL);
    assert_string_equal(wcsph_def(def)->kernel, wcsph_def(&none)->kernel);
    assert_float_equal(wcsph_def(def)->delta_sph, wcsph_def(&none)->delta_sph, 0);
    assert_int_equal(wcsph_def(def)->viscosity_form, wcsph_def(&none)->viscosity_form);
    def = world_of(ACCURATE "  method: dfsph\n", NULL);
    assert_true(def->support == 2.22 && def->cfl_number == 0.15);
    assert_int_equal(world_of(ACCURATE "  method: pbf\n", NULL)->step_mode, STEP_FIXED);
    assert_float_equal(world_of(LEAST, "solver.method=dfsph")->cfl_number, 0.2, 0);
}

/* In the plane a support at which the lattice does not resist shear; friction of the resolution. */
static void play_knows_the_method(void **state)
{
    (void)state;
    const WorldDef *def = world_of(PLANE, "solver={method: mueller}");
    assert_float_equal(def->support, 3, 0);
    assert_float_equal(mueller_def(def)->numerical_viscosity, 0.03, 0);
    assert_float_equal(world_of(PLANE, "solver={method: dfsph}")->support, 3.1, 0);
    assert_float_equal(world_of(PLANE, "solver={method: pbf}")->support, 3, 0);
    def = world_of(PLANE, "solver={method: wcsph}");
    assert_true(def->support == 3 && wcsph_def(def)->artificial_viscosity == 0.02);
    assert_string_equal(wcsph_def(def)->kernel, "quintic");
    assert_float_equal(world_of(LEAST, "solver.method=wcsph")->support, 2.1, 0);
    def = world_of(PLANE, "solver={method: wcsph, kernel: cubic}"); /* a kernel and its support go together */
    assert_float_equal(def->support, 2.1, 0);
    def = world_of(PLANE, "particles={spacing: 0.1, support: 2.2}");
    assert_float_equal(def->support, 2.2, 0);
    def = world_of(TWO_FLUIDS, "solver={method: mueller}");
    assert_true(def->support == 3 && strcmp(mueller_def(def)->density_kernel, "quintic") == 0);
    def = world_of(TWO_FLUIDS, "particles.support=2.2");
    assert_string_equal(mueller_def(def)->density_kernel, "spiky");
}

/* A scene with `play`, or without a preset, equals a scene from before presets. */
static void play_is_the_defaults(void **state)
{
    (void)state;
    world_of(LEAST, NULL);
    assert_string_equal(scene.preset, "play");
    char *without = scene_print_text(&scene);
    world_of(LEAST, "solver.preset=play");
    char *with = scene_print_text(&scene);
    assert_string_equal(with, without);
    assert_string_equal(scene.world.method, world_def_default().method);
    free(without);
    free(with);
}

static void all_names_are_known(void **state)
{
    (void)state;
    assert_refused(LEAST "solver: {preset: acurate}\n",
                   "scene.yaml:7:18: solver.preset cannot be 'acurate'; did you mean 'accurate'?");
    for (const SolverPreset *preset = solver_preset_list; preset->name; preset++)
        for (int k = 0; preset->settings[k].path; k++) {
            char setting[128];
            snprintf(setting, sizeof setting, "%s=%s", preset->settings[k].path, preset->settings[k].value);
            assert_non_null(scene_key_find(preset->settings[k].path));
            world_of(LEAST, setting);
        }
}

static void it_is_told_what_came_from_it(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    world_of(PLANE, "solver.kernel=quintic");
    FILE *file = open_memstream(&text, &size);
    solver_preset_print(&scene, file);
    fclose(file);
    assert_non_null(strstr(text, "from solver.preset accurate\n"));
    assert_non_null(strstr(text, "  solver.delta_sph = 0.1\n"));
    assert_non_null(strstr(text, "  particles.support = 3.5\n"));
    assert_null(strstr(text, "particles.support = 2.6"));
    assert_non_null(strstr(text, "  solver.kernel = wendland_c2 gives way to the scene's own\n"));
    free(text);
}

static char *settings_of(const Case *of, const char *method)
{
    SceneSettings none = {0}, own = {.count = of->setting != NULL, .set = {of->setting}};
    Error error;
    const CaseSetup setup = {.of = of, .level = CASE_DEFAULT, .method = method, .settings = &none};
    if (!(method ? case_scene(&setup, &scene, &error) : scene_load(of->scene, &own, &scene, NULL, &error)))
        fail_msg("%s", error.message);
    return scene_print_text(&scene);
}

/* `slosh run cases/x` runs with the settings that `slosh validate x` measures. */
static void a_case_s_file_holds_what_is_measured(void **state)
{
    (void)state;
    for (const Case *const *at = case_list; *at; at++) {
        char *file = settings_of(*at, NULL), *measured = settings_of(*at, (*at)->methods[0].name);
        assert_string_equal(scene.preset, "accurate");
        assert_string_equal(file, measured);
        free(file);
        free(measured);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_fills_in_what_is_not_named),
        cmocka_unit_test(it_gives_way_to_scene_and_command_line),
        cmocka_unit_test(a_method_gets_its_own_keys),
        cmocka_unit_test(play_knows_the_method),
        cmocka_unit_test(play_is_the_defaults),
        cmocka_unit_test(all_names_are_known),
        cmocka_unit_test(it_is_told_what_came_from_it),
        cmocka_unit_test(a_case_s_file_holds_what_is_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
