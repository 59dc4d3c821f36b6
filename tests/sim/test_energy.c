/* Growth of energy without work done: found, mended by half the step, and nobody else is accused. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/state.h"
#include "sim/step/world.h"

static Error error;

/* Water at rest, as viscous as stones; a step is `share` of the longest one that friction stands. */
static WorldDef viscous_tank(double share)
{
    WorldDef def = fixture_def(0.4, 0.4, 0.02);
    def.dimensions = 2;
    def.spacing = 0.02;
    def.support = 2.6;
    def.sound_speed = 20;
    def.fluids[0].viscosity = 3000;
    def.retries = 3;
    fixture_block(&def, 0, -0.2, 0, -1, 0.2, 0.2, 1);
    const StepFriction friction = step_friction(&def);
    def.dt = share * step_viscous(&def, &friction);
    return def;
}

/* A column that falls over, with no friction but what wcsph brings. */
static WorldDef dam(const char *method)
{
    WorldDef def = fixture_def(1, 0.6, 0.02);
    def.dimensions = 2;
    def.spacing = 0.03;
    def.support = 2.6;
    def.sound_speed = 25;
    def.retries = 3;
    def.dt = 0.001;
    snprintf(def.method, sizeof def.method, "%s", method);
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    fixture_block(&def, 0, -0.5, 0, -1, -0.2, 0.5, 1);
    return def;
}

static WorldTrouble trouble_of(const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info.trouble;
}

static double rms_speed(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sqrt(2 * sums.kinetic_energy / sums.mass);
}

static WorldNumbers numbers_of(World *world)
{
    WorldNumbers numbers;
    world_save_numbers(world, &numbers);
    return numbers;
}

/* Slowly, where no other kind of trouble ever came, and fast. */
static void boiling_is_found_and_mended(void **state)
{
    static const double shares[] = {1.15, 1.5};
    (void)state;
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        const WorldDef def = viscous_tank(shares[i]);
        World *world = fixture_world(&def);
        double fastest = 0;
        for (int steps = 0; trouble_of(world).count == 0 && steps < 1000; steps++)
            fixture_step(world, 1);
        const WorldTrouble trouble = trouble_of(world);
        printf("%g of the limit: t = %g s\n", shares[i], trouble.time);
        assert_int_equal(trouble.count, 1);
        assert_int_equal(trouble.what, STEP_TROUBLE_ENERGY);
        assert_true(trouble.time - trouble.back_to < (fixture_on_cpu() ? 1.01 : 2.01) * def.dt);
        for (int steps = 0; steps < 150; steps++) {
            fixture_step(world, 1);
            fastest = steps > 20 ? fmax(fastest, rms_speed(world)) : 0;
        }
        assert_int_equal(trouble_of(world).count, 1);
        assert_true(fastest < 0.05);
        world_destroy(world);
    }
}

/* With half of half of the step it boils still. */
static void it_gives_up_and_names_friction(void **state)
{
    (void)state;
    WorldDef def = viscous_tank(4);
    def.retries = 1;
    World *world = fixture_world(&def);
    bool good = true;
    for (int steps = 0; good && steps < 1000; steps++)
        good = world_step(world, NULL, &error);
    assert_false(good);
    assert_non_null(strstr(error.message, step_trouble_words(STEP_TROUBLE_ENERGY)));
    assert_non_null(strstr(error.message, "lower viscosity"));
    world_destroy(world);
}

static void who_falls_or_rests_is_not_accused(void **state)
{
    WorldDef defs[] = {dam("mueller"), dam("wcsph"), viscous_tank(0.6), dam("dfsph"), dam("pbf"), dam("pbf")};
    (void)state;
    defs[4].dt = 1.0 / 60;
    for (size_t i = 0; i < (fixture_on_cpu() ? 6 : 3); i++) {
        if (fixture_on_fragment() && strcmp(defs[i].method, "mueller") != 0)
            continue;
        World *world = fixture_world(&defs[i]);
        fixture_step(world, i == 4 ? 200 : fixture_count(1500, 50));
        assert_int_equal(trouble_of(world).count, 0);
        assert_true(numbers_of(world).energy.until > 0);
        world_destroy(world);
    }
}

static void watched_for(World *world, int steps)
{
    for (int i = 0; i < steps; i++) {
        fixture_step(world, 1);
        assert_true(numbers_of(world).energy.until > 0);
    }
    assert_int_equal(trouble_of(world).count, 0);
}

static const Motion SHAKEN = {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.1, .frequency = 2},
                    ROCKED = {.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 40, .frequency = 2},
                    SPUN = {.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 6};

/* The counted work is the fluid's gain: energy minus work grows only by the step's error. Without the
   centrifugal or Euler's force, or with gravity in the world's axes, the growth is 0.4 to 1.5 of the
   stirring. */
