/* pbf: residuals of iterations, by sums over all pairs in double precision; invariants of a step;
   robustness. */
#include "tests/dfsph/cloud.h"
#include "tests/dfsph/rows.h"
#include "tests/lists.h"

#include "sim/def.h"
#include "sim/methods/pbf/pbf_private.h"
#include "sim/step/world.h"

static WorldDef pbf_world(double width, double height, double depth)
{
    WorldDef def = fixture_def(width, height, depth);
    strcpy(def.method, "pbf");
    def.dt = 1.0 / 60;
    return def;
}

static WorldDef cloud_def(Cloud *cloud, double disorder)
{
    WorldDef def = pbf_world(8, 8, 8);
    cloud_make(cloud, &def, disorder, 150 * disorder);
    return def;
}

/* n / n0 - 1 of particle i, by all others. */
static double compression(const World *world, const State *s, size_t i)
{
    const Constants *c = &world->constants;
    const Kernel *kernel = &shape_kernels[INCOMPRESSIBLE_KERNEL];
    const double h = (double)c->support_radius;
    double n = 0;
    for (size_t j = 0; j < s->count; j++) {
        double r2 = 0;
        for (int k = 0; k < 3; k++) {
            const double d = (double)s->position[4 * i + (size_t)k] - (double)s->position[4 * j + (size_t)k];
            r2 += d * d;
        }
        n += r2 < h * h ? kernel->value(sqrt(r2), h) : 0;
    }
    return c->lattice.density_scale * n / c->lattice.number_density - 1;
}

/* The solver's reported residual is correct, and within tolerance. */
static void leaves_what_it_says(void **state)
{
    (void)state;
    static Cloud cloud;
    WorldDef def = cloud_def(&cloud, 0.02);
    pbf_def(&def)->tolerance = 1e-4;
    pbf_def(&def)->iterations = 2000;
    World *world = cloud_world(&def, &cloud);
    double mean = 0, most = 0;
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (size_t i = 0; i < N; i++) {
        const double e = fmax(compression(world, &s, i), 0);
        mean += e / N;
        most = fmax(most, e);
    }
    const StepSolve *solve = &world->solves[0];
    printf("%g iterations: mean %.3g, said %.3g; most %.3g, said %.3g\n", solve->iterations, mean,
           solve->mean, most, solve->most);
    assert_true(solve->iterations > 5 && solve->iterations < 2000);
    assert_true(solve->mean <= 1e-4);
    assert_float_equal(mean, solve->mean, 1e-5);
    assert_float_equal(most, solve->most, 1e-4);
    fixture_free(&s);
    world_destroy(world);
}

/* Nothing is outside, nothing is no number; the greatest speed, m/s. */
static double within(World *world)
{
    double speed = 0;
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++) {
        const float *x = s.position + 4 * i, *v = s.velocity + 4 * i;
        assert_true(walls_contain(&world->constants.walls, x));
        speed = fmax(speed, sqrt((double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])));
        assert_true(isfinite(speed));
    }
    fixture_free(&s);
    return speed;
}

/* By how much of its scale momentum changes in 10 steps. */
static double momentum_lost(double light, double disorder)
{
    static Cloud cloud;
    WorldDef def = cloud_def(&cloud, disorder);
    def.fluids[1].density = light;
    World *world = cloud_world(&def, &cloud);
    WorldSums before, after;
    double lost = 0;
    world_sums(world, &before);
    fixture_step(world, 10);
    world_sums(world, &after);
    for (int k = 0; k < 3; k++)
        lost = fmax(lost, fabs(after.momentum[k] - before.momentum[k]) / before.momentum_scale);
    world_destroy(world);
    return lost;
}

/* Momentum stays, but for ways that are cut short: light particles' beside heavy ones. */
static void keeps_momentum(void **state)
{
    (void)state;
    const double same = momentum_lost(1000, 0.004), apart = momentum_lost(1, 0.02);
    printf("momentum lost: %.2g, with 1 : 1000 %.2g\n", same, apart);
    assert_true(same < 1e-6);
    assert_true(apart < 5e-3);
}

