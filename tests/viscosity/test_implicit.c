/* Implicit viscosity, with all methods: against theory, a dense solution in double precision, and
   explicit steps; and without a limit of the step. */
#include "tests/viscosity/ball.h"

#include "sim/cpu/cpu.h"
#include "sim/def/fluids.h"
#include "sim/methods/shared/terms.h"
#include "sim/methods/wcsph/wcsph.h"
#include "sim/step/substep.h"
#include "sim/step/world.h"

enum { METHODS = sizeof fixture_method_names / sizeof *fixture_method_names };

static const char *const *const method_names = fixture_method_names;

/* --- a shear wave --- */

enum { WAVE = 24, COLUMNS = 8 };

/* The rest of v_x = V sin(k y) after a number of steps of `times` the explicit limit. */
static double wave_left(WorldDef *def, double times, int steps, double *of_theory)
{
    static float x[3 * WAVE * COLUMNS], v[3 * WAVE * COLUMNS];
    const double k = 2 * M_PI / (0.1 * WAVE), nu = def->fluids[0].viscosity / 1000;
    WorldDef explicitly = *def;
    const StepFriction friction = step_friction(&explicitly);
    explicitly.viscosity_solver = VISCOSITY_EXPLICIT;
    def->dt = times * step_viscous(&explicitly, &friction);
    for (size_t i = 0; i < (size_t)WAVE * COLUMNS; i++) {
        const size_t row = i / COLUMNS, column = i % COLUMNS;
        x[3 * i] = (float)(0.1 * ((double)column + 0.5) - 0.05 * COLUMNS);
        x[3 * i + 1] = (float)(0.1 * ((double)row + 0.5));
        v[3 * i] = (float)(1e-4 * sin(k * (double)x[3 * i + 1]));
    }
    def->initial = &(InitialState){.count = (size_t)WAVE * COLUMNS, .position = x, .velocity = v};
    World *world = fixture_world(def);
    fixture_step(world, steps);
    State s = fixture_read(world);
    double left = 0;
    for (size_t i = 0; i < s.count; i++)
        left += 2e4 / (double)s.count * (double)s.velocity[4 * i] * sin(k * (double)s.position[4 * i + 1]);
    fixture_free(&s);
    world_destroy(world);
    *of_theory = pow(1 + nu * k * k * def->dt, -steps); /* of the implicit Euler step */
    return left;
}

static void a_shear_wave_decays_as_it_should(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++)
        for (int times = 10; times <= 100; times *= 10) {
            WorldDef def = thick_def(method_names[m], 2, 300);
            double theory;
            def.box_size[0] = 0.1 * COLUMNS;
            def.box_size[1] = 0.1 * WAVE;
            def.periodic[0] = def.periodic[1] = true;
            def.sound_speed = 0.05; /* no sound in such steps */
            const double left = wave_left(&def, times, times == 10 ? 5 : 2, &theory);
            printf("%s, %d times the explicit step: %.4f left, theory %.4f\n", method_names[m], times, left,
                   theory);
            assert_true(fabs(log(left) / log(theory) - 1) < 0.04);
        }
}

/* --- long steps, momentum --- */

static void a_second_at_1e5_pascal_seconds_stands(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++)
        ball_check_long_step(method_names[m], "cpu");
}

static void what_is_thrown_falls(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++)
        ball_check_thrown(method_names[m], "cpu");
}

static void what_turns_keeps_turning(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++)
        ball_check_turn(method_names[m], "cpu");
}

