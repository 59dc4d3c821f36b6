/* Small known flows: the scenes taylor_green, poiseuille, couette and cavity, coarser than shipped.
   docs/labbook/validation.md has the errors at full resolution. */
#include "tests/scene/scene_text.h"

#include "sim/world.h"

#include <math.h>
#include <stdlib.h>

static Scene scene;

static World *start(const char *name, const char *spacing, const char *dt)
{
    SceneSettings settings = {.count = 2, .set = {spacing, dt}};
    Error error = {0};
    if (!scene_load(name, &settings, &scene, NULL, &error))
        fail_msg("%s", error.message);
    *world_threads(&scene.world) = 1; /* small */
    World *world = world_create(&scene.world, &error);
    if (!world)
        fail_msg("%s", error.message);
    return world;
}

static void run_until(World *world, double time)
{
    WorldInfo info;
    Error error = {0};
    for (world_info(world, &info); info.time < time - 1e-9; world_info(world, &info))
        if (!world_step(world, NULL, &error))
            fail_msg("%s", error.message);
    assert_float_equal(info.time, time, 1e-9);
}

typedef struct Flow {
    size_t count;
    float *x, *v; /* 4 a particle */
} Flow;

static Flow flow_of(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    Flow flow = {info.count, malloc(info.count * 4 * sizeof(float)), malloc(info.count * 4 * sizeof(float))};
    world_read(world, &(ParticleArrays){.position = flow.x, .velocity = flow.v});
    return flow;
}

static void flow_free(Flow *flow)
{
    free(flow->x);
    free(flow->v);
}

static double kinetic_energy(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sums.kinetic_energy;
}

/* ln(kinetic energy) falls by 16 pi^2 / Re a second. */
static void taylor_and_green_s_vortices_decay(void **state)
{
    (void)state;
    World *world = start("taylor_green", "particles.spacing=0.03125", "solver.step.dt=0.025");
    const double initial = kinetic_energy(world);
    assert_float_equal(initial, 1000 * 0.25, 2); /* rho U^2 / 4 */
    run_until(world, 0.2);
    const double first = kinetic_energy(world);
    run_until(world, 0.8);
    const double slope = log(kinetic_energy(world) / first) / 0.6, exact = -16 * M_PI * M_PI / 100;
    printf("Taylor-Green, 32 x 32: slope off by %.2f %%\n", 100 * (slope / exact - 1));
    assert_float_equal(slope / exact, 1, 0.03);
    world_destroy(world);
}

/* Of the velocity along x, over the greatest: the worst of the particles. */
static double worst_in_channel(World *world, double (*exact)(double y, double time), double time)
{
    Flow flow = flow_of(world);
    double worst = 0;
    for (size_t i = 0; i < flow.count; i++)
        worst = fmax(worst, fabs((double)flow.v[4 * i] - exact((double)flow.x[4 * i + 1], time)));
    flow_free(&flow);
    return worst;
}

/* nu = 0.1 m2/s, H = 1 m, U = 1 m/s. */
static double poiseuille(double y, double time)
{
    double u = 4 * y * (1 - y);
    for (int n = 1; n < 40; n += 2)
        u -= 32 / pow(M_PI * n, 3) * sin(n * M_PI * y) * exp(-0.1 * pow(M_PI * n, 2) * time);
    return u;
}

static double couette(double y, double time)
{
    double u = y;
    for (int n = 1; n < 40; n++)
        u += 2 / (n * M_PI) * (n % 2 ? -1 : 1) * sin(n * M_PI * y) * exp(-0.1 * pow(M_PI * n, 2) * time);
    return u;
}

static void channels_start(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double (*exact)(double y, double time);
    } flows[] = {{"poiseuille", poiseuille}, {"couette", couette}};
    for (int k = 0; k < 2; k++) {
        World *world = start(flows[k].name, "particles.spacing=0.05", "solver.step.dt=0.025");
        for (int n = 0; n < 3; n++) {
            static const double times[] = {0.5, 1, 2};
            run_until(world, times[n]);
            const double worst = worst_in_channel(world, flows[k].exact, times[n]);
            printf("%s, 20 across, %g s: off by %.2f %%\n", flows[k].name, times[n], 100 * worst);
            assert_float_equal(worst, 0, 0.01);
        }
        world_destroy(world);
    }
}

/* Mean of a velocity over the particles within h of a point, by weight. */
static double velocity_at(const Flow *flow, double x, double y, double h, int k)
{
    double sum = 0, weight = 0;
    for (size_t i = 0; i < flow->count; i++) {
        const double q = hypot((double)flow->x[4 * i] - x, (double)flow->x[4 * i + 1] - y) / h;
        const double w = q < 1 ? pow(1 - q, 4) * (1 + 4 * q) : 0;
        sum += w * (double)flow->v[4 * i + (size_t)k];
        weight += w;
    }
    return sum / weight;
}

/* Ghia 1982, Re 100, in the middle of the cavity, where a coarse flow is good already. */
static void a_lid_drags_a_vortex(void **state)
{
    (void)state;
    static const struct {
        double x, y;
        int k;
        double v;
    } points[] = {{0, 0.7344, 0, 0.00332},    {0, 0.5, 0, -0.20581}, {0, 0.2813, 0, -0.15662},
                  {-0.2656, 0.5, 1, 0.17527}, {0, 0.5, 1, 0.05454},  {0.3047, 0.5, 1, -0.24533}};
    World *world = start("cavity", "particles.spacing=0.04", "solver.step.dt=0.02");
    run_until(world, 10);
    Flow flow = flow_of(world);
    double worst = 0;
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        const double v = velocity_at(&flow, points[i].x, points[i].y, 0.08, points[i].k);
        worst = fmax(worst, fabs(v - points[i].v));
    }
    printf("cavity, 25 x 25: off by %.3f of the lid's speed\n", worst);
    assert_float_equal(worst, 0, 0.04);
    flow_free(&flow);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taylor_and_green_s_vortices_decay),
        cmocka_unit_test(channels_start),
        cmocka_unit_test(a_lid_drags_a_vortex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
