/* Known flows on backend compute with a too long step: the world goes back, and the discarded part is not
   measured. */
#include "tests/sim/fixture.h"

#include "app/bench/cases/case.h"
#include "app/run/offscreen.h"
#include "sim/gpu/gl.h"

static Headless *context;

static int open_context(void **state)
{
    (void)state;
    Error error = {{0}};
    context = headless_create(HEADLESS_GPU_AUTO, &error);
    backends_add();
    return context ? 0 : -1;
}

static int close_context(void **state)
{
    (void)state;
    headless_destroy(context);
    return 0;
}

/* With so long steps the drop breaks twice or so: none of what was thrown away is among the
 * samples. */
static void samples_are_of_sound_states(void **state)
{
    (void)state;
    static CaseResult result;
    Error error = {{0}};
    Progress progress;
    SceneSettings settings = {.count = 2, .set = {"solver.backend=compute", "solver.step.number=1.8"}};
    Case often = *case_find("elliptical_drop", &error);
    often.every = 1e-6; /* after each step */
    const CaseSetup setup = {.of = &often, .level = CASE_COARSE, .method = "wcsph", .settings = &settings};
    progress_begin(&progress, stderr, "", true);
    if (!case_run(&setup, &progress, 0, 1, &result, &error))
        fail_msg("%s", error.message);
    const Curve *axis = &result.run.column[0];
    const WorldTrouble *trouble = &result.run.info.trouble;
    assert_true(trouble->count > 0 && axis->count > 50);
    for (size_t i = 1; i < axis->count; i++) {
        const double *was = axis->at[i - 1], *is = axis->at[i];
        const double rate = fabs(is[1] - was[1]) / (is[0] - was[0]);
        if (!(is[0] > was[0] && rate < 2000)) /* breakage draws fluid in by up to some hundred m/s */
            fail_msg("from %g s to %g s the axis changes by %g m/s", was[0], is[0], rate);
    }
    case_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_of_sound_states),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