static WorldDef dam_def(int threads)
{
    return dam_of("pbf", 1.0 / 60, threads);
}

static void same_bits_on_threads(void **state)
{
    (void)state;
    fixture_needs_cpu("has no threads");
    check_same_bits_on_threads(dam_def(1), 40);
}

static void goes_on_from_a_saved_state(void **state)
{
    (void)state;
    const WorldDef def = dam_def(1);
    check_goes_on(&def, 30);
}

/* Mean compression with lists that are new. */
static double settled_compression(World *world)
{
    double mean = 0;
    world_recompute_derived(world);
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++)
        mean += fmax((double)s.density[i] / 1000 - 1, 0) / (double)s.count;
    fixture_free(&s);
    return mean;
}

static double energy_of(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sums.kinetic_energy + 9.81 * sums.mass * sums.centre[1];
}

/* A dam that breaks at 60 steps a second: as little compression as asked for, no energy out of nothing. */
static void dam_breaks(void **state)
{
    (void)state;
    const WorldDef def = dam_def(2);
    World *world = fixture_world(&def);
    double worst = 0, energy = 0, start = 0;
    for (int step = 0; step < 120; step++) {
        fixture_step(world, 1);
        worst = fmax(worst, settled_compression(world));
        energy = energy_of(world);
        start = step == 0 ? energy : start;
        assert_true(energy < 1.01 * start);
    }
    printf("mean compression %.3f %% at most; energy %.3f of the start\n", 100 * worst, energy / start);
    assert_true(worst < 0.015);
    world_destroy(world);
}

static WorldDef column_def(void)
{
    WorldDef def = pbf_world(0.5, 1.5, 0.5);
    def.spacing = 0.05;
    fixture_block(&def, 0, -0.25, 0, -0.25, 0.25, 1, 0.25);
    return def;
}

/* Steps far shorter than pbf is made for. Compression found in a step must not turn into velocity over
   the short time: a dam break, a column at rest, without energy gain. */
static void short_steps_do_not_boil(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    static const double dts[] = {0.0005, 0.0012, 0.005};
    for (int k = 0; k < 6; k++) {
        WorldDef def = k < 3 ? dam_def(1) : column_def();
        def.dimensions = 2;
        def.dt = dts[k % 3];
        World *world = fixture_world(&def);
        WorldSums sums;
        const double start = energy_of(world);
        double most = 0, worst = 0;
        for (int frame = 0; frame < 14; frame++) {
            fixture_step(world, (int)(0.05 / def.dt));
            most = fmax(most, energy_of(world) / start);
            worst = fmax(worst, settled_compression(world));
        }
        world_sums(world, &sums);
        const double speed = sqrt(2 * sums.kinetic_energy / sums.mass);
        printf("%s, %.1f ms: energy %.4f of the start at most, compression %.2f %%, %.3f m/s\n",
               k < 3 ? "dam" : "column", 1e3 * def.dt, most, 100 * worst, speed);
        assert_true(most < 1.002);
        assert_true(worst < 0.015);
        assert_true(k < 3 || speed < 0.1);
        world_destroy(world);
    }
}

/* A cube that begins far too dense, m, comes apart no faster in short steps than in long ones. */
static void crowds_part_gently(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    static Cloud cloud;
    for (int k = 0; k < 3; k++) {
        WorldDef def = cloud_def(&cloud, 0);
        double fastest = 0;
        for (int i = 0; i < 3 * N; i++)
            cloud.x[i] *= 0.85F;
        def.fluid_count = 1;
        memset(cloud.fluid, 0, sizeof cloud.fluid);
        def.dt = (double[]){0.0005, 0.002, 1.0 / 60}[k];
        World *world = cloud_world(&def, &cloud);
        for (int step = 0; step < (int)(0.05 / def.dt); step++) {
            fixture_step(world, 1);
            fastest = fmax(fastest, within(world));
        }
        printf("%.1f ms: %.2f m/s\n", 1e3 * def.dt, fastest);
        assert_true(fastest < 5);
        world_destroy(world);
    }
}

