/* wcsph in time: order of the step, slow flows, diffusion, effects of viscosity, live changes. */
#include "fixture.h"
#include "sim/methods/wcsph/wcsph.h"

enum { SIDE = 10, N = SIDE * SIDE * SIDE };

typedef struct Block {
    float x[3 * N], v[3 * N], density[N];
    uint8_t fluid[N];
} Block;

/* A cube of lattice in the middle of a box of 6 m, far from its walls, that shrinks by `rate` (1/s). */
static WorldDef free_block(Block *block, double rate)
{
    WorldDef def = fixture_def(6, 6, 6);
    strcpy(def.method, "wcsph");
    memset(def.gravity, 0, sizeof def.gravity);
    wcsph_def(&def)->artificial_viscosity = 0;
    for (int i = 0; i < N; i++) {
        const int index[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        for (int k = 0; k < 3; k++) {
            const double x = 0.1 * (index[k] - 0.5 * (SIDE - 1));
            block->x[3 * i + k] = (float)(x + (k == 1 ? 3 : 0));
            block->v[3 * i + k] = (float)(-rate * x);
        }
        block->density[i] = 1000;
        block->fluid[i] = 0;
    }
    return def;
}

static World *world_of(WorldDef def, const Block *block)
{
    const InitialState initial = {.count = N,
                                  .position = block->x,
                                  .velocity = block->v,
                                  .fluid = block->fluid,
                                  .density = block->density};
    def.initial = &initial;
    return fixture_world(&def);
}

/* Positions and densities after 0.06 s of a block that pulsates. */
static State after_pulsation(int steps)
{
    static Block block;
    WorldDef def = free_block(&block, 0.5);
    strcpy(wcsph_def(&def)->kernel, "wendland_c2"); /* smooth, or the order is the kernel's */
    def.negative_pressure = true;
    def.dt = 0.06 / steps;
    World *world = world_of(def, &block);
    fixture_step(world, steps);
    const State s = fixture_read(world);
    world_destroy(world);
    return s;
}

static void differences(const State *a, const State *b, double *position, double *density)
{
    *position = *density = 0;
    for (size_t i = 0; i < N; i++) {
        for (size_t k = 0; k < 3; k++)
            *position += pow(a->position[4 * i + k] - b->position[4 * i + k], 2) / N;
        *density += pow(a->density[i] - b->density[i], 2) / N;
    }
    *position = sqrt(*position);
    *density = sqrt(*density);
}

/* Half the step, a quarter of the error. */
static void the_step_is_of_second_order(void **state)
{
    (void)state;
    State s[3] = {after_pulsation(30), after_pulsation(60), after_pulsation(120)};
    double x[2], density[2];
    for (int i = 0; i < 2; i++)
        differences(&s[i], &s[i + 1], &x[i], &density[i]);
    printf("differences of steps of 2, 1, 0.5 ms: positions %.2g, %.2g m; densities %.2g, %.2g kg/m3\n", x[0],
           x[1], density[0], density[1]);
    assert_true(x[0] / x[1] > 3.5 && x[0] / x[1] < 4.5);
    assert_true(density[0] / density[1] > 3.5 && density[0] / density[1] < 4.5);
    for (int i = 0; i < 3; i++)
        fixture_free(&s[i]);
}

/* A flow that adds 1e-9 of the density in half a step: lost in single precision of the density. */
static void slow_compression_is_not_lost(void **state)
{
    (void)state;
    static Block block;
    for (double rate = 1e-2; rate > 5e-6; rate /= fixture_coarse(10, 1000)) {
        WorldDef def = free_block(&block, rate);
        def.sound_speed = 0.01; /* hardly any pressure */
        def.dt = 1e-4;
        World *world = world_of(def, &block);
        fixture_step(world, fixture_count(1000, 40));
        State s = fixture_read(world);
        WorldInfo info;
        world_info(world, &info);
        float *compression = malloc(N * sizeof *compression);
        uint32_t *id = malloc(N * sizeof *id);
        ParticleArrays out = {.id = id};
        out.scalar[SCALAR_COMPRESSION] = compression;
        world_read(world, &out);
        double mean = 0, count = 0;
        for (int i = 0; i < N; i++) {
            const float *x = block.x + 3 * (size_t)id[i];
            if (fabsf(x[0]) > 0.2f || fabsf(x[1] - 3) > 0.2f || fabsf(x[2]) > 0.2f)
                continue;
            mean += compression[i];
            count++;
        }
        const double expected = pow(1 - rate * info.time, -3) - 1;
        if (fabs(mean / count / expected - 1) > 0.02)
            fail_msg("at %g 1/s: %g, not %g", rate, mean / count, expected);
        free(compression);
        free(id);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* Noise of the density in a fluid at rest, after 20 steps: rms about the mean, and the mean. */
static double noise_after(double delta, double *mean)
{
    static Block block;
    uint32_t seed = 9;
    WorldDef def = free_block(&block, 0);
    for (int i = 0; i < N; i++)
        block.density[i] = (float)(1000 + 5 * (fixture_random(&seed) - 0.5));
    def.sound_speed = 20;
    wcsph_def(&def)->delta_sph = delta;
    def.negative_pressure = true;
    def.dt = 0.001;
    World *world = world_of(def, &block);
    fixture_step(world, 20);
    State s = fixture_read(world);
    double square = 0;
    *mean = 0;
    for (int i = 0; i < N; i++)
        *mean += s.density[i] / N;
    for (int i = 0; i < N; i++)
        square += pow(s.density[i] - *mean, 2) / N;
    fixture_free(&s);
    world_destroy(world);
    return sqrt(square);
}

/* A full box with density growing evenly along x and y, a step from rest: no diffusion, even in corners.
   Without the gradients the particles next to walls would change by 0.008 kg/m3. */
static void diffusion_leaves_an_even_slope(void **state)
{
    (void)state;
    enum { EDGE = 8 };
    static float x[3 * EDGE * EDGE * EDGE], density[EDGE * EDGE * EDGE];
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = fixture_def(0.1 * EDGE, 0.1 * EDGE, 0.1 * EDGE);
        InitialState initial = {
            .count = EDGE * EDGE * (dimensions == 3 ? EDGE : 1), .position = x, .density = density};
        for (size_t i = 0; i < initial.count; i++) {
            const size_t index[3] = {i % EDGE, i / EDGE % EDGE, i / EDGE / EDGE};
            for (size_t k = 0; k < 3; k++)
                x[3 * i + k] = (float)(0.1 * ((double)index[k] + 0.5) - (k == 1 ? 0 : 0.05 * EDGE));
            if (dimensions == 2)
                x[3 * i + 2] = 0;
            density[i] = (float)(1000 + (double)index[0] + 2 * (double)index[1]);
        }
        def.dimensions = dimensions;
        def.support = dimensions == 2 ? 2.6 : 2.1;
        memset(def.gravity, 0, sizeof def.gravity);
        strcpy(def.method, "wcsph");
        wcsph_def(&def)->delta_sph = 0.1;
        def.dt = 1e-4;
        def.initial = &initial;
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        State s = fixture_read(world);
        double most = 0;
        for (size_t i = 0; i < s.count; i++)
            most = fmax(most, fabs((double)s.density[i] - (double)density[i]));
        assert_true(most < 1e-3);
        fixture_free(&s);
        world_destroy(world);
    }
}

static void diffusion_calms_the_density(void **state)
{
    (void)state;
    double with_mean, without_mean;
    const double without = noise_after(0, &without_mean), with = noise_after(0.1, &with_mean);
    printf("noise of 1.4 kg/m3 after 20 steps: %.2f without diffusion, %.2f with\n", without, with);
    assert_true(with < 0.7 * without);
    assert_true(fabs(with_mean - without_mean) < 0.1);
}

/* Heavy and light fluid, viscous and artificially damped, through each other. */
static void viscosity_keeps_momentum(void **state)
{
    (void)state;
    static Block block;
    WorldDef def = free_block(&block, 1);
    def.fluid_count = 2;
    def.fluids[0].viscosity = 20;
    def.fluids[1] = (FluidDef){.name = "light", .density = 100};
    wcsph_def(&def)->artificial_viscosity = 0.3;
    def.dt = 0.001;
    for (int i = 0; i < N; i++) {
        block.fluid[i] = (uint8_t)(i / SIDE % 2);
        block.density[i] = block.fluid[i] ? 100 : 1000;
        block.v[3 * i] += block.fluid[i] ? 1.0f : -0.5f;
    }
    World *world = world_of(def, &block);
    WorldSums before, after;
    world_sums(world, &before);
    fixture_step(world, fixture_count(300, 120));
    world_sums(world, &after);
    assert_true(after.kinetic_energy < 0.9 * before.kinetic_energy);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(after.momentum[k] - before.momentum[k]) <= 1e-5 * before.momentum_scale);
    world_destroy(world);
}

/* A world changed before the first step equals a world made with the change; a later change continues. */
static void it_changes_while_it_lives(void **state)
{
    (void)state;
    Error error = {{0}};
    WorldDef def = fixture_def(1, 1, 1);
    strcpy(def.method, "wcsph");
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 800, .viscosity = 1};
    wcsph_def(&def)->delta_sph = 0.1;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.3, 0.5);
    fixture_block(&def, 1, -0.5, 0.3, -0.5, 0.5, 0.6, 0.5);
    World *changed = fixture_world(&def);
    def.gravity[0] = 3;
    def.fluids[0].viscosity = 2;
    def.fluids[1].viscosity = 0;
    def.sound_speed = 30;
    def.negative_pressure = true;
    def.dt = 0.001;
    World *made = fixture_world(&def);
    assert_true(world_change(changed, &def, &error));
    fixture_step(changed, fixture_count(40, 10));
    fixture_step(made, fixture_count(40, 10));
    assert_int_equal(world_hash(changed), world_hash(made));
    def.sound_speed = 20;
    def.fluids[0].viscosity = 0;
    assert_true(world_change(changed, &def, &error));
    fixture_step(changed, fixture_count(200, 20));
    world_destroy(changed);
    world_destroy(made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_step_is_of_second_order),    cmocka_unit_test(slow_compression_is_not_lost),
        cmocka_unit_test(diffusion_leaves_an_even_slope), cmocka_unit_test(diffusion_calms_the_density),
        cmocka_unit_test(viscosity_keeps_momentum),       cmocka_unit_test(it_changes_while_it_lives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
