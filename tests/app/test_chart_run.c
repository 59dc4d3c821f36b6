/* Settings of a chart's runs: each row describes the row's scene. */
#include "tests/sim/fixture.h"

#include "app/lab/error_chart.h"
#include "sim/gpu/gl.h"

#include <math.h>
#include <stdlib.h>

static Scene scene, own;
static ChartRow row;
static Error error;

/* The run of dam_break, with fixed steps and these settings. */
static void prepare(const ChartJob *job, SceneSettings *settings)
{
    static const char path[] = SLOSH_SOURCE_DIR "/scenes/dam_break.yaml";
    const ChartSubject subject = {.scene = path, .time = 1, .settings = settings};
    if (!scene_load(path, settings, &own, NULL, &error) ||
        !chart_prepare(&subject, job, &scene, &row, NULL, &error))
        fail_msg("%s", error.message);
}

static double step_of(const Scene *of)
{
    return of->world.dt / of->world.substeps;
}

/* --particles changes the step too; a coarser spacing and a finer step then change the new step. */
static void a_fixed_step_goes_with_the_particles(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        const ChartJob job = {
            .method = "wcsph", .backend = "cpu", .coarsening = i & 1 ? 2 : 1, .fineness = i >> 1};
        SceneSettings settings = {.particles = 300};
        prepare(&job, &settings);
        const double said = strtod(row.step, NULL) / 1000;
        assert_true(fabs(step_of(&scene) / said - 1) < 0.01);
        const double wanted = own.world.substeps * (1 << job.fineness) / job.coarsening;
        assert_true(fabs(step_of(&scene) - own.world.dt / ceil(wanted - 1e-6)) < 1e-8);
    }
}

/* A step that was chosen stays. */
static void a_chosen_step_stays(void **state)
{
    (void)state;
    const ChartJob job = {.method = "wcsph", .backend = "cpu", .coarsening = 1};
    SceneSettings settings = {.particles = 300};
    settings.said[settings.count] = "--set solver.step.dt=0.011";
    settings.set[settings.count++] = "solver.step.dt=0.011";
    prepare(&job, &settings);
    assert_true(fabs(scene.world.dt - 0.011) < 1e-9);
}

/* A row's name contains each swept value, except step values derived from the spacing. */
static void a_step_has_one_name(void **state)
{
    (void)state;
    ChartJob job = {.method = "wcsph",
                    .backend = "cpu",
                    .coarsening = 0.5,
                    .set_count = 2,
                    .set = {"--sweep solver.step.substeps=3", "--sweep solver.kernel=cubic"}};
    SceneSettings settings = {0};
    prepare(&job, &settings);
    assert_string_equal(row.swept, "substeps=3 kernel=cubic");
    assert_string_equal(row.step, "2 ms"); /* 12 ms in six */
    job.step_unnamed = true;
    prepare(&job, &settings);
    assert_string_equal(row.swept, "kernel=cubic");
    assert_int_equal(scene.world.substeps, 6);
}

/* A coarser spacing without whole layers in the fills: the row has the chosen spacing, without a note. */
static void a_row_has_the_spacing_that_runs(void **state)
{
    (void)state;
    static Notes notes;
    const ChartJob job = {.method = "wcsph", .backend = "cpu", .coarsening = 1.37};
    SceneSettings settings = {0};
    prepare(&job, &settings);
    assert_true(fabs(row.spacing / scene.world.spacing - 1) < 1e-8 &&
                fabs(row.spacing / (1.37 * own.world.spacing) - 1) > 1e-3);
    assert_true(chart_prepare(&(ChartSubject){.scene = own.path, .time = 1, .settings = &settings}, &job,
                              &scene, &row, &notes, &error));
    for (int i = 0; i < notes.count; i++)
        assert_null(strstr(notes.line[i], "is taken"));
}

int main(void)
{
    backends_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fixed_step_goes_with_the_particles),
        cmocka_unit_test(a_chosen_step_stays),
        cmocka_unit_test(a_step_has_one_name),
        cmocka_unit_test(a_row_has_the_spacing_that_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
