/* The references of the known flows, each derived differently than in the case, and start states beyond
   fills. */
#include "tests/sim/fixture.h"

#include "app/bench/cases/case.h"
#include "app/scene/scene.h"

enum { LAYERS = 100 };

static float position[4 * LAYERS], velocity[4 * LAYERS], density[LAYERS], pressure[LAYERS];
static uint32_t fluid[LAYERS];
static CaseRun run;

static CaseRun *open_case(const char *name)
{
    static Scene scene;
    Error error = {{0}};
    const Case *of = case_find(name, &error);
    if (!of || !scene_load(of->scene, NULL, &scene, NULL, &error)) {
        fail_msg("%s", error.message);
        exit(1); /* never: for who reads the code by program */
    }
    memset(velocity, 0, sizeof velocity);
    run = (CaseRun){.of = of,
                    .def = &scene.world,
                    .cloud = {LAYERS, 0.01, 0.03, position, velocity, density, pressure, fluid}};
    return &run;
}

static void close_case(void)
{
    for (int c = 0; c < CASE_COLUMNS; c++)
        curve_free(&run.column[c]);
    for (int c = 0; c < CASE_CURVES; c++) {
        curve_free(&run.found[c]);
        curve_free(&run.expected[c]);
    }
}

static double error_of(int metric)
{
    Error error;
    assert_true(run.of->judge(&run, &error));
    return run.figures[metric].error;
}

/* u' = a + nu u_yy between a floor at rest and a lid, by finite differences in the middles of the layers: the
   flow as a case samples it, times `factor`. */
static void sample_channel(const WorldDef *def, double factor)
{
    const double nu = def->fluids[0].viscosity / def->fluids[0].density, step = def->box_size[1] / LAYERS,
                 dt = 0.2 * step * step / nu;
    double u[LAYERS + 2] = {0}, next[LAYERS + 2];
    for (int n = 1; n * dt < 2; n++) {
        u[0] = -u[1]; /* mirrored in the walls' velocities */
        u[LAYERS + 1] = 2 * def->lid[0] - u[LAYERS];
        for (int i = 1; i <= LAYERS; i++)
            next[i] = u[i] + dt * (def->gravity[0] + nu * (u[i - 1] - 2 * u[i] + u[i + 1]) / (step * step));
        memcpy(u + 1, next + 1, LAYERS * sizeof *u);
        if (n % 500 != 0)
            continue;
        for (int i = 0; i < LAYERS; i++) {
            position[4 * i + 1] = (float)((i + 0.5) * step);
            velocity[4 * i] = (float)(factor * u[i + 1]);
        }
        run.info.time = n * dt;
        run.of->sample(&run);
    }
}

static void channels_start_as_diffusion_does(void **state)
{
    (void)state;
    const char *const names[] = {"poiseuille", "couette"};
    for (int k = 0; k < 2; k++) {
        const CaseRun *channel = open_case(names[k]);
        sample_channel(channel->def, 1);
        assert_float_equal(error_of(0), 0, 1e-3);
        close_case();
        sample_channel(open_case(names[k])->def, 1.05); /* all 5 % too fast: by the rms of the profile */
        assert_true(error_of(0) > 0.02 && error_of(0) < 0.05);
        close_case();
    }
}

/* The drop keeps energy, proportional to A^2 (a^2 + b^2), and area; A = -a' / a. */
static void an_ellipse_keeps_its_energy(void **state)
{
    (void)state;
    open_case("elliptical_drop");
    run.info.time = run.of->time;
    for (int i = 0; i < LAYERS; i++) {
        position[4 * i] = (float)cos(i);
        position[4 * i + 1] = (float)sin(i);
    }
    run.of->sample(&run);
    error_of(0);
    const Curve *a = &run.expected[0], *b = &run.expected[1];
    assert_true(a->count > 100);
    for (size_t i = 1; i + 1 < a->count; i++) {
        const double rate =
            -(a->at[i + 1][1] - a->at[i - 1][1]) / (a->at[i + 1][0] - a->at[i - 1][0]) / a->at[i][1];
        const double square = a->at[i][1] * a->at[i][1] + b->at[i][1] * b->at[i][1];
        assert_float_equal(rate * rate * square / (2 * 100 * 100), 1, 1e-4);
        assert_float_equal(a->at[i][1] * b->at[i][1], 1, 1e-9);
    }
    close_case();
}

/* Energy that falls by the formula with a known viscosity, and 10 % faster. */
static void vortices_lose_energy_by_their_dissipation(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        const WorldDef *def = open_case("taylor_green")->def;
        /* dE/dt = -mu <omega^2>, E = rho <v^2> / 2; k^2 = 2 (2 pi / L)^2 and <omega^2> = k^2 <v^2> */
        const double wave = 2 * M_PI / def->box_size[0], mu = def->fluids[0].viscosity,
                     rho = def->fluids[0].density;
        const double rate = 2 * mu / rho * (2 * wave * wave) * (k ? 1.1 : 1);
        for (int i = 0; i <= 75; i++) {
            run.info.time = 0.02 * i;
            for (int p = 0; p < LAYERS; p++)
                velocity[4 * p] = (float)exp(-0.5 * rate * run.info.time);
            run.of->sample(&run);
        }
        assert_float_equal(error_of(0), k ? 0.1 : 0, 1e-5);
        close_case();
    }
}

/* Volume is conserved, floor and sides are tight, and the surface rises at a wall as much as the surface
   sinks at the opposite wall. The rate is omega times the greatest height. */
static void a_wave_starts_without_sources(void **state)
{
    (void)state;
    const WorldDef *def = open_case("standing_wave")->def;
    const double e = 1e-3, wide = def->fluids[0].fills[0].max[0];
    const double places[][2] = {{0.1, 0.4}, {-0.3, 0.8}, {0.45, 0.95}};
    for (int k = 0; k < 3; k++) {
        const double x = places[k][0], y = places[k][1];
        /* the last two tell the surface's height: half a spacing above the highest */
        float at[3 * 8] = {(float)(x - e),
                           (float)y,
                           0,
                           (float)(x + e),
                           (float)y,
                           0,
                           (float)x,
                           (float)(y - e),
                           0,
                           (float)x,
                           (float)(y + e),
                           0,
                           0.1F,
                           0,
                           0,
                           (float)wide,
                           0.5F,
                           0,
                           (float)-wide,
                           (float)(1 - 0.5 * def->spacing),
                           0,
                           (float)wide,
                           (float)(1 - 0.5 * def->spacing),
                           0};
        float v[3 * 8] = {0}, rho[8];
        for (int i = 0; i < 8; i++)
            rho[i] = 1000;
        run.of->start(def, &(CaseStart){8, at, v, rho, NULL});
        const double divergence = ((double)(v[3] - v[0]) + (double)(v[10] - v[7])) / (2 * e);
        assert_float_equal(divergence, 0, 2e-3);
        assert_float_equal(v[13], 0, 1e-6); /* at the floor */
        assert_float_equal(v[15], 0, 1e-6); /* at a side */
        assert_float_equal(v[19], -v[22], 1e-6);
        const double wave = M_PI / (2 * wide), omega = sqrt(9.81 * wave * tanh(wave));
        assert_float_equal(fabs((double)v[19]), 0.03 * omega, 0.05 * 0.03 * omega);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(channels_start_as_diffusion_does),
        cmocka_unit_test(an_ellipse_keeps_its_energy),
        cmocka_unit_test(vortices_lose_energy_by_their_dissipation),
        cmocka_unit_test(a_wave_starts_without_sources),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
