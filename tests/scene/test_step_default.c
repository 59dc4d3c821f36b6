/* Default sound speed and step fit the scene's size; named values stay. */
#include "tests/scene/scene_text.h"

#include "sim/step/constants.h"

#include <math.h>

static Scene scene;
static Notes notes;

/* A dam of that height, 20 spacings high; further keys of the solver. */
static const WorldDef *dam(double height, const char *solver)
{
    char text[512];
    SceneSettings settings = {.count = 0};
    Error error;
    snprintf(text, sizeof text,
             "box: {size: [%g, %g]}\nparticles: {spacing: %g}\n"
             "fluids: [{fill: [{block: {min: [%g, 0], max: [0, %g]}}]}]\nsolver: {%s}\n",
             2 * height, 2 * height, height / 20, -height, height, solver);
    if (!scene_parse("scene.yaml", text, strlen(text), &settings, &scene, &notes, &error))
        fail_msg("%s", error.message);
    return &scene.world;
}

static bool told(const char *line)
{
    for (int i = 0; i < notes.count; i++)
        if (strstr(notes.line[i], line))
            return true;
    return false;
}

/* Over what sound takes to cross h. */
static double share(const WorldDef *def)
{
    return def->dt / def->substeps / (def->support * def->spacing / def->sound_speed);
}

static void a_scene_of_a_hand_has_the_usual_ones(void **state)
{
    (void)state;
    const WorldDef *def = dam(0.6, "");
    assert_true(def->sound_speed == 20 && def->dt == 0.01 && def->substeps == 10);
    assert_int_equal(notes.count, 0);
    const double calm = share(dam(0.057, "density_kernel: quintic")); /* is stiffer */
    assert_true(calm <= 0.8 * STEP_SOUND_CALM && calm > 0.95 * 0.8 * STEP_SOUND_CALM);
}

static void any_size_has_sound_and_steps_of_its_own(void **state)
{
    (void)state;
    static const double heights[] = {1e-3, 0.057, 3, 100};
    static const char *const methods[] = {"method: mueller", "method: wcsph"};
    for (int k = 0; k < 8; k++) {
        const double height = heights[k / 2], speed = sqrt(2 * 9.81 * height);
        const WorldDef *def = dam(height, methods[k % 2]);
        assert_true(def->sound_speed >= 7 * speed && def->sound_speed < 7.8 * speed); /* two digits */
        assert_true(share(def) <= STEP_SOUND_CALM);
        assert_true(def->substeps == 10 || share(def) > 0.95 * STEP_SOUND_CALM);
        assert_true(told("scene.yaml: solver.sound_speed: ") &&
                    (def->substeps == 10 || told("which sound stands here")));
    }
}

static void what_is_named_stays(void **state)
{
    (void)state;
    const WorldDef *def = dam(0.057, "sound_speed: 20, step: {substeps: 10}");
    assert_true(def->sound_speed == 20 && def->substeps == 10);
    assert_true(told("too long for sound"));
    assert_int_equal(dam(0.057, "sound_speed: 20, step: {dt: 0.01}")->substeps, 10);
    def = dam(3, "step: {dt: 0.01}"); /* 54 m/s would be too fast for that step */
    assert_true(def->sound_speed == 20 && def->substeps == 10);
    def = dam(0.057, "sound_speed: 20");
    assert_true(def->sound_speed == 20 && def->substeps == 47);
}

/* A dam of 0.6 m with cohesion, of so many N/m. */
static const WorldDef *tense(const char *method, double tension)
{
    char text[512];
    SceneSettings settings = {.count = 0};
    Error error;
    snprintf(text, sizeof text,
             "box: {size: [1, 1]}\nparticles: {spacing: 0.03}\n"
             "fluids: [{surface_tension: %g, fill: [{block: {min: [-0.5, 0], max: [0, 0.6]}}]}]\n"
             "solver: {method: %s, surface_tension: cohesion}\n",
             tension, method);
    if (!scene_parse("scene.yaml", text, strlen(text), &settings, &scene, &notes, &error))
        fail_msg("%s", error.message);
    return &scene.world;
}

static void friction_and_speed_bind_too(void **state)
{
    (void)state;
    const WorldDef *def = dam(0.6, "method: dfsph");
    assert_int_equal(def->substeps, 10);
    assert_true(dam(0.01, "method: dfsph")->substeps > 10);
    assert_true(told("which speed stands here") || told("which pressure stands here"));
    def = dam(0.01, "method: pbf");
    assert_true(def->step_mode == STEP_CFL && def->max_dt == 0.016666667 && def->cfl_number == 0.33);
    def = tense("dfsph", 7200);
    const double dfsph_limit = step_tension(def);
    assert_true(def->dt / def->substeps <= dfsph_limit && told("which surface tension stands here"));
    def = tense("pbf", 7200); /* mode cfl keeps the limit */
    assert_true(step_tension(def) < 0.34 * dfsph_limit);
    assert_int_equal(def->step_mode, STEP_CFL);
}

/* A jet of pbf needs steps of a spacing, calm fluid does not; a named step stays. */
static void a_step_of_pbf_follows_the_flow(void **state)
{
    (void)state;
    const WorldDef *def = dam(0.4, "method: pbf");
    const StepFriction none = {0};
    StepLimit limit;
    assert_float_equal(step_cfl(def, &none, 0.1, 9.81, 1, &limit), 1 / 60.0, 1e-6);
    assert_float_equal(step_cfl(def, &none, 4, 9.81, 1, &limit), def->spacing / 4, 0.02 * def->spacing / 4);
    def = dam(0.01, "method: pbf"); /* 20 layers of 0.5 mm: a fall of 0.4 of them in a step is a limit too */
    assert_float_equal(step_cfl(def, &none, 0, 9.81, 1, &limit), sqrt(0.4 * 0.0005 / 9.81), 1e-6);
    assert_int_equal(limit, STEP_LIMIT_PRESSURE);
    def = dam(0.4, "method: pbf, step: {dt: 0.0166667}");
    assert_true(def->step_mode == STEP_FIXED && def->substeps == 1 && notes.count == 0);
    dam(0.01, "method: pbf, step: {dt: 0.0166667}");
    assert_true(told("too long for the pressure"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_of_a_hand_has_the_usual_ones),
        cmocka_unit_test(any_size_has_sound_and_steps_of_its_own),
        cmocka_unit_test(what_is_named_stays),
        cmocka_unit_test(friction_and_speed_bind_too),
        cmocka_unit_test(a_step_of_pbf_follows_the_flow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
