/* Corrected gradients of wcsph (sim/methods/wcsph/wcsph_passes.c): exact where velocity is linear and
   particles are somewhat out of order; momentum and energy kept; the same bits with any number of threads.
   And what shifts carry then (sim/methods/wcsph/wcsph_passes.c). */
#include "tests/sim/fixture.h"

#include "sim/methods/wcsph/wcsph.h"

enum { SIDE = 24, ALL = SIDE * SIDE };
static const double SPACING = 0.1, SOUND = 10;

static float x0[3 * ALL], v0[3 * ALL], density0[ALL];

/* A full box in the plane, off its lattice by 0.1 spacings at most; carries 1000 kg/m3 and up to `pressed`
   more or less. */
static WorldDef def_of(bool corrected, double pressed)
{
    static InitialState initial;
    uint32_t seed = 5;
    WorldDef def = fixture_def(SIDE * SPACING, SIDE * SPACING, 1);
    def.dimensions = 2;
    def.support = 3;
    def.sound_speed = SOUND;
    def.negative_pressure = true;
    snprintf(def.method, sizeof def.method, "wcsph");
    WcsphDef *own = wcsph_def(&def);
    snprintf(own->kernel, sizeof own->kernel, "wendland_c2");
    own->artificial_viscosity = 0;
    own->corrected_gradient = corrected;
    memset(def.gravity, 0, sizeof def.gravity);
    for (int i = 0; i < ALL; i++) {
        for (int k = 0; k < 2; k++) {
            const int cell = k ? i / SIDE : i % SIDE;
            const double place = (cell + (k ? 0.5 : 0.5 - 0.5 * SIDE)) * SPACING;
            x0[3 * i + k] = (float)(place + 0.1 * SPACING * (2 * fixture_random(&seed) - 1));
        }
        density0[i] = (float)(1000 + pressed * (2 * fixture_random(&seed) - 1));
        v0[3 * i] = v0[3 * i + 1] = 0;
    }
    initial = (InitialState){.count = ALL, .position = x0, .velocity = v0, .density = density0};
    def.initial = &initial;
    return def;
}

static bool is_inside(int i)
{
    return fabs((double)x0[3 * i]) < 0.5 && fabs((double)x0[3 * i + 1] - 1.2) < 0.5;
}

/* For a flow with divergence 0.3 1/s everywhere: the worst error of the density rate away from walls,
   relative to the rate at a density of 1000 (1 + dense). */
static double rate_error(bool corrected, double dense)
{
    WorldDef def = def_of(corrected, 0);
    double worst = 0;
    def.sound_speed = 1; /* pressure has no part in it */
    def.dt = 1e-3;
    for (int i = 0; i < ALL; i++) {
        v0[3 * i] = 0.5F * x0[3 * i] + 0.7F * x0[3 * i + 1];
        v0[3 * i + 1] = -0.2F * x0[3 * i + 1];
        density0[i] = (float)(1000 * (1 + dense));
    }
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (int i = 0; i < ALL; i++)
        if (is_inside(i))
            worst = fmax(worst, fabs((1 - (double)s.density[i] / (double)density0[i]) / def.dt / 0.3 - 1));
    fixture_free(&s);
    world_destroy(world);
    return worst;
}

static void rates_of_linear_flows_are_exact(void **state)
{
    (void)state;
    const double plain = rate_error(false, 0), corrected = rate_error(true, 0),
                 dense = rate_error(true, 0.02);
    printf("  off by %g, corrected %g, compressed %g\n", plain, corrected, dense);
    assert_true(plain > 0.02);
    assert_true(corrected < 0.003);
    assert_true(dense < 0.003);
}

