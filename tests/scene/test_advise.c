/* Advice on scenes, and scenes without advice. */
#include "tests/scene/scene_text.h"

#include "app/scene/scene.h"
#include "sim/gpu/gl.h"

#include <dirent.h>

static Scene scene;
static Notes notes;
static Error error;

/* A tank of 0.5 m of fluid, h = 0.21 m. */
static void load(const char *const *set)
{
    SceneSettings settings = {.count = 0};
    for (; *set; set++)
        settings.set[settings.count++] = *set;
    if (!scene_parse("scene.yaml", LEAST, strlen(LEAST), &settings, &scene, &notes, &error))
        fail_msg("%s", error.message);
}

static const struct Case {
    const char *set[6];
    const char *line; /* that is told, or NULL: none */
} cases[] = {
    {{NULL}, NULL},
    /* friction: lambda h^2 = 16.4, 0.7 * 2 h^2 / (16.4 nu) = 3.76 ms at 1 m2/s */
    {{"fluids[0].viscosity=1000", "solver.step={dt: 0.0038, substeps: 1}"},
     "--set solver.step={dt: 0.0038, substeps: 1}: the step of 3.8 ms is too long for fluids[0].viscosity 1000 "
     "Pa s: from 3.76 ms on friction makes fluid boil instead of calming it; use 2 substeps or more, or a lower "
     "viscosity"},
    {{"fluids[0].viscosity=1000", "solver.step={dt: 0.0037, substeps: 1}"}, NULL},
    {{"fluids[0].viscosity=[[0, 1], [1, 1000]]", "solver.step={dt: 0.0038, substeps: 1}"}, "3.76 ms"},
    {{"fluids[0].viscosity=1000", "solver.step={mode: cfl, number: 0.5}"}, NULL},
    {{"solver.method=wcsph", "solver.artificial_viscosity=1", "solver.step={dt: 0.008, substeps: 1}"},
     "too long for solver.artificial_viscosity 1:"},
    /* sound: h / c = 10.5 ms */
    {{"solver.step={dt: 0.01, substeps: 1}"}, "too long for sound at 20 m/s"},
    /* tension: half of sqrt(0.1^3 / (2 pi)) = 6.31 ms */
    {{"solver.step={dt: 0.0064, substeps: 1}", "solver.surface_tension=cohesion",
      "fluids[0].surface_tension=1000", "solver.method=dfsph"},
     "too long for surface tension, whose shortest waves stand 6.31 ms: drops boil; use 2 substeps or more"},
    {{"solver.step={dt: 0.0055, substeps: 1}", "solver.numerical_viscosity=0"},
     "steps of 0.52 h / sound_speed heat fluid"},
    {{"solver.step={dt: 0.0055, substeps: 1}"}, NULL},
    {{"solver.step={dt: 0.0052, substeps: 1}"}, NULL},
    {{"solver.step={dt: 0.0055, substeps: 1}", "fluids[0].viscosity=2"}, NULL},
    {{"solver.step={dt: 0.0055, substeps: 1}", "solver.method=wcsph"}, NULL},
    {{"solver.step={mode: cfl, number: 0.6}", "solver.numerical_viscosity=0"},
     "use at most 0.5, or a viscosity"},
    /* a place of 500 m is kept to 31 um, in 1 ms; 1 % of 3.13 m/s is 0.03 */
    {{"box.size=[1000, 1, 1]", "solver.step={dt: 0.00097, substeps: 1}"},
     "500 m from the box's origin places are kept to 0.031 mm: there, what is slower than 0.031 m/s does not "
     "move in steps of 0.97 ms"},
    {{"box.size=[1000, 1, 1]", "solver.step={dt: 0.00485, substeps: 5}"}, "not move in steps of 0.97 ms"},
    {{"box.size=[1000, 1, 1]", "solver.step={dt: 0.001, substeps: 1}"}, NULL},
    {{"box.size=[10, 1, 1]", "solver.step={dt: 0.0001, substeps: 1}"}, NULL},
    /* sqrt(2 g H) = 3.13 m/s */
    {{"solver.sound_speed=5"},
     "5 m/s is little for fluid that may come to 3.13 m/s: it is pressed by some 22 %"},
    {{"solver.sound_speed=5"}, "use 9.4 m/s or more, with a step as much shorter"},
    {{"solver.sound_speed=5", "solver.step={mode: cfl}"}, "use 9.4 m/s or more"},
    {{"solver.sound_speed=6"}, NULL},
    {{"solver.sound_speed=5", "gravity=[0, 0, 0]"}, NULL},
    {{"solver.sound_speed=6", "gravity=[9.81, 0, 0]"}, "may come to 4.43 m/s"},
    {{"solver.sound_speed=6", "fluids[0].velocity=[3, 0, 0]"}, "may come to 4.34 m/s"},
    /* 5 sigma / 0.1 m on 7 c^2 */
    {{"solver.surface_tension=cohesion", "fluids[0].surface_tension=400", "solver.sound_speed=20"},
     "20 m/s is little for a surface tension of 400 N/m at this spacing: cohesion presses fluids[0] by some 4 "
     "%; use 45 m/s or more"},
    {{"solver.surface_tension=cohesion", "fluids[0].surface_tension=200", "solver.sound_speed=20"}, NULL},
    {{"solver.method=wcsph", "particles.support=2.6"}, "cubic lets particles pair at a support of 2.6"},
    {{"solver.method=wcsph", "particles.support=2.5"}, NULL},
    {{"solver.method=wcsph", "particles.support=3", "solver.kernel=wendland_c2"}, NULL},
    {{"solver.method=wcsph", "solver.kernel=wendland_c2"},
     "2.1 is little for wendland_c2, which sums over 32"},
    {{"solver.method=dfsph"}, NULL},
    /* 0.25 h / sqrt(g H) = 23.7 ms, by 2.1 spacings: the lattice's shell is at 2 */
    {{"solver.method=dfsph", "solver.step={dt: 0.023, substeps: 1}"}, NULL},
    {{"solver.method=dfsph", "solver.step={dt: 0.024, substeps: 1}"},
     "too long for the pressure of fluid that is 0.5 m deep: from 23.7 ms on it boils; use 2 substeps or more"},
    {{"solver.method=pbf", "solver.step={dt: 0.033, substeps: 1}"}, NULL},
    {{"solver.method=dfsph", "fluids[0].viscosity=1000", "solver.step={dt: 0.02, substeps: 1}"},
     "too long for fluids[0].viscosity 1000"},
    {{"solver.method=dfsph", "solver.sound_speed=5"},
     "--set solver.sound_speed=5: solver.sound_speed has no effect; it needs solver.method: mueller or wcsph"},
    {{"solver.method=dfsph", "solver.artificial_viscosity=0.1"},
     "solver.artificial_viscosity has no effect; it needs solver.method: wcsph"},
    {{"solver.tolerance=0.01"}, "solver.tolerance has no effect; it needs solver.method: dfsph"},
    {{"solver.kernel=wendland_c2"}, "solver.kernel has no effect; it needs solver.method: wcsph"},
    {{"fluids[0].density=31",
      "fluids=[{density: 31, fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}, {density: "
      "1, fill: [{block: {min: [-0.5, 0.4, -0.5], max: [0.5, 0.8, 0.5]}}]}]"},
     "mueller throws single light particles up where densities differ by more than 1 : 30, here 1 : 31"},
    /* 7848 Pa on 10 c^2 = 4000 Pa; the light fluid on top bears only the own weight */
    {{"solver.method=wcsph", "solver.sound_speed=20", "solver.step={dt: 0.0005, substeps: 1}",
      "fluids=[{density: 10, fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}, {density: "
      "1000, fill: [{block: {min: [-0.5, 0.4, -0.5], max: [0.5, 0.8, 0.5]}}]}]"},
     "fluids[0], of 10 kg/m3, bears up to"},
    {{"solver.method=wcsph", "solver.sound_speed=20", "solver.step={dt: 0.0005, substeps: 1}",
      "fluids=[{density: 1000, fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}]}, {density: "
      "10, fill: [{block: {min: [-0.5, 0.4, -0.5], max: [0.5, 0.8, 0.5]}}]}]"},
     NULL},
    {{"box.slip=none"}, "--set box.slip=none: slip none has no effect: only fluid with a viscosity is held"},
    {{"box.slip=none", "fluids[0].viscosity=1"}, NULL},
    {{"solids=[{sphere: {centre: [0, 0.8, 0], radius: 0.1}, slip: none}]"}, "none has no effect"},
    {{"solids=[{sphere: {centre: [0, 0.8, 0], radius: 0.06}}]",
      "motion=[{shake: {axis: [1, 0, 0], amplitude: 10, frequency: 3}}]"},
     "and the solid is 0.12 m thin: fluid may cross it"},
    {{"solids=[{sphere: {centre: [0, 0.8, 0], radius: 0.06}}]",
      "motion=[{shake: {axis: [1, 0, 0], amplitude: 0.1, frequency: 3}}]"},
     NULL},
    {{"solver.method=wcsph", "fluids[0].viscosity=0.001"}, NULL}, /* 0.05 stands for 10.5 Pa s */
    {{"solver.method=wcsph", "fluids[0].viscosity=8", "solver.artificial_viscosity=0.04"}, NULL},
    {{"solver.method=wcsph", "fluids[0].viscosity=0.001", "solver.artificial_viscosity=0"}, NULL},
    {{"solver.method=wcsph", "fluids[0].viscosity=30"}, NULL},
    {{"solver.method=wcsph", "fluids[0].viscosity=60", "solver.artificial_viscosity=0.04"},
     "solver.artificial_viscosity 0.04 adds nothing: it stands for 8.4 Pa s, and each fluid has more"},
    {{"solver.preset=accurate", "fluids[0].viscosity=60"}, NULL}, /* its alpha was not chosen */
    {{"solver.method=wcsph", "fluids[0].viscosity=60", "solver.artificial_viscosity=0.04",
      "fluids[1]={fill: [{block: {min: [-0.5, 0.6, -0.5], max: [0.5, 1, 0.5]}}]}"},
     NULL}, /* for the second fluid */
    /* fills */
    {{"fluids[0].fill=[{block: {min: [0, 0.1, 0], max: [0.1, 0.2, 0.1]}}]"},
     "scene.yaml:4:1: one particle has no neighbours: nothing presses it"},
    {{"fluids[0].fill=[{block: {min: [0, 0.1, 0], max: [0.5, 0.2, 0.5]}}]"},
     "the block is 1 spacing thick: too few"},
    {{"fluids[0].fill=[{ball: {centre: [0, 0.5, 0], radius: 0.3}}]"}, "% more mass than its fills: "},
    {{"fluids[0].viscosity=0.001"}, NULL},
};

