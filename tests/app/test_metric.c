/* Quantities of validate, for particles set by hand, and results from rows of points. */
#include "tests/sim/fixture.h"

#include "app/bench/cases/case.h"
#include "app/run/measure/measure.h"
#include "sim/world.h"

enum { MOST = 4000 };

static float position[4 * MOST], velocity[4 * MOST], density[MOST], pressure[MOST];
static uint32_t fluid[MOST];

static Cloud cloud_of(double spacing)
{
    memset(position, 0, sizeof position);
    memset(velocity, 0, sizeof velocity);
    memset(fluid, 0, sizeof fluid);
    return (Cloud){0, spacing, 3 * spacing, position, velocity, density, pressure, fluid};
}

static void add(Cloud *cloud, double x, double y, double z)
{
    float *at = cloud->position + 4 * cloud->count;
    assert_true(cloud->count < MOST);
    at[0] = (float)x;
    at[1] = (float)y;
    at[2] = (float)z;
    cloud->density[cloud->count] = 1000;
    cloud->pressure[cloud->count++] = 0;
}

static void near(double value, double right, double tolerance)
{
    if (!(fabs(value - right) <= tolerance))
        fail_msg("%.9g, not %.9g", value, right);
}

/* A block 5 wide and 4 high, spray in front, and a foremost particle that is too high. */
static void front_is_the_foremost_of_the_low_with_neighbours(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.1);
    for (int i = 0; i < 20; i++)
        add(&cloud, 0.05 + 0.1 * (i % 5), 0.05 + 0.1 * (i / 5), 0);
    add(&cloud, 2, 0.05, 0);
    add(&cloud, 0.55, 0.25, 0);
    near(metric_front(&cloud), 0.5, 1e-6);
    add(&cloud, 0.55, 0.05, 0);
    near(metric_front(&cloud), 0.6, 1e-6);
    cloud.count = 3; /* none has five */
    assert_true(isnan(metric_front(&cloud)));
}

/* A column with correct pressures, except 1 particle of 100 with 10 % of rho g H too much. */
static void pressure_is_off_by_its_rms(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.1);
    for (int i = 0; i < 100; i++) {
        add(&cloud, 0.1 * (i % 10), 0.05 + 0.1 * (i / 10), 0);
        cloud.pressure[i] = (float)(1000 * 10 * (1 - cloud.position[4 * i + 1]));
    }
    near(metric_surface(&cloud), 1, 1e-6);
    near(metric_hydrostatic(&cloud, 1000, 10, NULL), 0, 1e-6);
    cloud.pressure[40] += 1000;
    near(metric_hydrostatic(&cloud, 1000, 10, NULL), 0.01, 1e-5);
}

static void a_paraboloid_has_its_curvature(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.1);
    for (int a = 0; a < 16; a++)
        for (int b = 0; b < 16; b++) {
            const double x = 0.1 * (a - 7.5), z = 0.1 * (b - 7.5);
            add(&cloud, x, 0.5 + 0.7 * (x * x + z * z), z);
            add(&cloud, x, 0.2, z);
        }
    near(metric_paraboloid(&cloud, 1.6, NULL), 0.7, 1e-5);
}

/* A lattice that fills an ellipse of 1.2 and 0.5: the boundary is as rough as a spacing. */
static void an_ellipse_has_its_axes(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.03);
    for (int a = -50; a <= 50; a++)
        for (int b = -50; b <= 50; b++) {
            const double x = 0.03 * a, y = 0.03 * b;
            if (x * x / 1.44 + y * y / 0.25 < 1)
                add(&cloud, x + 3, y - 2, 0);
        }
    double axes[2], centre[3];
    metric_axes(&cloud, axes);
    near(axes[0], 1.2, 0.01);
    near(axes[1], 0.5, 0.01);
    metric_centre(&cloud, 1, 3, centre); /* its left half: 4 a / 3 pi from the middle */
    near(centre[0], 3 - 4 * 1.2 / (3 * M_PI), 0.02);
    near(centre[1], -2, 1e-5);
}

