/* The adaptive step's limits against numbers by hand; and the sentinel: back, half the step, on, or an end
   with the last good state. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/state.h"
#include "sim/step/constants.h"

static Error error;

static void each_limit_binds(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1); /* h = 0.21 m */
    const StepFriction friction = {.laminar = 16 / (0.21 * 0.21)};
    StepLimit limit;
    def.support = 2.1;
    def.sound_speed = 20;
    def.cfl_number = 0.3;
    def.max_dt = 1;
    assert_true(fabs(step_cfl(&def, &friction, 1, 1, 1, &limit) - 0.3 * 0.21 / 21) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_COURANT);
    assert_true(fabs(step_cfl(&def, &friction, 1, 1e6, 1, &limit) - 0.3 * sqrt(0.21e-6)) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_FORCE);
    def.fluids[0].viscosity = 4000; /* nu = 4 m2/s */
    assert_true(fabs(step_cfl(&def, &friction, 1, 1, 1, &limit) - 0.6 * step_viscous(&def, &friction)) <
                1e-12);
    assert_true(fabs(step_viscous(&def, &friction) - 2 * 0.21 * 0.21 / 64) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_VISCOUS);
    def.max_dt = 1e-4;
    assert_true(step_cfl(&def, &friction, 1, 1, 1, &limit) == 1e-4);
    assert_int_equal(limit, STEP_LIMIT_MAX_DT);
    assert_true(fabs(step_cfl(&def, &friction, 1, 1, 1e-6, &limit) - 1.1e-6) < 1e-15);
    assert_int_equal(limit, STEP_LIMIT_GROWTH);
    def.max_dt = 1;
    def.fluids[0].viscosity = 0;
    assert_true(fabs(step_cfl(&def, &friction, 0, 0, 0, &limit) - 0.1 * 0.3 * 0.21 / 20) <
                1e-12); /* the first */
    assert_int_equal(limit, STEP_LIMIT_GROWTH);
    strcpy(def.method, "dfsph");
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.5, 0.5);
    assert_true(fabs(step_cfl(&def, &friction, 0, 0, 1, &limit) - 0.25 * 0.21 / sqrt(9.81 * 0.5)) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_PRESSURE);
    assert_true(fabs(step_cfl(&def, &friction, 0, 1e6, 1, &limit) - sqrt(0.3 * 0.21e-6)) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_FORCE);
    strcpy(def.method, "pbf");
    assert_true(fabs(step_cfl(&def, &friction, 0, 0, 1, &limit) - sqrt(0.4 * 0.1 / 9.81)) < 1e-12);
    assert_int_equal(limit, STEP_LIMIT_PRESSURE);
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        assert_non_null(step_limit_name((StepLimit)i));
}

/* A wave of two spacings: omega^2 = sigma k^3 / rho, k = pi / spacing; an explicit step stands 2 / omega. */
static void tension_bounds_a_step(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    const StepFriction none = {0};
    StepLimit limit;
    const double wave = 2 / sqrt(0.072 * pow(M_PI / def.spacing, 3) / 1000);
    def.max_dt = 1000;
    def.sound_speed = 1e-9;
    def.fluids[0].surface_tension = 0.072;
    assert_true(isinf(step_tension(&def)));
    for (int model = TENSION_COLOUR_FIELD; model <= TENSION_CURVATURE; model++) {
        def.tension_model = model;
        assert_true(step_tension(&def) > 0.5 * wave && step_tension(&def) < 0.6 * wave);
        assert_true(step_cfl(&def, &none, 0, 0, 1000, &limit) == step_tension(&def));
        assert_int_equal(limit, STEP_LIMIT_TENSION);
    }
    def.fluid_count = 2;
    def.fluids[1] = def.fluids[0];
    def.fluids[1].density = 250;
    assert_float_equal(step_tension(&def), 0.5 * 0.56 * wave, 0.005 * wave);
}

/* Of a pair of fluids the harmonic mean of viscosities over the lighter density; what has none in wcsph,
 * alpha c h / 4. */