/* The same in space, where the matrix has all of its members, and a side ten spacings. */
static double rate_error_in_space(bool corrected)
{
    enum { DEEP = 10, COUNT = DEEP * DEEP * DEEP };
    static const float slope[3][3] = {{0.5F, 0.7F, -0.3F}, {0.2F, -0.4F, 0.6F}, {-0.5F, 0.8F, 0.2F}};
    static float x[3 * COUNT], v[3 * COUNT], density[COUNT];
    const InitialState initial = {.count = COUNT, .position = x, .velocity = v, .density = density};
    WorldDef def = def_of(corrected, 0);
    uint32_t seed = 6;
    double worst = 0;
    for (int i = 0; i < COUNT; i++) {
        const int cell[3] = {i % DEEP, i / DEEP % DEEP, i / DEEP / DEEP};
        for (int k = 0; k < 3; k++) {
            const double place = (cell[k] + 0.5 - (k == 1 ? 0 : 0.5 * DEEP)) * SPACING;
            x[3 * i + k] = (float)(place + 0.1 * SPACING * (2 * fixture_random(&seed) - 1));
        }
        for (int k = 0; k < 3; k++)
            v[3 * i + k] = slope[k][0] * x[3 * i] + slope[k][1] * x[3 * i + 1] + slope[k][2] * x[3 * i + 2];
        density[i] = 1000;
    }
    def.dimensions = 3;
    def.initial = &initial;
    def.sound_speed = 1;
    def.dt = 1e-3;
    for (int k = 0; k < 3; k++)
        def.box_size[k] = DEEP * SPACING;
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (int i = 0; i < COUNT; i++)
        if (fabsf(x[3 * i]) < 0.15F && fabsf(x[3 * i + 1] - 0.5F) < 0.15F && fabsf(x[3 * i + 2]) < 0.15F)
            worst = fmax(worst, fabs((1 - (double)s.density[i] / 1000) / def.dt / 0.3 - 1));
    fixture_free(&s);
    world_destroy(world);
    return worst;
}

static void rates_in_space_are_exact(void **state)
{
    (void)state;
    const double plain = rate_error_in_space(false), corrected = rate_error_in_space(true);
    printf("  off by %g, corrected %g\n", plain, corrected);
    assert_true(plain > 0.1);
    assert_true(corrected < 0.005);
}

/* Of motion and of compression, by p = c^2 (rho - rho0): J over m. */
static double energy_of(World *world)
{
    State s = fixture_read(world);
    double sum = 0;
    for (int i = 0; i < ALL; i++) {
        const double e = (double)s.density[i] / 1000 - 1;
        for (int k = 0; k < 2; k++)
            sum += 0.5 * (double)s.velocity[4 * i + k] * (double)s.velocity[4 * i + k];
        sum += 0.5 * SOUND * SOUND * e * e;
    }
    fixture_free(&s);
    return sum;
}

static void momentum_and_energy_are_kept(void **state)
{
    (void)state;
    for (int walls = 0; walls < 2; walls++) {
        WorldDef def = def_of(true, 1);
        def.periodic[0] = def.periodic[1] = !walls;
        def.dt = 1e-3;
        World *world = fixture_world(&def);
        const double before = energy_of(world);
        fixture_step(world, 200);
        const double after = energy_of(world);
        WorldSums sums;
        world_sums(world, &sums);
        printf("  energy %.6g, then %.6g; momentum %.2g of %.2g kg m/s\n", before, after,
               hypot(sums.momentum[0], sums.momentum[1]), sums.momentum_scale);
        assert_true(fabs(after / before - 1) < 0.01);
        assert_true(walls || hypot(sums.momentum[0], sums.momentum[1]) < 1e-4 * sums.momentum_scale);
        world_destroy(world);
    }
}

/* A shear is the same wherever particles are shifted to. */
static void shifts_keep_linear_flows(void **state)
{
    (void)state;
    WorldDef def = def_of(true, 0);
    double most = 0, worst = 0;
    def.dt = 0.01;
    wcsph_def(&def)->shifting = 0.5;
    for (int i = 0; i < ALL; i++)
        v0[3 * i] = 0.7F * x0[3 * i + 1];
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (int i = 0; i < ALL; i++)
        if (is_inside(i)) {
            most = fmax(most, fabs((double)s.position[4 * i + 1] - (double)x0[3 * i + 1]));
            worst = fmax(worst, fabs((double)s.velocity[4 * i] - 0.7 * (double)s.position[4 * i + 1]));
        }
    printf("  shifted by %g m; velocity off by %g m/s\n", most, worst);
    assert_true(most > 1e-3);
    assert_true(worst < 0.01 * most);
    fixture_free(&s);
    world_destroy(world);
}

/* Of a lattice that carries e = 0.01 sin(k y) the places after a step; shifts go to where the flow is denser,
   by half of its gradient: sum (S_i + S_j) / 2 F x_ij / n0 with S = -e. */
static State of_a_wave(double shifting, double k)
{
    WorldDef def = def_of(true, 0);
    def.periodic[0] = def.periodic[1] = true;
    def.dt = 0.01;
    wcsph_def(&def)->shifting = shifting;
    for (int i = 0; i < ALL; i++) {
        x0[3 * i] = (float)((i % SIDE + 0.5 - 0.5 * SIDE) * SPACING);
        x0[3 * i + 1] = (float)((i / SIDE + 0.5) * SPACING);
        density0[i] = (float)(1000 * (1 + 0.01 * sin(k * (double)x0[3 * i + 1])));
    }
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    world_destroy(world);
    return s;
}