/* The mean speed of a fluid driven by a force along two plates, after half the relaxation time. */
static double driven_speed(const char *method, double tolerance)
{
    enum { ACROSS = 24, WIDE = 8 };
    static float x[3 * ACROSS * WIDE];
    WorldDef def = thick_def(method, 2, 100);
    def.box_size[0] = 0.04 * WIDE;
    def.box_size[1] = 0.04 * ACROSS;
    def.periodic[0] = true;
    def.wall_slip = SLIP_NONE;
    def.spacing = 0.04;
    def.sound_speed = 10;
    def.gravity[0] = 0.8;
    def.viscosity_tolerance = tolerance;
    def.dt = 0.004;
    for (int i = 0; i < ACROSS * WIDE; i++) {
        x[3 * i] = (float)(0.04 * (i % WIDE + 0.5) - 0.5 * def.box_size[0]);
        x[3 * i + 1] = (float)(0.04 * (i / WIDE + 0.5));
    }
    def.initial = &(InitialState){.count = (size_t)ACROSS * WIDE, .position = x};
    World *world = fixture_world(&def);
    WorldSums sums;
    fixture_step(world, 125);
    world_sums(world, &sums);
    world_destroy(world);
    return sums.momentum[0];
}

/* What iterations leave in each of many short steps, beside which gravity adds little, is made up for. */
static void what_is_left_does_not_add_up(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        const double loose = driven_speed(method_names[m], 1e-3), close = driven_speed(method_names[m], 1e-7);
        printf("%s: runs %.3f %% faster by a looser tolerance\n", method_names[m], 100 * (loose / close - 1));
        assert_float_equal(loose / close, 1, 1e-3);
    }
}

/* The random part loses all energy, the rotation none. */
static void momentum_stays(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        static Ball ball;
        WorldDef def = thick_def(method_names[m], 3, 1000);
        ball_make(&ball, 3, 0.02, 0.1);
        def.initial = &ball.initial;
        def.sound_speed = 0.01;
        def.dt = 0.02;
        World *world = fixture_world(&def);
        WorldSums a, b;
        world_sums(world, &a);
        fixture_step(world, 5);
        world_sums(world, &b);
        printf("%s: turns with %.5f, then %.5f kg m2/s; moves with %.2e, then %.2e kg m/s of %.3g\n",
               method_names[m], a.angular_momentum[2], b.angular_momentum[2], a.momentum[0], b.momentum[0],
               b.momentum_scale);
        for (int k = 0; k < 3; k++) {
            assert_float_equal(a.momentum[k], b.momentum[k], 2e-4 * a.momentum_scale);
            assert_float_equal(a.angular_momentum[k], b.angular_momentum[k], 2e-3 * a.angular_scale);
        }
        world_destroy(world);
    }
}

/* --- short steps --- */

/* How the first step changes velocities, m/s2, of 3 components a particle. */
static double *change_of(const WorldDef *def, const Ball *ball, size_t *count)
{
    World *world = fixture_world(def);
    fixture_step(world, 1);
    State s = fixture_read(world);
    double *change = calloc(3 * s.count, sizeof *change);
    for (size_t i = 0; i < s.count; i++)
        for (size_t k = 0; k < 3; k++)
            change[3 * i + k] = ((double)s.velocity[4 * i + k] - (double)ball->v[3 * i + k]) / def->dt;
    *count = s.count;
    fixture_free(&s);
    world_destroy(world);
    return change;
}

static void a_short_step_is_an_explicit_one(void **state)
{
    (void)state;
    static Ball ball;
    WorldDef def = thick_def("wcsph", 3, 20);
    size_t count = 0;
    double differ = 0, all = 0;
    ball_make(&ball, 3, 1, 1);
    def.initial = &ball.initial;
    def.sound_speed = 0.01;
    def.dt = 2e-5; /* a thousandth of the explicit limit */
    wcsph_def(&def)->viscosity_form = VISCOSITY_RADIAL;
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    double *implicit = change_of(&def, &ball, &count);
    def.viscosity_solver = VISCOSITY_EXPLICIT;
    double *explicit = change_of(&def, &ball, &count);
    for (size_t i = 0; i < 3 * count; i++) {
        differ += fabs(implicit[i] - explicit[i]);
        all += fabs(explicit[i]);
    }
    printf("differs by %.2e\n", differ / all);
    assert_true(all > 0 && differ < 0.005 * all);
    free(implicit);
    free(explicit);
}