static void friction_of_several_fluids(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    StepFriction friction = {.laminar = 100, .artificial = 50};
    def.support = 2.1;
    assert_true(isinf(step_viscous(&def, &friction)));
    def.fluid_count = 2;
    def.fluids[0] = (FluidDef){.density = 10, .viscosity = 2};
    def.fluids[1] = (FluidDef){.density = 1000, .viscosity = 30};
    assert_true(fabs(step_viscous(&def, &friction) - 2 / (100 * 0.375)) < 1e-12);
    def.fluids[0].viscosity = 0;
    assert_true(fabs(step_viscous(&def, &friction) - 2 / (100 * 0.03)) < 1e-12);
    friction.alpha = 1;
    def.sound_speed = 100; /* alpha c h / 4 = 5.25 m2/s */
    assert_true(fabs(step_viscous(&def, &friction) - 2 / (50 * 5.25)) < 1e-12);
    def.fluids[0].viscosity_table =
        (TimeTable){.rows = 1, .value = {2.1}}; /* alpha stands for 10.5 Pa s here */
    assert_true(fabs(step_viscous(&def, &friction) - 2 / ((1 - 30.0 / 1050) * 50 * 5.25)) < 1e-12);
    def.fluid_count = 1;
    assert_true(fabs(step_viscous(&def, &friction) - 2 / (0.8 * 50 * 5.25)) < 1e-12);
    def.fluids[0].viscosity_table.value[0] = 11;
    assert_true(isinf(step_viscous(&def, &friction))); /* none of alpha is left */
    def.fluid_count = 2;
    friction = (StepFriction){.laminar = 100, .numerical = 1.05};
    def.fluids[1].viscosity = 0;
    assert_true(fabs(step_viscous(&def, &friction) - 2 / (100 * 2 * 10.5 * 1050 / 1060.5 / 10)) < 1e-12);
}

static WorldInfo info_of(const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    return info;
}

/* A tank of heavy fluid below a light fluid, 1 : 1000, with the step of a single fluid: by the sum of p
   V^2 of both the speed reached 180 m/s. */
static void light_fluid_rests_upon_heavy(void **state)
{
    (void)state;
    fixture_needs_cpu("the limit is the same on all backends");
    WorldDef def = fixture_def(0.5, 1, 1);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 3;
    def.step_mode = STEP_CFL;
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "light", .density = 1};
    snprintf(def.method, sizeof def.method, "wcsph");
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    fixture_block(&def, 0, -0.25, 0, -0.5, 0.25, 0.3, 0.5);
    fixture_block(&def, 1, -0.25, 0.3, -0.5, 0.25, 0.6, 0.5);
    assert_true(step_sound(&def) == def.sound_speed);
    World *world = fixture_world(&def);
    double fastest = 0;
    while (info_of(world).time < 0.2) {
        WorldSums sums;
        fixture_step(world, 1);
        world_sums(world, &sums);
        fastest = fmax(fastest, sums.max_speed);
    }
    printf("fastest: %.2f m/s\n", fastest);
    assert_true(fastest < 0.7);
    world_destroy(world);
}

typedef struct Stirred {
    const char *method, *kernel;
    int dimensions;
    double support;
    int form;
    bool two, walls, solid; /* a light fluid above; walls, a block that hold */
    double alpha;           /* in place of a viscosity */
} Stirred;

/* A tank half full, out of order, with velocities of chance up to 0.4 m/s. */
static WorldDef stirred_def(const Stirred *s, const InitialState *initial)
{
    const bool flat = s->dimensions == 2;
    WorldDef def = fixture_def(1.6, 1, 0.8);
    def.dimensions = s->dimensions;
    def.box_size[0] = flat ? 1.6 : 0.8;
    def.gravity[1] = -0.5;
    def.support = s->support;
    def.sound_speed = 2;
    snprintf(def.method, sizeof def.method, "%s", s->method);
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "%s", s->kernel);
    wcsph_def(&def)->viscosity_form = s->form;
    wcsph_def(&def)->artificial_viscosity = s->alpha;
    def.wall_slip = s->walls ? SLIP_NONE : SLIP_FREE;
    if (s->two) {
        def.fluids[1] = def.fluids[0];
        def.fluids[1].density = 200;
        def.fluid_count = 2;
    }
    if (s->solid)
        def.solids[def.solid_count++] =
            (SolidDef){.kind = SOLID_BOX, .centre = {0, 0.2, 0}, .size = {0.3, 0.3, 0.3}, .slip = SLIP_NONE};
    def.initial = initial;
    def.dt = 0.1 * def.support * def.spacing / def.sound_speed;
    return def;
}

static double chance(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) * 0x1p-23 - 1;
}

static bool in_block(const Stirred *s, double x, double y, double z)
{
    return s->solid && fabs(x) < 0.2 && fabs(y - 0.2) < 0.2 && fabs(z) < 0.2;
}