static void shifts_follow_the_density_of_the_flow(void **state)
{
    (void)state;
    const double chi = 0.5, k = 2 * M_PI / (SIDE * SPACING);
    const double most = 0.5 * chi * SOUND * (0.5 * 3 * SPACING) * 0.01 * 0.01 * k;
    State still = of_a_wave(0, k), shifted = of_a_wave(chi, k);
    double worst = 0;
    for (int i = 0; i < ALL; i++) {
        const double shift = (double)shifted.position[4 * i + 1] - (double)still.position[4 * i + 1];
        worst = fmax(worst, fabs(shift / most - cos(k * (double)x0[3 * i + 1])));
    }
    printf("  shifts of %g m off by %g of that\n", most, worst);
    assert_true(worst < 0.1);
    fixture_free(&still);
    fixture_free(&shifted);
}

/* Of vortices in a box without walls, over a hundred steps. Shifts go by pairs; what they carry does not. */
static void shifts_hardly_change_momentum(void **state)
{
    (void)state;
    WorldDef def = def_of(true, 0);
    const double k = 2 * M_PI / (SIDE * SPACING);
    def.periodic[0] = def.periodic[1] = true;
    def.dt = 2e-3;
    wcsph_def(&def)->shifting = 0.2;
    for (int i = 0; i < ALL; i++) {
        v0[3 * i] = (float)(sin(k * (double)x0[3 * i]) * cos(k * (double)x0[3 * i + 1]));
        v0[3 * i + 1] = (float)(-cos(k * (double)x0[3 * i]) * sin(k * (double)x0[3 * i + 1]));
    }
    World *world = fixture_world(&def);
    WorldSums before, after;
    world_sums(world, &before);
    fixture_step(world, 100);
    world_sums(world, &after);
    const double change =
        hypot(after.momentum[0] - before.momentum[0], after.momentum[1] - before.momentum[1]);
    printf("  momentum changes by %.2g of %.2g kg m/s\n", change, after.momentum_scale);
    assert_true(change < 1e-3 * after.momentum_scale);
    world_destroy(world);
}

/* Fluid on the lattice about a block, after a step. */
static State beside_a_block(int slip)
{
    WorldDef def = def_of(true, 0);
    static InitialState around;
    def.dt = 0.01;
    def.fluids[0].viscosity = 1;
    wcsph_def(&def)->shifting = 0.5;
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_BOX, .centre = {0, 1.2, 0}, .size = {8 * SPACING, 8 * SPACING, 1}, .slip = slip};
    around = *def.initial;
    around.count = 0;
    for (int i = 0; i < ALL; i++) {
        const int x = i % SIDE, y = i / SIDE;
        if (abs(2 * x - (SIDE - 1)) < 8 && abs(2 * y - (SIDE - 1)) < 8)
            continue;
        x0[3 * around.count] = (float)((x + 0.5 - 0.5 * SIDE) * SPACING);
        x0[3 * around.count + 1] = (float)((y + 0.5) * SPACING);
        density0[around.count++] = 1000;
    }
    def.initial = &around;
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    world_destroy(world);
    return s;
}

/* Whether friction sees the particles of a solid is nothing to shifts. */
static void shifts_beside_solids_are_even(void **state)
{
    (void)state;
    State sticks = beside_a_block(SLIP_NONE), slips = beside_a_block(SLIP_FREE);
    double most = 0, apart = 0;
    for (size_t i = 0; i < slips.count; i++)
        for (size_t k = 0; k < 2; k++) {
            const double x = (double)slips.position[4 * i + k];
            most = fmax(most, fabs(x - (double)x0[3 * i + k]));
            apart = fmax(apart, fabs(x - (double)sticks.position[4 * i + k]));
        }
    printf("  shifts of %g m at most, %g m from those beside a block that holds\n", most, apart);
    assert_true(most < 1e-5 && apart < 1e-6);
    fixture_free(&sticks);
    fixture_free(&slips);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = def_of(true, 1);
        *world_threads(&def) = k ? 3 : 1;
        wcsph_def(&def)->delta_sph = wcsph_def(&def)->shifting = 0.1;
        World *world = fixture_world(&def);
        fixture_step(world, 20);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] && hash[0] == hash[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_of_linear_flows_are_exact),
        cmocka_unit_test(rates_in_space_are_exact),
        cmocka_unit_test(momentum_and_energy_are_kept),
        cmocka_unit_test(shifts_keep_linear_flows),
        cmocka_unit_test(shifts_follow_the_density_of_the_flow),
        cmocka_unit_test(shifts_hardly_change_momentum),
        cmocka_unit_test(shifts_beside_solids_are_even),
        cmocka_unit_test(threads_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