/* A tall dam with many iterations to build up pressure: overshoots are taken back. */
static void tall_dam_gains_no_energy(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = pbf_world(2.5, 3, 0.4);
    def.spacing = 0.05;
    fixture_block(&def, 0, -1.25, 0, -0.2, 0.25, 2, 0.2);
    World *world = fixture_world(&def);
    const double start = energy_of(world);
    double most = 0;
    for (int step = 0; step < 50; step++) {
        fixture_step(world, 1);
        most = fmax(most, energy_of(world) / start);
    }
    printf("tall dam: energy %.4f of the start at most\n", most);
    assert_true(most < 1.005);
    world_destroy(world);
}

/* A column without friction stands still: its multipliers hold its weight. */
static void column_stands(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    const WorldDef def = column_def();
    World *world = fixture_world(&def);
    double pressure = 0, speed = 0;
    size_t low = 0;
    fixture_step(world, 120);
    for (int step = 0; step < 60; step++) {
        fixture_step(world, 1);
        State s = fixture_read(world);
        for (size_t i = 0; i < s.count; i++)
            if (s.position[4 * i + 1] < 0.1F) {
                pressure += (double)s.pressure[i];
                low++;
            }
        fixture_free(&s);
        WorldSums sums;
        world_sums(world, &sums);
        speed = fmax(speed, sqrt(2 * sums.kinetic_energy / sums.mass));
    }
    WorldSums sums;
    world_sums(world, &sums);
    pressure /= (double)low;
    printf("centre at %.4f m, %.3f m/s, pressure near the floor %.0f Pa of %.0f\n", sums.centre[1], speed,
           pressure, 9810 * 0.95);
    assert_float_equal(sums.centre[1], 0.5, 0.01); /* 1 % of compression */
    assert_true(speed < 0.08);
    assert_float_equal(pressure, 9810 * 0.95, 1000);
    world_destroy(world);
}

/* The rows next to a floor or a plate have the weight above them. Images alone give rows that alternate by
   half a row's weight, and a first move where fluid has fallen to gives the lowest row 5 % too little. */
static void rows_carry_the_weight(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    for (int run = 0; run < 4; run++) {
        const int dimensions = 2 + run % 2;
        WorldDef def = pbf_world(0.6, 0.9, 0.32);
        double pressure[ROWS] = {0}, weight[ROWS] = {0};
        def.dimensions = dimensions;
        def.spacing = 0.04;
        def.support = dimensions == 2 ? 3 : 2.1;
        def.fluids[0].viscosity = 1;
        fixture_block(&def, 0, -0.3, 0, -0.16, 0.3, 0.6, 0.16);
        const double floor = run < 2 ? 0 : put_on_plate(&def);
        World *world = fixture_world(&def);
        fixture_step(world, 120);
        for (int step = 0; step < 120; step++) {
            fixture_step(world, 1);
            add_rows(world, floor, 0.6, pressure, weight);
        }
        for (int row = 0; row < 4; row++) {
            printf("%dD, on a %s, row %d: %.3f of the weight\n", dimensions, run < 2 ? "floor" : "plate", row,
                   pressure[row] / weight[row]);
            assert_float_equal(pressure[row], weight[row], 0.02 * weight[row]);
        }
        world_destroy(world);
    }
}

/* rms speed over sqrt(g H) of a tank with the solid, in the last two of ten seconds. */
static double stirred_beside(SolidDef solid, double floor)
{
    WorldDef def = pbf_world(1, 1.2, 1);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 3.1;
    fixture_block(&def, 0, -0.5, floor, -0.5, 0.5, 0.8, 0.5);
    def.solids[def.solid_count++] = solid;
    World *world = fixture_world(&def);
    double sum = 0;
    fixture_step(world, 480);
    for (int step = 0; step < 120; step++) {
        WorldSums sums;
        fixture_step(world, 1);
        world_sums(world, &sums);
        sum += 2 * sums.kinetic_energy / sums.mass / 120;
    }
    world_destroy(world);
    return sqrt(sum / (9.81 * (0.8 - floor)));
}