/* --- a dense solution --- */

enum { MOST = 3 * 140 };

/* Two fluids in a corner that holds them, around a ball. */
static WorldDef corner_def(void)
{
    WorldDef def = thick_def("dfsph", 3, 5000);
    def.gravity[1] = -9.81;
    def.wall_slip = SLIP_NONE;
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 300, .viscosity = 400};
    def.jitter = 0.2;
    def.dt = 0.02;
    def.viscosity_tolerance = 1e-7;
    def.viscosity_iterations = 2000;
    def.solids[def.solid_count++] = (SolidDef){.kind = SOLID_SPHERE,
                                               .centre = {-0.3, 0.2, -0.3},
                                               .radius = 0.15,
                                               .slip = SLIP_NONE,
                                               .axis = {0, 1, 0}};
    fixture_block(&def, 0, -0.6, 0, -0.6, -0.1, 0.3, -0.1);
    fixture_block(&def, 1, -0.6, 0.3, -0.6, -0.1, 0.5, -0.1);
    return def;
}

typedef struct Dense {
    int count;
    size_t of[MOST / 3]; /* where the fluids' particles stand */
    double matrix[MOST][MOST], right[MOST];
} Dense;

static double viscosity_of(const Cpu *cpu, size_t i)
{
    return (double)cpu->now.viscosity[i];
}

/* c_ij of sim/methods/shared/terms.h, and x_ij; 0 where they are too far. */
static double coupling(const World *world, const Lattice *lattice, size_t i, size_t j, double d[3])
{
    const Cpu *cpu = world->state;
    const CpuParticles *p = &cpu->now;
    const double h = (double)world->constants.support_radius;
    const float *const x[3] = {p->x, p->y, p->z};
    double r2 = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = (double)x[k][i] - (double)x[k][j];
        r2 += d[k] * d[k];
    }
    const double r = sqrt(r2);
    return r > 0 && r < h
               ? -lattice->gradient_scale * lattice->pressure_kernel->derivative(r, h) / r *
                     lattice->radial_scale * world->constants.unit_volume * (double)p->volume[i] *
                     (double)p->volume[j] * pair_viscosity(viscosity_of(cpu, i), viscosity_of(cpu, j))
               : 0;
}

static void dense_fill(const World *world, const Lattice *lattice, Dense *dense)
{
    const Cpu *cpu = world->state;
    float *const *t = cpu->now.term;
    memset(dense, 0, sizeof *dense);
    for (size_t i = 0; i < cpu->count; i++)
        if (cpu->now.fluid[i] < FLUIDS_MAX)
            dense->of[dense->count++] = i;
    assert_true(dense->count > 60 && 3 * dense->count <= MOST);
    for (int a = 0; a < dense->count; a++) {
        const size_t i = dense->of[a];
        for (int k = 0; k < 3; k++) {
            dense->matrix[3 * a + k][3 * a + k] += (double)t[INERTIA][i];
            dense->right[3 * a + k] = (double)t[RESIDUAL + k][i];
        }
        for (size_t j = 0; j < cpu->count; j++) {
            double d[3] = {0};
            const double c = i == j ? 0 : coupling(world, lattice, i, j, d);
            const bool solid = cpu->now.fluid[j] >= FLUIDS_MAX;
            int b = 0;
            while (!solid && dense->of[b] != j)
                b++;
            for (int k = 0; k < 3 && c > 0; k++)
                for (int l = 0; l < 3; l++) {
                    dense->matrix[3 * a + k][3 * a + l] += (solid ? 2 : 1) * c * d[k] * d[l];
                    if (!solid)
                        dense->matrix[3 * a + k][3 * b + l] -= c * d[k] * d[l];
                }
        }
    }
}