enum { STIRRED_MOST = 512 };

static size_t stirred_start(const Stirred *s, float *position, float *velocity, uint8_t *fluid)
{
    const int nx = s->dimensions == 2 ? 16 : 8, nz = s->dimensions == 2 ? 1 : 8;
    uint32_t seed = 1;
    size_t count = 0;
    for (int n = 0; n < nx * 6 * nz; n++) {
        const double y = (n / nx % 6 + 0.5) * 0.1, x = (n % nx + 0.5 - nx / 2) * 0.1,
                     z = nz == 1 ? 0 : (n / (6 * nx) + 0.5 - nz / 2) * 0.1;
        if (in_block(s, x, y, z))
            continue;
        const double at[3] = {x, y, z};
        for (int k = 0; k < 3; k++) {
            const bool still = k >= s->dimensions;
            position[3 * count + (size_t)k] = (float)(at[k] + (still ? 0 : 0.03 * chance(&seed)));
            velocity[3 * count + (size_t)k] = still ? 0 : (float)(0.4 * chance(&seed));
        }
        fluid[count++] = s->two && y > 0.3;
    }
    return count;
}

/* Kinetic energy after steps with `share` of the longest stable step of friction, over the energy before.
 */
static double energy_left(const Stirred *s, double share)
{
    static float position[3 * STIRRED_MOST], velocity[3 * STIRRED_MOST];
    static uint8_t fluid[STIRRED_MOST];
    const InitialState initial = {.count = stirred_start(s, position, velocity, fluid),
                                  .position = position,
                                  .velocity = velocity,
                                  .fluid = fluid};
    WorldDef def = stirred_def(s, &initial);
    World *world = fixture_world(&def);
    WorldSums before, after;
    fixture_step(world, s->alpha > 0 ? 0 : 60);
    const StepFriction friction = step_friction(&def);
    for (int f = 0; f < def.fluid_count; f++)
        def.fluids[f].viscosity = s->alpha > 0 ? 0 : 1;
    def.dt *= 0.5;
    if (s->alpha > 0) /* c, and alpha with it, cannot be had small */
        def.dt = share * step_viscous(&def, &friction);
    else
        def.fluids[0].viscosity = def.fluids[1].viscosity = share * step_viscous(&def, &friction) / def.dt;
    world_sums(world, &before);
    bool good = world_change(world, &def, &error);
    for (int i = 0; i < 200 && good; i++)
        good = world_step(world, NULL, &error);
    world_sums(world, &after);
    world_destroy(world);
    return good ? after.kinetic_energy / before.kinetic_energy : INFINITY;
}

/* What is out of order holds at 0.7 of the limit, and boils above it. */
static void friction_stands_the_step_that_it_names(void **state)
{
    static const Stirred cases[] = {
        {"mueller", "cubic", 2, 2.6, 0, false, false, false, 0},
        {"mueller", "cubic", 2, 4, 0, false, false, false, 0},
        {"mueller", "cubic", 3, 2.1, 0, false, false, false, 0},
        {"mueller", "cubic", 3, 3.5, 0, false, false, false, 0},
        {"mueller", "cubic", 2, 2.6, 0, true, false, false, 0},
        {"mueller", "cubic", 2, 2.6, 0, false, true, true, 0},
        {"wcsph", "cubic", 2, 2.6, 0, false, false, false, 0},
        {"wcsph", "wendland_c2", 2, 3.5, 0, false, false, false, 0},
        {"wcsph", "quintic", 2, 3, 0, false, false, false, 0},
        {"wcsph", "wendland_c2", 3, 3, 0, false, false, false, 0},
        {"wcsph", "wendland_c2", 2, 3, 1, false, false, false, 0},
        {"wcsph", "quintic", 2, 2.6, 1, false, false, false, 0},
        {"wcsph", "cubic", 2, 2.6, 0, true, false, false, 0},
        {"wcsph", "wendland_c2", 2, 3, 0, false, true, true, 0},
        {"wcsph", "wendland_c2", 2, 3, 0, false, false, false, 1},
    };
    (void)state;
    fixture_needs_cpu("the limit is the same on all backends");
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        const Stirred *s = &cases[n];
        /* where two meet, half of a light one's neighbours are light; radial friction and walls boil slowly
         * at 2 */
        const double beyond = s->two || s->form || s->walls ? 3 : 1.5;
        const double calm = energy_left(s, STEP_VISCOUS_STANDS), wild = energy_left(s, beyond);
        printf("%s %s %dD %g%s%s%s: %.3g at %g, %.3g at %g of the longest step\n", s->method, s->kernel,
               s->dimensions, s->support, s->form ? " radial" : "", s->two ? " two" : "",
               s->walls ? " held" : "", calm, STEP_VISCOUS_STANDS, wild, beyond);
        assert_true(calm < 0.3);
        assert_true(wild > 10);
    }
}