static void energies_are_those_of_the_masses(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.1);
    WorldDef def = world_def_default();
    Energies e;
    def.dimensions = 2;
    def.spacing = 0.1;
    def.sound_speed = 30;
    def.fluids[0].density = 1000;
    def.fluids[1].density = 500;
    strcpy(def.method, "wcsph");
    add(&cloud, 0, 2, 0);
    add(&cloud, 0, 1, 0);
    cloud.fluid[1] = 1;
    cloud.density[0] = cloud.density[1] = 500; /* half the rest density, without tension; at rest */
    cloud.velocity[0] = 3;
    cloud.velocity[5] = 4;
    metric_energies(&cloud, &def, &e);
    near(e.kinetic, 0.5 * 10 * 9 + 0.5 * 5 * 16, 1e-4);
    near(e.potential, 9.81 * (10 * 2 + 5 * 1), 1e-3);
    near(e.elastic, 0, 1e-9);
    /* pressed by a thousandth: half of c^2 e^2 a kg */
    cloud.density[0] = 1001;
    cloud.pressure[0] = 1;
    metric_energies(&cloud, &def, &e);
    near(e.elastic, 10 * 0.5 * 900 * 1e-6, 3e-5);
}

static void velocities_are_linear_between_particles(void **state)
{
    (void)state;
    Cloud cloud = cloud_of(0.1);
    uint32_t seed = 4;
    for (int i = 0; i < 400; i++) {
        const double x = 0.1 * (i % 20) + 0.03 * fixture_random(&seed),
                     y = 0.1 * (i / 20) + 0.03 * fixture_random(&seed);
        add(&cloud, x, y, 0);
        cloud.velocity[4 * i] = (float)(1 + 2 * x - 3 * y);
        cloud.velocity[4 * i + 1] = (float)(-x);
        cloud.pressure[i] = x < 1 ? 5 : 7;
    }
    double v[2];
    assert_true(metric_velocity(&cloud, (double[2]){0.96, 1.23}, v));
    near(v[0], 1 + 2 * 0.96 - 3 * 1.23, 1e-5);
    near(v[1], -0.96, 1e-5);
    assert_true(metric_velocity(&cloud, (double[2]){0, 0}, v)); /* at the edge too */
    near(v[0], 1, 1e-4);
    assert_false(metric_velocity(&cloud, (double[2]){9, 9}, v));
    near(metric_mean_pressure(&cloud, (double[3]){0.4, 0.5, 0}, 0.3), 5, 1e-6);
}

/* exp(-0.3 t) cos(5 t - 1). */
static void swings_have_period_and_decay(void **state)
{
    (void)state;
    Curve swing = {.count = 0}, peaks = {.count = 0};
    for (double t = 0; t < 5 * M_PI; t += 0.02)
        curve_add(&swing, t, exp(-0.3 * t) * cos(5 * t - 1));
    near(curve_period(&swing), 2 * M_PI / 5, 0.01);
    curve_log_peaks(&swing, &peaks);
    assert_true(peaks.count >= 8);
    Curve early = {.count = 8, .at = peaks.at};
    near(curve_slope(&early), -0.3, 0.02);
    near(curve_at(&swing, 0.51), exp(-0.3 * 0.51) * cos(5 * 0.51 - 1), 2e-3);
    assert_true(isnan(curve_at(&swing, 99)));
    curve_free(&swing);
    curve_free(&peaks);
}

/* A failed measurement is never replaced by a later value. */
static void not_measured_is_the_worst(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    near(figure_worse(0.1, 0.2), 0.2, 0);
    near(figure_worse(0.2, 0.1), 0.2, 0);
    assert_true(isnan(figure_worse(nan, 0.1)) && isnan(figure_worse(0.1, nan)));
}

/* Particles only in the lower half of the cavity: half of Ghia's points cannot be measured, the last ones
 * can. */
static void a_cavity_half_empty_is_no_result(void **state)
{
    (void)state;
    static WorldDef def;
    static CaseRun run;
    Error error = {{0}};
    const Case *of = case_find("cavity", &error);
    def = world_def_default();
    def.box_size[0] = def.box_size[1] = 1;
    def.lid[0] = 1;
    def.fluids[0].density = 1000;
    def.fluids[0].viscosity = 10;
    run = (CaseRun){.of = of, .def = &def, .cloud = cloud_of(0.02)};
    for (int i = 0; i < 50 * 25; i++)
        add(&run.cloud, 0.02 * (i % 50) - 0.49, 0.02 * (i / 50) + 0.01, 0);
    assert_true(of->judge(&run, &error));
    assert_true(isnan(run.figures[0].error));
    def.fluids[0].viscosity = 5;
    assert_false(of->judge(&run, &error));
    assert_non_null(strstr(error.message, "the Reynolds number is 100, 400 or 1000"));
    for (int c = 0; c < CASE_CURVES; c++) {
        curve_free(&run.found[c]);
        curve_free(&run.expected[c]);
    }
}