/* Pushes by solids do no work: boundary particles mirror the way of a step. Without that the last two have
   0.03 and 0.04, and do not calm down. What is left is above the boxes, where less than four layers lie on
   them. */
static void rests_beside_solids(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    const SolidDef plate = {.kind = SOLID_BOX, .centre = {0, 0.1, 0}, .size = {1, 0.2, 1}, .axis = {0, 1, 0}},
                   box = {.kind = SOLID_BOX, .centre = {0, 0.4, 0}, .size = {0.3, 0.3, 1}, .axis = {0, 1, 0}};
    SolidDef turned = box;
    turned.axis[1] = 0, turned.axis[2] = 1, turned.angle_deg = 45;
    const double on_plate = stirred_beside(plate, 0.2), by_box = stirred_beside(box, 0),
                 by_turned = stirred_beside(turned, 0);
    printf(
        "rms speed over sqrt(g H): %.4f on a plate, %.4f around a box, %.4f around one that stands on an edge\n",
        on_plate, by_box, by_turned);
    assert_true(on_plate < 0.006 && by_box < 0.013 && by_turned < 0.013);
}

/* Under a lid, where gravity is upwards, fluid rests as well as on the floor. */
static void rests_under_a_lid(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = pbf_world(0.5, 1, 0.5);
        def.dimensions = dimensions;
        def.spacing = 0.05;
        def.gravity[1] = 9.81;
        fixture_block(&def, 0, -0.25, 0.3, -0.25, 0.25, 0.8, 0.25);
        World *world = fixture_world(&def);
        WorldSums sums;
        fixture_step(world, 120);
        within(world);
        world_sums(world, &sums);
        const double speed = sqrt(2 * sums.kinetic_energy / sums.mass);
        printf("%dD: centre %.4f m below the lid, %.3f m/s\n", dimensions, 1 - sums.centre[1], speed);
        assert_float_equal(sums.centre[1], 0.75, 0.01);
        assert_true(speed < 0.1);
        world_destroy(world);
    }
}

/* The hand throws and turns the box at random, within the limits, ten times a second. */
static void throw_box(World *world, uint32_t *seed)
{
    BoxTarget target;
    double norm = 0;
    for (int k = 0; k < 4; k++) {
        target.orientation[k] = fixture_random(seed) - 0.5;
        norm += target.orientation[k] * target.orientation[k];
    }
    for (int k = 0; k < 4; k++)
        target.orientation[k] /= sqrt(norm);
    for (int k = 0; k < 3; k++)
        target.position[k] = 4 * (fixture_random(seed) - 0.5);
    world_set_target(world, &target);
}

static void check_shaken(int dimensions, int every)
{
    WorldDef def = dam_def(2);
    def.dimensions = dimensions;
    def.dt = 1.0 / 30;
    def.retries = 3;
    World *world = fixture_world(&def);
    uint32_t seed = 5;
    Error error = {0};
    double speed = 0, compressed = 0;
    for (int step = 0; step < 150; step++) {
        if (step % every == 0)
            throw_box(world, &seed);
        if (!world_step(world, NULL, &error))
            fail_msg("%s", error.message);
        speed = fmax(speed, within(world));
        compressed += settled_compression(world) / 150;
    }
    WorldInfo info;
    world_info(world, &info);
    printf("%dD, thrown every %d steps: %.1f m/s at most, compression %.2f %% in the mean\n", dimensions,
           every, speed, 100 * compressed);
    assert_int_equal(info.trouble.count, 0);
    assert_true(speed < 20);        /* the box's 2 m/s, and falls of its height at 3 g */
    assert_true(compressed < 0.01); /* 0.5 %; 1.1 % where lists that are of no use any more are trusted */
    world_destroy(world);
}

