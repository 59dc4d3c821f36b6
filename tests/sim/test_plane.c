/* Two dimensions: sums of the plane against brute force, walls, a column at rest, nothing out of the plane.
 */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/kernel/kernel.h"
#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/pbf/pbf.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/state.h"

static Error error;

static WorldDef plane_def(const char *method, double width, double height)
{
    WorldDef def = fixture_def(width, height, 0);
    def.dimensions = 2;
    def.support = 2.6;
    strcpy(def.method, method);
    return def;
}

/* A lattice filling the box has rest density everywhere: inside, at faces, in corners. */
static void full_box_has_rest_density(void **state)
{
    (void)state;
    const double supports[] = {2.1, 2.6, 3};
    for (int n = 0; n < 3; n++) {
        WorldDef def = plane_def("mueller", 2, 1.5);
        def.support = supports[n];
        fixture_block(&def, 0, -1, 0, 0, 1, 1.5, 0);
        World *world = fixture_world(&def);
        State s = fixture_read(world);
        assert_int_equal(s.count, 20 * 15);
        for (size_t i = 0; i < s.count; i++)
            if (fabs(s.density[i] - 1000) > 5)
                fail_msg("density %g at %g, %g (support %g)", s.density[i], s.position[4 * i],
                         s.position[4 * i + 1], supports[n]);
        fixture_free(&s);
        world_destroy(world);
    }
}

enum { COUNT = 300 };

/* Of `mueller` in free space, in double. */
static void sums_equal_brute_force(void **state)
{
    (void)state;
    static float x[3 * COUNT], v[3 * COUNT];
    static double n[COUNT], term[COUNT];
    WorldDef def = plane_def("mueller", 8, 8);
    memset(def.gravity, 0, sizeof def.gravity);
    def.dt = 1e-4;
    fixture_layers(&def, 10); /* random places */
    def.fluids[0].viscosity = 30;
    uint32_t seed = 3;
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 2; k++) {
            x[3 * i + k] = (float)(1.6 * (fixture_random(&seed) - 0.5) + 4 * k);
            v[3 * i + k] = (float)(2 * fixture_random(&seed) - 1);
        }
    def.initial = &(InitialState){COUNT, x, v, NULL, NULL, NULL, 0};
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    State s = fixture_read(world);

    const double h = def.support * def.spacing, c = def.sound_speed;
    Lattice lattice;
    lattice_calibrate(2, def.spacing, h, &density_kernels[0], &density_kernels[0], &lattice);
    assert_true(fabs(lattice.number_density - 100) < 1e-9);
    double at[COUNT][2];
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 2; k++)
            at[i][k] = x[3 * i + k] + 0.5 * def.dt * v[3 * i + k];
    for (int i = 0; i < COUNT; i++) {
        n[i] = 0;
        for (int j = 0; j < COUNT; j++)
            n[i] += lattice.density_scale *
                    density_kernel_find("spiky")->value(hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]), h);
        const double stiffness = c * c * lattice.stiffness_scale * 1000;
        const double p = fmax(stiffness * (n[i] / lattice.number_density - 1), 0);
        term[i] = p / (n[i] * n[i]);
        assert_true(fabs(s.position[4 * i + 3] * n[i] - 1) < 1e-4); /* the volume */
        assert_true(fabs(s.pressure[i] - p) < 1e-4 * stiffness);
    }
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 2; k++) {
            double force = 0, scale = 0;
            for (int j = 0; j < COUNT; j++) {
                const double r = hypot(at[i][0] - at[j][0], at[i][1] - at[j][1]);
                if (i == j || r >= h)
                    continue;
                const double push = -lattice.gradient_scale * kernel_spiky_derivative(r, h) *
                                    (term[i] + term[j]) * (at[i][k] - at[j][k]) / r;
                const double drag = 30 * lattice.laplacian_scale * kernel_viscosity_laplacian(r, h) /
                                    (n[i] * n[j]) * (v[3 * j + k] - v[3 * i + k]);
                force += push + drag;
                scale += fabs(push) + fabs(drag);
            }
            const double mass = 1000 / lattice.number_density;
            const double found = (s.velocity[4 * i + k] - v[3 * i + k]) / def.dt;
            if (fabs(found - force / mass) > 2e-4 * scale / mass + 5)
                fail_msg("acceleration of %d is %g, not %g", i, found, force / mass);
        }
    fixture_free(&s);
    world_destroy(world);
}