/* Every case has a loadable scene, existing methods, tolerances, a readable reference and a unique name. */
static void cases_are_whole(void **state)
{
    (void)state;
    Error error = {{0}};
    for (const Case *const *at = case_list; *at; at++) {
        const Case *of = *at;
        assert_ptr_equal(case_find(of->name, &error), of);
        assert_non_null(of->judge);
        assert_true(of->metrics[0].name && of->time > 0 && of->every > 0);
        assert_null(of->methods[0].left_out);
        for (int level = 0; level < CASE_LEVELS; level++)
            assert_true(of->spacing[level] > 0 &&
                        (level == 0 || of->spacing[level] < of->spacing[level - 1]));
        for (int m = 0; m < CASE_METRICS && of->metrics[m].name; m++)
            if (of->metrics[m].no_verdict)
                assert_true(m > 0 && isnan(case_tolerance(of, m, CASE_DEFAULT, "wcsph")));
            else
                assert_true(of->metrics[m].tolerance > 0 &&
                            of->metrics[m].coarse >= of->metrics[m].tolerance);
    }
    assert_null(case_find("no_such", &error));
    assert_non_null(strstr(error.message, "dam_break"));
    assert_string_equal(case_suggest("dam_brake"), "dam_break");
    assert_null(case_suggest("no_such"));
    near(figure_relative(1.1, 1).error, 0.1, 1e-9);
    near(figure_scaled(-0.5, 0, 2).error, 0.25, 1e-9);
    assert_true(case_tolerance(case_list[0], 0, CASE_DEFAULT, "mueller") >
                case_tolerance(case_list[0], 0, CASE_DEFAULT, "wcsph"));
}

/* 4,000 particles, five compressed by 10 % and the rest by 1 % or thinner than at rest, twice. */
static void compression_has_its_percentile(void **state)
{
    (void)state;
    static CompressionTally tally;
    Cloud cloud = cloud_of(0.1);
    WorldDef def = world_def_default();
    def.fluids[0].density = 1000;
    assert_true(compression_figures(&tally).mean == 0 && compression_figures(&tally).p999 == 0);
    for (int i = 0; i < MOST; i++) {
        add(&cloud, 0, 0, 0);
        cloud.density[i] = i < 5 ? 1100 : i % 2 ? 1010 : 900;
    }
    compression_add(&tally, &cloud, &def);
    near(compression_figures(&tally).mean, (5 * 0.1 + 1998 * 0.01) / MOST, 2e-6);
    near(compression_figures(&tally).p999, 0.1, 1e-3);
    cloud.density[0] = cloud.density[1] =
        1200; /* two above, eight at the quantile: the eighth of 8,000 is at the quantile */
    compression_add(&tally, &cloud, &def);
    near(compression_figures(&tally).p999, 0.1, 1.1e-3);
    near(compression_figures(&tally).most, 0.2, 1e-6);
    near(compression_figures(&tally).least, 0.9, 1e-6);
    assert_int_equal(tally.states, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_is_the_foremost_of_the_low_with_neighbours),
        cmocka_unit_test(pressure_is_off_by_its_rms),
        cmocka_unit_test(a_paraboloid_has_its_curvature),
        cmocka_unit_test(an_ellipse_has_its_axes),
        cmocka_unit_test(energies_are_those_of_the_masses),
        cmocka_unit_test(velocities_are_linear_between_particles),
        cmocka_unit_test(swings_have_period_and_decay),
        cmocka_unit_test(not_measured_is_the_worst),
        cmocka_unit_test(a_cavity_half_empty_is_no_result),
        cmocka_unit_test(compression_has_its_percentile),
        cmocka_unit_test(cases_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