static void work_of_a_moving_box_is_counted(void **state)
{
    const Motion motions[] = {SHAKEN, ROCKED, SPUN};
    (void)state;
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        WorldDef def = dam("mueller");
        add_motion(&def, motions[i]);
        World *world = fixture_world(&def);
        double least = 0, gain = 0, stirred = 0, work = 0;
        for (int step = 0; step < 1000; step++) {
            fixture_step(world, 1);
            const EnergyMark mark = numbers_of(world).energy;
            const double left = mark.sums.own - mark.work;
            assert_true(mark.until > 0);
            least = fmin(least, left);
            gain = fmax(gain, left - least);
            stirred += fabs(mark.work - work);
            work = mark.work;
        }
        printf("%s: gain %.3f of %.0f J stirred\n", motion_name(motions[i].kind), gain / stirred, stirred);
        assert_true(gain < 0.05 * stirred);
        assert_int_equal(trouble_of(world).count, 0);
        world_destroy(world);
    }
}

/* In a box that moves too, and where the full step would boil again the half of it stays. */
static void boiling_is_found_in_a_box_that_moves(void **state)
{
    const Motion motions[] = {SHAKEN, ROCKED, SPUN};
    (void)state;
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++)
        for (int boils = 0; boils < 2; boils++) {
            WorldDef def = viscous_tank(boils ? 1.15 : 0.6);
            add_motion(&def, motions[i]);
            World *world = fixture_world(&def);
            fixture_step(world, 1000);
            printf("%s: t = %g s\n", motion_name(motions[i].kind), trouble_of(world).time);
            assert_int_equal(trouble_of(world).count, boils);
            world_destroy(world);
        }
}

/* Keys do work, and a carried box too: earlier energy is no reference. */
static void work_is_no_trouble(void **state)
{
    (void)state;
    WorldDef def = dam("mueller");
    Motion *motion = add_motion(&def, SHAKEN);
    motion->start = 0.1003;
    motion->duration = 0.5;
    World *world = fixture_world(&def);
    watched_for(world, 700);
    def.gravity[1] = -40;
    assert_true(world_change(world, &def, &error));
    watched_for(world, 100);
    world_carry_box(world,
                    &(BoxTarget){{0, 0, 0}, {0, 0, 1, 0}}); /* upside down, and what has fallen up again */
    watched_for(world, 100);
    world_carry_box(world, &(BoxTarget){{0, 0, 0}, {0, 0, 0, 1}});
    watched_for(world, 100);
    world_set_target(world, &(BoxTarget){{0.3, 0, 0}, {0, 0, 0, 1}});
    watched_for(world, 100);
    world_destroy(world);
}

/* Along x, from `start` on: the box has the greatest velocity at once, 1.2 m/s, and loses the velocity at
   once in the frame at the end. */
static Motion jolt(double start, double way)
{
    return (Motion){.kind = MOTION_SHAKE,
                    .axis = {way, 0, 0},
                    .amplitude = 0.15,
                    .frequency = 1.3,
                    .start = start,
                    .duration = 0.2};
}

static Motion wrench(double start, double way)
{
    return (Motion){.kind = MOTION_ROCK,
                    .axis = {0, 0, way},
                    .angle_deg = 30,
                    .frequency = 1.3,
                    .start = start,
                    .duration = 0.2};
}

/* A jolt is pure work: without friction, energy minus work is constant within the step's accuracy. By the
   centre of mass alone the error is half the jolt's energy, 0.7 J a kg: ten times as much. */
static void jolts_are_counted(void **state)
{
    static const double frames[] = {0.001, 0.004, 0.016};
    (void)state;
    for (int i = 0; i < 12; i++) {
        WorldDef def = dam(i % 4 < 3 || fixture_on_fragment() ? "mueller" : "dfsph");
        const double start = 0.05 + 0.0007 * i, way = i % 2 ? 1 : -1;
        add_motion(&def, i % 4 < 2 ? jolt(start, way) : wrench(start, way));
        def.dt = frames[i / 4];
        def.substeps = i / 4 ? 4 * (i / 4) * (i / 4) : 1;
        World *world = fixture_world(&def);
        double most = 0;
        while (numbers_of(world).energy.time < 0.4) {
            fixture_step(world, 1);
            const EnergyMark mark = numbers_of(world).energy;
            assert_true(mark.until > 0);
            most = fmax(most, (mark.sums.own - mark.work) / mark.sums.mass);
        }
        printf("frames of %g s: gain %.4f J/kg\n", def.dt, most);
        assert_true(most < 0.07);
        assert_int_equal(trouble_of(world).count, 0);
        world_destroy(world);
    }
}

typedef enum Open { PERIODIC, AROUND, DRAIN, EMIT, PADDLE, FLOAT, LID, TENSION, OPEN_COUNT } Open;