static void survives_a_shaken_box(void **state)
{
    (void)state;
    fixture_needs_cpu("hundreds of steps");
    for (int every = 3; every <= 12; every += 9) {
        check_shaken(3, every);
        check_shaken(2, every);
    }
}

/* How deep a particle is in a solid at the world's time, at most, m. */
static double deepest(World *world)
{
    const WorldDef *def = &world->def;
    WorldInfo info;
    double most = 0;
    world_info(world, &info);
    State s = fixture_read(world);
    for (int k = 0; k < def->solid_count; k++) {
        SolidPose pose;
        solid_pose_at(&def->solids[k], info.time, &pose);
        for (size_t i = 0; i < s.count; i++)
            most = fmax(most, -(double)solid_clearance(&def->solids[k], &pose, def->dimensions,
                                                       s.position + 4 * i, 1));
    }
    fixture_free(&s);
    return most;
}

/* A dam runs into a pillar while a thin paddle goes to and fro at 4 m/s: nothing is in them. */
static void solids_keep_fluid_out(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = dam_def(2);
        def.dimensions = dimensions;
        def.dt = 1.0 / 30;
        def.retries = 3;
        def.solids[def.solid_count++] = (SolidDef){
            .kind = SOLID_BOX, .centre = {0.3, 0.3, 0}, .size = {0.2, 0.6, 0.2}, .axis = {0, 1, 0}};
        def.solids[def.solid_count++] = (SolidDef){
            .kind = SOLID_BOX, .centre = {-0.3, 0.4, 0}, .size = {0.1, 0.8, 0.3}, .axis = {0, 1, 0}};
        add_solid_motion(&def.solids[1],
                         (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.3, .frequency = 2});
        World *world = fixture_world(&def);
        double deep = 0, speed = 0;
        for (int step = 0; step < fixture_count(90, 25); step++) {
            fixture_step(world, 1);
            speed = fmax(speed, within(world));
            deep = fmax(deep, deepest(world));
        }
        printf("%dD: %.2g m deep in solids at most, %.1f m/s\n", dimensions, deep, speed);
        assert_true(deep < 1e-5);
        assert_true(speed < 20);
        world_destroy(world);
    }
}

/* Light fluid on heavy fluid stays there, and both rest but for some jitter, 0.25 m/s at worst. */
static void two_fluids_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = pbf_world(0.5, 1.5, 0.5);
    def.spacing = 0.05;
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "light", .density = 1};
    fixture_block(&def, 0, -0.25, 0, -0.25, 0.25, 0.5, 0.25);
    fixture_block(&def, 1, -0.25, 0.5, -0.25, 0.25, 1, 0.25);
    World *world = fixture_world(&def);
    double heavy = 0, light = 0, speed = 0;
    fixture_step(world, 60);
    for (int step = 0; step < 60; step++) {
        WorldSums sums;
        fixture_step(world, 1);
        world_sums(world, &sums);
        speed += sqrt(2 * sums.kinetic_energy / sums.mass) / 60;
    }
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++)
        *(s.fluid[i] ? &light : &heavy) += (double)s.position[4 * i + 1] / ((double)s.count / 2);
    printf("two fluids: centres at %.4f and %.4f m, %.3f m/s in the mean\n", heavy, light, speed);
    assert_float_equal(heavy, 0.25, 0.01);
    assert_float_equal(light, 0.75, 0.02);
    assert_true(speed < 0.2);
    fixture_free(&s);
    world_destroy(world);
}

/* A jet of 2 m/s, whose layers come out two spacings a step, keeps its speed. */
static void jet_flies(void **state)
{
    (void)state;
    WorldDef def = pbf_world(4, 1, 1);
    memset(def.gravity, 0, sizeof def.gravity);
    def.spacing = 0.05;
    def.dt = 1.0 / 30;
    def.most = 5000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {-1.8, 0.5, 0}, .direction = {3, 0, 0}, .radius = 0.2, .speed = 2});
    World *world = fixture_world(&def);
    fixture_step(world, 36);
    WorldSums sums;
    WorldInfo info;
    world_sums(world, &sums);
    world_info(world, &info);
    printf("jet: %zu particles, %.3f m/s\n", info.count, sums.momentum[0] / sums.mass);
    assert_true(info.count > 1000);
    assert_float_equal(sums.momentum[0] / sums.mass, 2, 0.1);
    world_destroy(world);
}