static WorldDef falling_block(void)
{
    WorldDef def = fixture_def(1, 1, 0.6);
    fixture_block(&def, 0, -0.5, 0, -0.3, 0, 0.7, 0.3);
    def.sound_speed = 20;
    return def;
}

/* A frame, and again as long as trouble is known of it: a GPU is else asked when the next one begins. */
static bool finish_frame(World *world)
{
    bool good = world_step(world, NULL, &error);
    while (good && !world_is_valid(world))
        good = world_step(world, NULL, &error);
    return good;
}

/* Steps as long as each state allows, the same on any number of threads; a frame is one of them. */
static void cfl_follows_the_flow(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int threads = 1; threads <= 2; threads++) {
        WorldDef def = falling_block();
        def.step_mode = STEP_CFL;
        *world_threads(&def) = threads;
        def.retries = 3;
        World *world = fixture_world(&def);
        double time = 0, longest = 0, shortest = 1;
        for (int i = 0; i < fixture_count(400, 80); i++) {
            WorldSums sums;
            WorldInfo info;
            world_sums(world, &sums);
            fixture_step(world, 1);
            world_info(world, &info);
            assert_int_equal(info.step, i + 1);
            assert_false(info.within_frame);
            assert_true(info.dt <= 0.3 * 0.21 / (20 + sums.max_speed) * (1 + 1e-6));
            time += info.dt;
            assert_true(fabs(info.time - time) < 1e-9);
            longest = fmax(longest, info.dt);
            shortest = i > 50 ? fmin(shortest, info.dt) : 1;
        }
        WorldInfo info;
        world_info(world, &info);
        assert_int_equal(info.trouble.count, 0);
        assert_true(info.limited[STEP_LIMIT_COURANT] > (fixture_on_cpu() ? 300 : 40) &&
                    info.limited[STEP_LIMIT_GROWTH] > 10);
        assert_true(longest > 1.03 * shortest);
        hash[threads - 1] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1]);
}

/* A step three times too long is halved until it holds, and the fluid comes to rest all the same. */
static void the_step_is_halved(void **state)
{
    (void)state;
    WorldDef def = falling_block();
    def.retries = 3;
    def.dt = 0.042; /* a substep of 21 ms: 2 h / c */
    def.substeps = 2;
    def.fluids[0].viscosity = 50;
    World *world = fixture_world(&def);
    double before = 0;
    unsigned troubles = 0;
    for (int i = 0; i < fixture_count(100, 30); i++) {
        if (!finish_frame(world))
            fail_msg("%s", error.message);
        const WorldInfo info = info_of(world);
        if (info.trouble.count > troubles) {
            assert_true(fabs(info.trouble.back_to - before) < 1e-9); /* no finished frame is taken back */
            assert_true(info.trouble.time > info.trouble.back_to);
            assert_int_equal(info.trouble.retries, 3);
        }
        troubles = info.trouble.count;
        before = info.time;
        assert_true(fabs(info.time - def.dt * (i + 1)) < 1e-9);
    }
    WorldSums sums;
    world_sums(world, &sums);
    assert_true(troubles > 0);
    assert_true(sums.max_speed < 20 && isfinite(sums.kinetic_energy));
    world_destroy(world);
}

/* Trouble that no step cures ends with the last good state, the box's too. */
static void it_gives_up_with_the_last_good_state(void **state)
{
    (void)state;
    WorldDef def = falling_block();
    def.retries = 2;
    def.dt = 100;
    def.substeps = 2;
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.1, .frequency = 0.013});
    World *world = fixture_world(&def);
    fixture_step(world, 0);
    const uint64_t hash = world_hash(world);
    const WorldInfo before = info_of(world);
    assert_false(finish_frame(world));
    assert_non_null(strstr(error.message, "the simulation blew up at t = "));
    assert_non_null(strstr(error.message, "with 1/4 of the step too; the state at t = 0 s is kept"));
    assert_true(world_hash(world) == hash);
    const WorldInfo after = info_of(world);
    assert_true(after.time == 0);
    assert_memory_equal(&after.box, &before.box, sizeof after.box);
    assert_int_equal(after.trouble.count, 2);
    world_destroy(world);
}