/* A world in which something else than gravity does work, or matter comes and goes. */
static WorldDef open_world(WorldDef def, Open what)
{
    SolidDef *solid = &def.solids[def.solid_count];
    def.periodic[0] = what == PERIODIC || what == AROUND;
    if (what == PERIODIC)
        def.gravity[0] = 3;
    if (what == AROUND)
        add_motion(&def, SHAKEN);
    if (what == DRAIN)
        add_drain(&def,
                  (Fill){.kind = FILL_BLOCK, .min = {0.4 * def.box_size[0], 0, -1}, .max = {0.5, 0.1, 1}});
    if (what == EMIT) {
        add_emit(&def.fluids[0], (Emit){.centre = {0, 0.95 * def.box_size[1], 0},
                                        .direction = {0, -1, 0},
                                        .radius = 0.06,
                                        .speed = 1});
        def.most = 1000;
    }
    if (what == PADDLE || what == FLOAT) {
        def.solid_count++;
        *solid = (SolidDef){.kind = SOLID_SPHERE, .centre = {0.12, 0.12, 0}, .radius = 0.06};
        solid->density = what == FLOAT ? 500 : 0;
        if (what == PADDLE)
            add_solid_motion(
                solid,
                (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.5, 0}, .amplitude = 0.05, .frequency = 3});
    }
    if (what == LID) {
        def.wall_slip = SLIP_NONE;
        def.fluids[0].viscosity = fmax(def.fluids[0].viscosity, 1);
        def.lid[0] = 1;
    }
    if (what == TENSION) {
        def.tension_model = TENSION_COHESION;
        def.fluids[0].surface_tension = 0.07;
    }
    return def;
}

/* Each of them is watched, but pbf with a solid that is moved, and no work is left out: a dam does not gain.
 */
static void open_worlds_are_watched(void **state)
{
    static const char *const names[] = {"mueller", "wcsph", "dfsph", "pbf"};
    (void)state;
    fixture_needs_cpu("a GPU sums no work of solids and emitters");
    for (int i = 0; i < OPEN_COUNT; i++)
        for (int m = 0; m < 4; m++) {
            const WorldDef def = open_world(dam(names[m]), (Open)i);
            World *world = fixture_world(&def);
            double most = 0, stirred = 0, work = 0;
            for (int step = 0; step < 500; step++) {
                fixture_step(world, 1);
                const EnergyMark mark = numbers_of(world).energy;
                assert_true((mark.until > 0) == !(i == PADDLE && m == 3));
                most = fmax(most, mark.sums.own - mark.work);
                stirred += fabs(mark.work - work);
                work = mark.work;
            }
            printf("%d %s: gain %.3f, in the end %.3f of %.0f J stirred\n", i, names[m], most / stirred,
                   (numbers_of(world).energy.sums.own - work) / stirred, stirred);
            assert_int_equal(trouble_of(world).count, 0);
            assert_true(most <= 0.05 * stirred);
            world_destroy(world);
        }
}

/* A drop compressed by cohesion by some 6 % boils, but gains no energy beyond the watch's limit. */
static void a_drop_that_is_pressed_is_not_accused(void **state)
{
    (void)state;
    fixture_needs_cpu("a bound of cohesion");
    WorldDef def = fixture_def(0.008, 0.006, 0.008);
    add_fill(&def.fluids[0], (Fill){.kind = FILL_BALL, .centre = {0, 0.003, 0}, .radius = 0.001});
    memset(def.gravity, 0, sizeof def.gravity);
    def.spacing = 0.0002;
    def.sound_speed = 5;
    def.retries = 3;
    def.dt = 1e-5;
    def.tension_model = TENSION_COHESION;
    def.fluids[0].surface_tension = 0.072;
    def.fluids[0].viscosity = 0.001;
    World *world = fixture_world(&def);
    fixture_step(world, 60);
    assert_int_equal(trouble_of(world).count, 0);
    world_destroy(world);
}

/* A heavy ball drops into a pond at rest: the fluid's gain is the ball's loss. */
static void a_ball_that_falls_brings_its_energy(void **state)
{
    (void)state;
    fixture_needs_cpu("a GPU sums no work of solids and emitters");
    WorldDef def = dam("mueller");
    def.fluids[0].fill_count = 0;
    fixture_block(&def, 0, -0.5, 0, -1, 0.5, 0.2, 1);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.45, 0}, .radius = 0.09, .density = 5000};
    World *world = fixture_world(&def);
    double most = 0;
    for (int step = 0; step < 270; step++) { /* before it comes to the floor */
        fixture_step(world, 1);
        const EnergyMark mark = numbers_of(world).energy;
        most = fmax(most, mark.sums.own - mark.work);
    }
    printf("gain %g of %g J\n", most, numbers_of(world).energy.sums.own);
    assert_int_equal(trouble_of(world).count, 0);
    assert_true(most < 10); /* of some 380 J that the fall frees */
    world_destroy(world);
}