/* By elimination: `right` becomes the solution. */
static void dense_solve(Dense *dense)
{
    const int n = 3 * dense->count;
    for (int i = 0; i < n; i++)
        for (int r = i + 1; r < n; r++) {
            const double share = dense->matrix[r][i] / dense->matrix[i][i];
            for (int c = i; c < n && share != 0; c++)
                dense->matrix[r][c] -= share * dense->matrix[i][c];
            dense->right[r] -= share * dense->right[i];
        }
    for (int i = n - 1; i >= 0; i--) {
        for (int c = i + 1; c < n; c++)
            dense->right[i] -= dense->matrix[i][c] * dense->right[c];
        dense->right[i] /= dense->matrix[i][i];
    }
}

/* The right side is the residual of no change; iterations begin with the friction of the step before:
   here with a holding friction. */
static void begin_with_nothing(const World *world, const PassInput *input)
{
    Cpu *cpu = world->state;
    float *before[3], *none[3];
    for (int k = 0; k < 3; k++) {
        before[k] = cpu->now.own[BEFORE + k];
        const float *a = k == 0 ? cpu->now.ax : k == 1 ? cpu->now.ay : cpu->now.az;
        cpu->now.own[BEFORE + k] = none[k] = calloc(cpu->capacity + 1, sizeof(float));
        for (size_t i = 0; i < cpu->capacity; i++)
            none[k][i] = -(a[i] + input->gravity[k]);
    }
    world->backend->run(cpu, &viscosity_begin, input);
    for (int k = 0; k < 3; k++) {
        cpu->now.own[BEFORE + k] = before[k];
        free(none[k]);
    }
}

static void as_a_dense_solution(void **state)
{
    (void)state;
    static Dense dense;
    static const ApparentGravity apparent = {.origin = {0, -9.81F, 0}};
    WorldDef def = corner_def();
    World *world = fixture_world(&def);
    Cpu *cpu = world->state;
    Lattice lattice;
    StepSolve solves[SOLVES_MAX] = {{0}};
    const Kernel *kernel = &shape_kernels[KERNEL_WENDLAND_C2];
    const PassInput input = {.dt = 0.02F, .apparent = &apparent, .gravity = {0, -9.81F, 0}};
    Substep step = {.backend = world->backend,
                    .state = world->state,
                    .constants = &world->constants,
                    .solves = solves,
                    .dt = 0.02,
                    .apparent = apparent,
                    .gravity = {0, -9.81F, 0}};
    lattice_calibrate(3, def.spacing, def.support * def.spacing, kernel, kernel, &lattice);
    fixture_step(world, 1);
    world->backend->grid(cpu);
    world->backend->run(cpu, world->method->settle, &(PassInput){0});
    begin_with_nothing(world, &input);
    dense_fill(world, &lattice, &dense);
    dense_solve(&dense);
    substep_terms(&step);
    double differ = 0, all = 0;
    for (int a = 0; a < dense.count; a++)
        for (int k = 0; k < 3; k++) {
            differ =
                fmax(differ, fabs((double)cpu->now.term[CHANGE + k][dense.of[a]] - dense.right[3 * a + k]));
            all = fmax(all, fabs(dense.right[3 * a + k]));
        }
    printf("%d particles: changes by up to %.3g m/s, %.2e of it off, %.0f iterations\n", dense.count, all,
           differ / all, solves[SOLVE_VISCOSITY].iterations);
    assert_true(all > 0 && differ < 1e-4 * all);
    world_destroy(world);
}

/* --- what a step begins with --- */

/* Falling fluid continues: a solver starting from the fall needs hardly more than the minimal iteration. */
static void what_goes_on_needs_one_iteration(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        static Ball ball;
        WorldDef def = thick_def(method_names[m], 3, 2000);
        ball_make(&ball, 3, 0, 0);
        def.initial = &ball.initial;
        def.gravity[1] = -9.81;
        def.sound_speed = 0.01;
        def.dt = 0.002;
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        const double first = world->solves[SOLVE_VISCOSITY].iterations;
        double later = 0;
        fixture_step(world, 1); /* pbf finds its velocities behind a step */
        for (int step = 0; step < 10; step++) {
            fixture_step(world, 1);
            later += world->solves[SOLVE_VISCOSITY].iterations;
        }
        printf("%s: falls with %.0f iterations, then %.0f in ten steps\n", method_names[m], first, later);
        assert_true(first <= 1 && later <= 15);
        world_destroy(world);
    }
}