/* rms (p - rho0 g depth) / (rho0 g H) of a column of 30 layers that starts near its rest. */
static double column_error(const char *method)
{
    enum { SIDE = 12, LAYERS = 30 };
    static float x[3 * SIDE * LAYERS], density[SIDE * LAYERS];
    const int side = fixture_count(SIDE, SIDE / 2), count = side * LAYERS;
    WorldDef def = plane_def(method, 0.1 * side, 4);
    def.sound_speed = 50;
    def.fluids[0].viscosity = 2000;
    def.dt = fixture_coarse(0.001, 0.0015);
    dfsph_def(&def)->divergence_tolerance = 1e-5; /* so right is its pressure */
    if (strcmp(method, "pbf") == 0)
        def.dt = 1.0 / 60, pbf_def(&def)->tolerance = 1e-3; /* shorter steps have noise of pressure */
    double y = 0;
    for (int i = 0; i < count; i++) {
        const double depth = (LAYERS - i / side - 0.5) * 0.1, p = 9810 * depth, c2 = 2500;
        const double r = fixture_incompressible(&def)   ? 1
                         : strcmp(method, "wcsph") == 0 ? pow(1 + 7 * p / (1000 * c2), 1.0 / 7)
                                                        : 1 + p / (1000 * c2);
        x[3 * i] = (float)((i % side - 0.5 * (side - 1)) * 0.1);
        x[3 * i + 1] = (float)(y + 0.05 / r);
        density[i] = (float)(1000 * r);
        y += i % side == side - 1 ? 0.1 / r : 0;
    }
    def.initial = &(InitialState){.count = (size_t)count, .position = x, .density = density};
    World *world = fixture_world(&def);
    fixture_step(world, fixture_incompressible(&def) ? 700 : fixture_count(4000, 700));
    State s = fixture_read(world);
    double surface = 0, sum2 = 0;
    for (size_t i = 0; i < s.count; i++)
        surface = fmax(surface, s.position[4 * i + 1] + 0.05);
    for (size_t i = 0; i < s.count; i++) {
        const double p = 9810 * (surface - s.position[4 * i + 1]);
        sum2 += (s.pressure[i] - p) * (s.pressure[i] - p);
    }
    fixture_free(&s);
    world_destroy(world);
    return sqrt(sum2 / count) / (9810 * surface);
}

static void column_at_rest(void **state)
{
    (void)state;
    const double most[] = {0.05, 0.02, 0.05, 0.05};
    for (int m = 0; m < fixture_methods(); m++) {
        const double off = column_error(fixture_method_names[m]);
        printf("column in the plane: rms pressure error %.2f %% with %s\n", 100 * off,
               fixture_method_names[m]);
        assert_true(off < most[m]);
    }
}

/* A spinning and pulsating blob keeps momenta; with wcsph energy too. */
static void momenta_are_kept(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = plane_def(fixture_method_names[m], 20, 20);
        memset(def.gravity, 0, sizeof def.gravity);
        wcsph_def(&def)->artificial_viscosity = 0;
        def.dt = 5e-4;
        add_fill(&def.fluids[0], (Fill){.kind = FILL_BALL, .centre = {0, 10, 0}, .radius = 0.8});
        World *seeded = fixture_world(&def);
        State s = fixture_read(seeded);
        float *x = malloc(3 * s.count * sizeof *x), *v = malloc(3 * s.count * sizeof *v);
        for (size_t i = 0; i < s.count; i++) {
            const float dx = s.position[4 * i], dy = s.position[4 * i + 1] - 10;
            memcpy(x + 3 * i, s.position + 4 * i, 3 * sizeof *x);
            v[3 * i] = 0.3F - dy - 0.4F * dx;
            v[3 * i + 1] = dx - 0.4F * dy;
            v[3 * i + 2] = 0;
        }
        def.initial = &(InitialState){s.count, x, v, NULL, NULL, NULL, 0};
        World *world = fixture_world(&def);
        WorldSums before, after;
        world_sums(world, &before);
        fixture_step(world, 50);
        world_sums(world, &after);
        if (!(fabs(after.kinetic_energy / before.kinetic_energy - 1) > 1e-3))
            fail_msg("%s: nothing happened, kinetic energy %g J, then %g J", fixture_method_names[m],
                     before.kinetic_energy, after.kinetic_energy);
        for (int k = 0; k < 2; k++)
            assert_true(fabs(after.momentum[k] - before.momentum[k]) < 1e-5 * before.momentum_scale);
        assert_true(fabs(after.angular_momentum[2] - before.angular_momentum[2]) <
                    1e-3 * before.angular_scale);
        fixture_free(&s);
        free(x);
        free(v);
        world_destroy(seeded);
        world_destroy(world);
    }
}

static void in_the_plane(const State *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->position[4 * i + 2] != 0 || s->velocity[4 * i + 2] != 0)
            fail_msg("particle %zu is at z = %g and goes at %g m/s", i, s->position[4 * i + 2],
                     s->velocity[4 * i + 2]);
}

/* Pairs of coincident particles: the direction is arbitrary, within the plane. The pairs separate, except
   with wcsph, with zero pressure force at r = 0. */