/* And what boils there is found. */
static void boiling_is_found_in_open_worlds(void **state)
{
    (void)state;
    fixture_needs_cpu("a GPU sums no work of solids and emitters");
    for (int i = 0; i < OPEN_COUNT; i++)
        for (int boils = 0; boils < 2; boils++) {
            const WorldDef def = open_world(viscous_tank(boils ? 1.15 : 0.6), (Open)i);
            World *world = fixture_world(&def);
            fixture_step(world, 1000);
            printf("%d: t = %g s\n", i, trouble_of(world).time);
            assert_int_equal(trouble_of(world).count, boils);
            world_destroy(world);
        }
}

/* What is not watched has a reason, and all else has none. */
static void what_is_not_watched_is_said(void **state)
{
    (void)state;
    if (fixture_on_fragment()) /* without any */
        skip();
    static const char *const names[] = {"mueller", "pbf"};
    for (int i = 0; i < OPEN_COUNT; i++)
        for (int m = 0; m < (fixture_on_cpu() ? 2 : 1); m++) {
            const WorldDef def = open_world(dam(names[m]), (Open)i);
            World *world = fixture_world(&def);
            const bool on_gpu = !fixture_on_cpu() && (i == PADDLE || i == EMIT);
            fixture_step(world, 3);
            assert_true((energy_unwatched(&def) != NULL) == (on_gpu || (m == 1 && i == PADDLE)));
            assert_true((numbers_of(world).energy.until > 0) == !energy_unwatched(&def));
            world_destroy(world);
        }
}

static void a_finger_is_not_watched(void **state)
{
    (void)state;
    WorldDef def = dam("mueller");
    World *world = fixture_world(&def);
    world_set_finger(world, &(Finger){.way = FINGER_PULL, .at = {0, 0.2, 0}, .radius = 0.1, .strength = 10});
    fixture_step(world, 5);
    assert_true(numbers_of(world).energy.until == 0);
    world_destroy(world);
    def.retries = 0;
    world = fixture_world(&def);
    fixture_step(world, 5);
    assert_true(numbers_of(world).energy.until == 0);
    world_destroy(world);
}

/* A state saved before trouble contains all data for detection; an older file's state continues without. */
static void save_load_step_is_step(void **state)
{
    (void)state;
    fixture_needs_cpu("a GPU sums no work of solids and emitters");
    const WorldDef def = viscous_tank(1.15);
    World *straight = fixture_world(&def), *loaded = fixture_world(&def);
    WorldState saved = {.count = 0};
    while (trouble_of(straight).count == 0) {
        if (!world_save(straight, &saved, &error)) /* the last is that before the trouble */
            fail_msg("%s", error.message);
        fixture_step(straight, 1);
    }
    fixture_step(loaded, 3);
    assert_true(world_load(loaded, &saved, &error));
    fixture_step(loaded, 1);
    assert_int_equal(trouble_of(loaded).count, 1);
    for (int i = 0; i < 3; i++) {
        const WorldNumbers one = numbers_of(straight), other = numbers_of(loaded);
        assert_memory_equal(&one, &other, sizeof one);
        assert_true(one.energy.until > 0 && world_hash(straight) == world_hash(loaded));
        fixture_step(straight, 100);
        fixture_step(loaded, 100);
    }
    saved.numbers.energy = (EnergyMark){0};
    assert_true(world_load(loaded, &saved, &error));
    const unsigned before = trouble_of(loaded).count;
    fixture_step(loaded, 1);
    assert_int_equal(trouble_of(loaded).count, before); /* without a reference */
    world_state_free(&saved);
    world_destroy(straight);
    world_destroy(loaded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boiling_is_found_and_mended),
        cmocka_unit_test(it_gives_up_and_names_friction),
        cmocka_unit_test(who_falls_or_rests_is_not_accused),
        cmocka_unit_test(work_is_no_trouble),
        cmocka_unit_test(work_of_a_moving_box_is_counted),
        cmocka_unit_test(boiling_is_found_in_a_box_that_moves),
        cmocka_unit_test(jolts_are_counted),
        cmocka_unit_test(open_worlds_are_watched),
        cmocka_unit_test(a_drop_that_is_pressed_is_not_accused),
        cmocka_unit_test(a_ball_that_falls_brings_its_energy),
        cmocka_unit_test(boiling_is_found_in_open_worlds),
        cmocka_unit_test(what_is_not_watched_is_said),
        cmocka_unit_test(a_finger_is_not_watched),
        cmocka_unit_test(save_load_step_is_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