/* The binding limit is named: sound, friction, too fast flow, or unknown. */
static void the_advice_names_what_binds(void **state)
{
    (void)state;
    char words[200];
    WorldDef def = fixture_def(1, 1, 1);
    const StepFriction friction = {.laminar = 16 / (0.21 * 0.21)};
    def.support = 2.1; /* h / c = 10.5 ms */
    step_advice(&def, &friction, STEP_TROUBLE_SPEED, 0.02, 1, words);
    assert_non_null(strstr(words, "1.9 times what sound takes"));
    assert_non_null(strstr(words, "lower solver.sound_speed"));
    def.fluids[0].viscosity = 1000; /* 0.7 of 5.5 ms */
    step_advice(&def, &friction, STEP_TROUBLE_SPEED, 0.005, 1, words);
    assert_non_null(strstr(words, "friction stands 3.86 ms, the step is 5 ms"));
    assert_non_null(strstr(words, "lower viscosity"));
    def.fluids[0].viscosity = 0;
    step_advice(&def, &friction, STEP_TROUBLE_DENSITY, 0.005, 1, words);
    assert_non_null(strstr(words, "use a higher one"));
    step_advice(&def, &friction, STEP_TROUBLE_SPEED, 0.005, 11, words);
    assert_non_null(strstr(words, "flow of 11 m/s is much for a solver.sound_speed of 20 m/s"));
    def.step_mode = STEP_CFL;
    step_advice(&def, &friction, STEP_TROUBLE_SPEED, 0.005, 1, words);
    assert_string_equal(words, "use a smaller solver.step.number");
}

/* The longest step of mode cfl with fluid at rest in a box that accelerates upwards. */
static double step_in_a_lift(double acceleration)
{
    WorldDef def = falling_block();
    snprintf(def.method, sizeof def.method, "dfsph");
    def.step_mode = STEP_CFL;
    def.max_dt = 1;
    add_motion(&def, (Motion){.kind = MOTION_ACCELERATE, .axis = {0, 1, 0}, .acceleration = acceleration});
    World *world = fixture_world(&def);
    fixture_step(world, 2);
    const WorldInfo info = info_of(world);
    world_destroy(world);
    return info.dt;
}

/* With four times the weight pressure stands half of the step. */
static void the_pressure_s_limit_knows_the_box(void **state)
{
    (void)state;
    fixture_needs_cpu("the step of one backend is that of all");
    const double rest = step_in_a_lift(0);
    assert_float_equal(step_in_a_lift(3 * 9.81), 0.5 * rest, 1e-4 * rest);
    assert_float_equal(step_in_a_lift(-0.5 * 9.81), rest, 1e-9); /* lighter fluid is given no longer steps */
    assert_float_equal(step_in_a_lift(99 * 9.81), 0.25 * rest, 1e-4 * rest);
}

static void without_a_sentinel_it_stops_at_once(void **state)
{
    (void)state;
    WorldDef def = falling_block();
    def.dt = 1;
    World *world = fixture_world(&def);
    assert_false(finish_frame(world));
    assert_non_null(strstr(error.message, "the simulation blew up at t = 1 s: "));
    assert_null(strstr(error.message, "kept"));
    world_destroy(world);
}

/* After many calm steps the step is as long as before. */
static void calm_brings_the_step_back(void **state)
{
    (void)state;
    WorldDef def = falling_block();
    def.retries = fixture_count(3, 1);
    def.dt = 0.03;
    def.substeps = 10;
    def.fluids[0].viscosity = 100;
    World *world = fixture_world(&def);
    WorldDef wild = def;
    wild.sound_speed = 100;
    assert_true(world_change(world, &wild, &error));
    for (int i = 0; i < 20 && info_of(world).trouble.count == 0; i++)
        fixture_step(world, 1);
    assert_true(info_of(world).trouble.count > 0);
    fixture_step(world, 1);
    assert_true(info_of(world).dt < 0.002);
    assert_true(world_change(world, &def, &error));
    fixture_step(world, fixture_count(300, 30)); /* 20 bring a halving back */
    assert_true(fabs(info_of(world).dt - 0.003) < 1e-12);
    world_destroy(world);
}