/* Velocities of a free flight are exact in a box that spins and shakes; places fall by half a step's speed
   more. */
static void flies_freely_in_a_moving_box(void **state)
{
    (void)state;
    WorldDef def = pbf_world(8, 8, 8);
    add_motion(&def, (Motion){.kind = MOTION_SPIN, .axis = {1, 2, 3}, .rate = 2});
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 1}, .amplitude = 0.2, .frequency = 2});
    const float x0[3] = {0.5F, 4.5F, -0.3F}, v0[3] = {0.4F, 2.5F, 0.3F};
    def.initial = &(InitialState){.count = 1, .position = x0, .velocity = v0};
    World *world = fixture_world(&def);
    BoxState box;
    double start[3], speed[3], worst = 0, fastest = 0;
    box_state_at(def.motions, 2, 8, 0, &box);
    box_to_world(&box, (double[3]){0.5, 4.5, -0.3}, (double[3]){0.4, 2.5, 0.3}, start, speed);
    for (int step = 0; step < 50; step++) {
        WorldInfo info;
        double x[3], v[3];
        fixture_step(world, 1);
        world_info(world, &info);
        State s = fixture_read(world);
        box_to_world(&info.box, (double[3]){s.position[0], s.position[1], s.position[2]},
                     (double[3]){s.velocity[0], s.velocity[1], s.velocity[2]}, x, v);
        for (int k = 0; k < 3; k++) {
            const double t = info.time, g = k == 1 ? -9.81 : 0;
            worst = fmax(worst, fabs(x[k] - (start[k] + speed[k] * t + 0.5 * g * t * (t + def.dt))));
            fastest = fmax(fastest, fabs(v[k] - (speed[k] + g * t)));
        }
        fixture_free(&s);
    }
    printf("free flight: %.2g m and %.2g m/s off\n", worst, fastest);
    assert_true(worst < 1e-3);
    assert_true(fastest < 1e-3);
    world_destroy(world);
}

/* Some hundred particles on one point come apart, and the box stays in order. */
static void coincident_particles_part(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    enum { COUNT = 100 };
    float x[3 * COUNT];
    for (int i = 0; i < COUNT; i++)
        memcpy(x + 3 * i, (float[]){0.1F, 0.5F, 0.1F}, 12);
    WorldDef def = pbf_world(1, 1, 1);
    def.initial = &(InitialState){.count = COUNT, .position = x};
    World *world = fixture_world(&def);
    for (int step = 0; step < 60; step++) {
        fixture_step(world, 1);
        assert_true(within(world) < 100); /* a spacing an iteration */
    }
    assert_true(settled_compression(world) < 0.02);
    world_destroy(world);
}

/* More friction than a step stands is cut: thick fluid that was stirred calms down. */
static void thick_fluid_calms_down(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    static Cloud cloud;
    WorldDef def = cloud_def(&cloud, 0);
    uint32_t seed = 4;
    double speed = 0;
    def.fluid_count = 1;
    def.fluids[0].viscosity = 500;
    memset(cloud.fluid, 0, sizeof cloud.fluid);
    for (int i = 0; i < 3 * N; i++)
        cloud.v[i] = (float)(fixture_random(&seed) - 0.5);
    World *world = cloud_world(&def, &cloud);
    for (int step = 0; step < 20; step++) {
        fixture_step(world, 1);
        speed = within(world);
    }
    printf("stirred and thick: %.3f m/s\n", speed);
    assert_true(speed < 0.2);
    world_destroy(world);
}