/* --- needs of a run --- */

static WorldDef drop_def(const char *method)
{
    WorldDef def = thick_def(method, 3, 40);
    def.gravity[1] = -9.81;
    def.wall_slip = SLIP_NONE;
    def.viscosity_tolerance = 1e-3;
    def.spacing = 0.06;
    def.sound_speed = 10;
    def.fluids[0].viscosity_table = (TimeTable){.rows = 2, .time = {0, 0.01}, .value = {40, 20}};
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.7, 0.5);
    return def;
}

static void same_bits_on_threads(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3, 8};
    for (int m = 0; m < METHODS; m++) {
        uint64_t bits[4];
        for (int k = 0; k < 4; k++) {
            WorldDef def = drop_def(method_names[m]);
            *world_threads(&def) = threads[k];
            World *world = fixture_world(&def);
            fixture_step(world, 3);
            bits[k] = world_hash(world);
            world_destroy(world);
        }
        for (int k = 1; k < 4; k++)
            assert_int_equal(bits[k], bits[0]);
    }
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        const WorldDef def = drop_def(method_names[m]);
        World *world = fixture_world(&def), *other = fixture_world(&def);
        WorldState saved = {.count = 0};
        Error error;
        fixture_step(world, 3);
        assert_true(world_save(world, &saved, &error) && world_load(other, &saved, &error));
        fixture_step(world, 2);
        fixture_step(other, 2);
        assert_int_equal(world_hash(world), world_hash(other));
        world_state_free(&saved);
        world_destroy(world);
        world_destroy(other);
    }
}

static void who_does_not_converge_says_so(void **state)
{
    (void)state;
    WorldDef def = drop_def("mueller");
    Error error = {{0}};
    def.fluids[0].viscosity_table = (TimeTable){0};
    def.fluids[0].viscosity = 1e5;
    def.viscosity_tolerance = 0;
    def.viscosity_iterations = 1;
    def.retries = 2;
    World *world = fixture_world(&def);
    while (world_step(world, NULL, &error))
        ;
    printf("%s\n", error.message);
    assert_non_null(strstr(error.message, "the solver of viscosity does not converge"));
    assert_non_null(strstr(error.message, "more solver.viscosity_iterations"));
    world_destroy(world);
}

/* Of a state that is not sound, too. */
static void what_is_not_saved_says_so(void **state)
{
    (void)state;
    WorldDef def = drop_def("dfsph");
    Error error = {{0}};
    WorldState saved = {.count = 0};
    def.retries = 2;
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    world->solves[SOLVE_VISCOSITY].failed = world->kicked = true;
    assert_false(world_save(world, &saved, &error));
    printf("%s\n", error.message);
    assert_non_null(strstr(error.message, "is not sound: the solver of viscosity does not converge: "
                                          "solver.viscosity_iterations"));
    world_state_free(&saved);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shear_wave_decays_as_it_should),
        cmocka_unit_test(a_second_at_1e5_pascal_seconds_stands),
        cmocka_unit_test(what_is_thrown_falls),
        cmocka_unit_test(what_turns_keeps_turning),
        cmocka_unit_test(what_is_left_does_not_add_up),
        cmocka_unit_test(momentum_stays),
        cmocka_unit_test(a_short_step_is_an_explicit_one),
        cmocka_unit_test(as_a_dense_solution),
        cmocka_unit_test(what_goes_on_needs_one_iteration),
        cmocka_unit_test(same_bits_on_threads),
        cmocka_unit_test(save_load_step_is_step),
        cmocka_unit_test(who_does_not_converge_says_so),
        cmocka_unit_test(what_is_not_saved_says_so),
    };
    return cmocka_run_group_tests_name("viscosity.implicit", tests, NULL, NULL);
}