static bool told(const char *line)
{
    for (int i = 0; i < notes.count; i++)
        if (strstr(notes.line[i], line))
            return true;
    return false;
}

static void each_is_told_where_it_holds(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        load(cases[i].set);
        if (cases[i].line ? notes.count != 1 || !told(cases[i].line) : notes.count > 0)
            fail_msg("case %zu: expected %s, got %d: %s", i, cases[i].line ? cases[i].line : "nothing",
                     notes.count, notes.line[0]);
    }
}

/* A changed live key gets advice by path alone. */
static void a_running_scene_is_asked_again(void **state)
{
    (void)state;
    load((const char *const[]){"solver.step={dt: 0.0038, substeps: 1}", NULL});
    assert_int_equal(notes.count, 0);
    scene.world.fluids[0].viscosity = 1000;
    scene_advise(NULL, &scene, &notes);
    assert_int_equal(notes.count, 1);
    assert_true(strncmp(notes.line[0], "solver.step.dt: the step of 3.8 ms", 34) == 0);
}

static int count_without_advice(const char *folder)
{
    DIR *scenes = opendir(folder);
    int count = 0;
    assert_non_null(scenes);
    for (struct dirent *entry; (entry = readdir(scenes));) {
        char path[1024];
        SceneSettings window = {.purpose = SCENE_FOR_WINDOW}; /* overfull is for a specific backend */
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (!strstr(entry->d_name, ".yaml"))
            continue;
        if (!scene_load(path, &window, &scene, &notes, &error) ||
            notes.count > (notes.count == 1 && strstr(notes.line[0], "is not watched here"))) /* a fact */
            fail_msg("%s%s", error.message, notes.line[0]);
        count++;
    }
    closedir(scenes);
    return count;
}

static void shipped_scenes_need_no_advice(void **state)
{
    (void)state;
    assert_true(count_without_advice(SLOSH_SOURCE_DIR "/scenes") > 10);
    assert_true(count_without_advice(SLOSH_SOURCE_DIR "/scenes/cases") > 10);
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_told_where_it_holds),
        cmocka_unit_test(a_running_scene_is_asked_again),
        cmocka_unit_test(shipped_scenes_need_no_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