static void lone_particle_comes_to_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    const float x[3] = {0.9F, 1, 0.9F}, v[3] = {30, -3, 30};
    WorldDef def = pbf_world(2, 2, 2);
    def.initial = &(InitialState){.count = 1, .position = x, .velocity = v};
    World *world = fixture_world(&def);
    double speed = 0;
    for (int step = 0; step < 300; step++) {
        fixture_step(world, 1);
        speed = within(world);
    }
    State s = fixture_read(world);
    printf("lone particle: %.3f m/s at %.4f m\n", speed, (double)s.position[1]);
    assert_true(s.position[1] < 0.1F);
    fixture_free(&s);
    world_destroy(world);
}

/* Where there is no room nothing is pressed, however the box is thrown. */
static void full_box_holds(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = pbf_world(0.5, 0.5, 0.5);
    def.dt = 1.0 / 30;
    def.spacing = 0.05;
    fixture_block(&def, 0, -0.25, 0, -0.25, 0.25, 0.5, 0.25);
    World *world = fixture_world(&def);
    uint32_t seed = 5;
    assert_int_equal(world->count, 1000);
    for (int step = 0; step < fixture_count(90, 45); step++) {
        if (step % 6 == 0 && step < 60)
            throw_box(world, &seed);
        fixture_step(world, 1);
        assert_true(within(world) < 20);
    }
    printf("full box: %.2f %% compressed\n", 100 * settled_compression(world));
    assert_true(settled_compression(world) < 0.015);
    world_destroy(world);
}

/* A tolerance of 0 asks for a number of iterations: no trouble. */
static void runs_as_many_iterations_as_asked(void **state)
{
    (void)state;
    WorldDef def = dam_def(1);
    Error error = {0};
    def.retries = 3;
    pbf_def(&def)->tolerance = 0;
    pbf_def(&def)->iterations = 1;
    World *world = fixture_world(&def);
    for (int step = 0; step < 60; step++)
        if (!world_step(world, NULL, &error))
            fail_msg("%s", error.message);
    WorldInfo info;
    world_info(world, &info);
    assert_int_equal(info.trouble.count, 0);
    assert_float_equal(info.solves[0].iterations, 1, 0);
    assert_true(info.solves[0].mean > 0);
    within(world);
    world_destroy(world);
}

/* A tolerance that nothing reaches is trouble with a name, and ends. */
static void says_that_it_does_not_converge(void **state)
{
    (void)state;
    WorldDef def = dam_def(1);
    Error error = {0};
    def.retries = 3;
    pbf_def(&def)->tolerance = 1e-9;
    pbf_def(&def)->iterations = 1;
    World *world = fixture_world(&def);
    bool good = true;
    for (int step = 0; step < 10 && good; step++)
        good = world_step(world, NULL, &error);
    assert_false(good);
    assert_non_null(strstr(error.message, "does not converge"));
    assert_non_null(strstr(error.message, "solver.compression"));
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(leaves_what_it_says),
        cmocka_unit_test(keeps_momentum),
        cmocka_unit_test(same_bits_on_threads),
        cmocka_unit_test(goes_on_from_a_saved_state),
        cmocka_unit_test(dam_breaks),
        cmocka_unit_test(short_steps_do_not_boil),
        cmocka_unit_test(crowds_part_gently),
        cmocka_unit_test(tall_dam_gains_no_energy),
        cmocka_unit_test(column_stands),
        cmocka_unit_test(rows_carry_the_weight),
        cmocka_unit_test(rests_beside_solids),
        cmocka_unit_test(rests_under_a_lid),
        cmocka_unit_test(survives_a_shaken_box),
        cmocka_unit_test(solids_keep_fluid_out),
        cmocka_unit_test(two_fluids_rest),
        cmocka_unit_test(jet_flies),
        cmocka_unit_test(flies_freely_in_a_moving_box),
        cmocka_unit_test(coincident_particles_part),
        cmocka_unit_test(thick_fluid_calms_down),
        cmocka_unit_test(lone_particle_comes_to_rest),
        cmocka_unit_test(full_box_holds),
        cmocka_unit_test(runs_as_many_iterations_as_asked),
        cmocka_unit_test(says_that_it_does_not_converge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