static void coinciding_pairs_stay_in_the_plane(void **state)
{
    (void)state;
    enum { SIDE = 8, PAIRS = SIDE * SIDE };
    static float x[6 * PAIRS];
    for (int i = 0; i < PAIRS; i++)
        for (int twin = 0; twin < 2; twin++) {
            x[6 * i + 3 * twin] = (float)(0.1 * (i % SIDE) - 0.35);
            x[6 * i + 3 * twin + 1] = (float)(0.1 * (i / SIDE));
        }
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = plane_def(fixture_method_names[m], 1, 1);
        float density[2 * PAIRS];
        for (int i = 0; i < 2 * PAIRS; i++)
            density[i] = 1020;
        fixture_layers(&def, 10);
        def.initial = &(InitialState){.count = 2 * PAIRS, .position = x, .density = density};
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        State s = fixture_read(world);
        in_the_plane(&s);
        for (int i = 0; i < PAIRS && m != 1; i++)
            assert_true(hypotf(s.position[8 * i] - s.position[8 * i + 4],
                               s.position[8 * i + 1] - s.position[8 * i + 5]) > 1e-5F);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* The last guard puts particles beyond both walls of a corner into the corner, on the same spot. */
static void what_hits_a_corner_stays_in_the_plane(void **state)
{
    (void)state;
    const float x[] = {-0.48F, 0.02F, 0, -0.49F, 0.03F, 0, -0.47F, 0.01F, 0};
    const float v[] = {-8, -8, 0, -8, -8, 0, -8, -8, 0};
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = plane_def(fixture_method_names[m], 1, 1);
        def.dt = 0.01;
        def.sound_speed = 2;
        def.initial = &(InitialState){3, x, v, NULL, (float[]){1010, 1010, 1010}, NULL, 0};
        World *world = fixture_world(&def);
        WorldInfo info;
        fixture_step(world, 2);
        world_info(world, &info);
        assert_true(info.guarded >= 3);
        State s = fixture_read(world);
        in_the_plane(&s);
        fixture_free(&s);
        world_destroy(world);
    }
}

static WorldDef rocked(const char *method, int threads)
{
    WorldDef def = plane_def(method, 1.5, 1);
    *world_threads(&def) = threads;
    fixture_block(&def, 0, -0.75, 0, 0, 0.2, 0.6, 0);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.2, 0}, .amplitude = 0.05, .frequency = 1});
    add_motion(&def, (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 10, .frequency = 0.7});
    return def;
}

/* Also with a hand that pulls out of the plane; the same bits for any threads, and from a saved state. */
static void all_stays_in_the_plane(void **state)
{
    (void)state;
    const BoxTarget target = {{0.1, 0, 0.3}, {0.3, 0.2, 0.1, 0.9}};
    const int frames = fixture_count(200, 60);
    for (int m = 0; m < fixture_methods(); m++) {
        uint64_t hash[3];
        WorldState saved = {.count = 0};
        for (int run = 0; run < 3; run++) {
            const WorldDef def = rocked(fixture_method_names[m], 1 + run);
            World *world = fixture_world(&def);
            if (run == 2) {
                assert_true(world_load(world, &saved, &error));
            } else {
                world_set_target(world, &target);
                fixture_step(world, frames);
            }
            if (run == 1)
                assert_true(world_save(world, &saved, &error));
            fixture_step(world, frames);
            hash[run] = world_hash(world);
            State s = fixture_read(world);
            WorldInfo info;
            world_info(world, &info);
            assert_true(info.box.position[2] == 0 && info.box.orientation[0] == 0 &&
                        info.box.orientation[1] == 0);
            assert_true(fabs(info.hand.position[0]) > 0.01);
            assert_true(info.box_size[2] == def.spacing);
            in_the_plane(&s);
            fixture_free(&s);
            world_destroy(world);
        }
        assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
        world_state_free(&saved);
    }
}

static void refuse(const WorldDef *def, const char *reason)
{
    World *world = world_create(def, &error);
    assert_null(world);
    if (!strstr(error.message, reason))
        fail_msg("expected '%s' in '%s'", reason, error.message);
}

static void what_leaves_the_plane_is_refused(void **state)
{
    (void)state;
    WorldDef good = rocked("mueller", 1), bad = good;
    const float x[3] = {0, 0.5F, 0.01F};
    bad.gravity[2] = 1;
    refuse(&bad, "gravity leaves the plane");
    bad = good;
    own_motions(&bad)[0].axis[2] = 0.1;
    refuse(&bad, "motion 0: leaves the plane");
    bad = good;
    own_motions(&bad)[1].axis[0] = 0.1;
    refuse(&bad, "motion 1: leaves the plane");
    bad = good;
    bad.dimensions = 4;
    refuse(&bad, "2 or 3 dimensions");
    bad = good;
    bad.initial = &(InitialState){.count = 1, .position = x};
    refuse(&bad, "not in the plane");
    bad = good;
    bad.solid_count = 1;
    bad.solids[0] = (SolidDef){.kind = SOLID_BOX,
                               .centre = {0, 0.5, 0},
                               .size = {0.2, 0.2, 0.2},
                               .axis = {0, 1, 0},
                               .angle_deg = 30};
    refuse(&bad, "solid 0: leaves the plane");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_box_has_rest_density),
        cmocka_unit_test(sums_equal_brute_force),
        cmocka_unit_test(column_at_rest),
        cmocka_unit_test(momenta_are_kept),
        cmocka_unit_test(coinciding_pairs_stay_in_the_plane),
        cmocka_unit_test(what_hits_a_corner_stays_in_the_plane),
        cmocka_unit_test(all_stays_in_the_plane),
        cmocka_unit_test(what_leaves_the_plane_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