/* Reports after the restored state stay; saved within trouble, the run continues the same. */
static void a_session_with_trouble_comes_out_the_same(void **state)
{
    (void)state;
    WorldDef def = falling_block();
    def.retries = 3;
    def.dt = 0.042;
    def.substeps = 2;
    def.fluids[0].viscosity = 50;
    uint64_t hash[3];
    for (int run = 0; run < 3; run++) {
        *world_threads(&def) = 1 + run % 2;
        World *world = fixture_world(&def);
        WorldState saved = {.count = 0};
        for (int i = 0; i < 40; i++) {
            const BoxTarget target = {{0.05 * sin(i), 0, 0}, {0, 0, 0, 1}};
            if (run == 2 && i == 11) {
                assert_true(world_save(world, &saved, &error));
                world_destroy(world);
                world = fixture_world(&def);
                assert_true(world_load(world, &saved, &error));
            }
            assert_true(world_substep(world, NULL, &error));
            world_set_target(world, &target);
            while (info_of(world).within_frame)
                assert_true(world_substep(world, NULL, &error));
        }
        if (run < 2)
            assert_true(info_of(world).trouble.count > 0);
        hash[run] = world_hash(world);
        assert_true(fabs(info_of(world).hand.position[0]) > 1e-6);
        world_state_free(&saved);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
}

/* It is no matter of the step: sentinel or not, but after what is. */
static void what_is_lost_is_trouble_above_the_limit(void **state)
{
    (void)state;
    StepWatch watch = {.bounded = true, .max_density_ratio = 1, .lost = 5, .lost_limit = 5};
    assert_int_equal(step_trouble_of(&watch, true), STEP_TROUBLE_NONE);
    watch.lost = 6;
    assert_int_equal(step_trouble_of(&watch, true), STEP_TROUBLE_LOST);
    assert_int_equal(step_trouble_of(&watch, false), STEP_TROUBLE_LOST);
    watch.max_density_ratio = 6;
    assert_int_equal(step_trouble_of(&watch, true), STEP_TROUBLE_DENSITY);
    watch.bounded = false;
    assert_int_equal(step_trouble_of(&watch, true), STEP_TROUBLE_SPEED);
    watch.memory = true; /* then no other figure is right */
    assert_int_equal(step_trouble_of(&watch, false), STEP_TROUBLE_MEMORY);
}

/* States fall on requested times, by steps of at least 3/4 of the limits, and a run without stops keeps
   the bits. */
static void steps_end_where_they_are_asked_to(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    WorldInfo info;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.5, 0.5);
    def.step_mode = STEP_CFL;
    World *world = fixture_world(&def), *free_of = fixture_world(&def);
    double before = 0, longest = 0;
    for (int k = 1; k <= 10; k++) {
        const double stop = k / 30.0;
        world_stop_at(world, stop);
        do {
            fixture_step(world, 1);
            world_info(world, &info);
            if (before > 0.1) /* grown to the limit */
                assert_true(info.time - before > 0.7 * longest);
            longest = fmax(longest, info.time - before);
            before = info.time;
        } while (info.time < stop - 1e-9);
        assert_float_equal(info.time, stop, 1e-12);
    }
    fixture_step(free_of, 5);
    const uint64_t hash = world_hash(free_of);
    world_destroy(free_of);
    free_of = fixture_world(&def);
    world_stop_at(free_of, -1);
    fixture_step(free_of, 5);
    assert_true(world_hash(free_of) == hash);
    world_destroy(free_of);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_limit_binds),
        cmocka_unit_test(tension_bounds_a_step),
        cmocka_unit_test(friction_of_several_fluids),
        cmocka_unit_test(light_fluid_rests_upon_heavy),
        cmocka_unit_test(friction_stands_the_step_that_it_names),
        cmocka_unit_test(cfl_follows_the_flow),
        cmocka_unit_test(the_step_is_halved),
        cmocka_unit_test(it_gives_up_with_the_last_good_state),
        cmocka_unit_test(the_advice_names_what_binds),
        cmocka_unit_test(the_pressure_s_limit_knows_the_box),
        cmocka_unit_test(without_a_sentinel_it_stops_at_once),
        cmocka_unit_test(calm_brings_the_step_back),
        cmocka_unit_test(a_session_with_trouble_comes_out_the_same),
        cmocka_unit_test(what_is_lost_is_trouble_above_the_limit),
        cmocka_unit_test(steps_end_where_they_are_asked_to),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
