/* The backend `compute` against `cpu`: wcsph, surface tension, no-slip walls, changes while a world lives. */
#include "tests/gl/compute_fixture.h"

#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct Case {
    const char *label, *method, *kernel;
    int dimensions;
    double support, viscosity[2], delta, artificial;
    TensionModel tension;
    bool negative, no_slip;
    bool runs; /* for 200 steps too */
} Case;

static const Case cases[] = {
    {.label = "wcsph, both viscosities, diffusion, cohesion",
     .method = "wcsph",
     .kernel = "cubic",
     .dimensions = 3,
     .support = 2.1,
     .viscosity = {2, 0},
     .delta = 0.1,
     .artificial = 0.2,
     .tension = TENSION_COHESION,
     .runs = true},
    {.label = "wcsph, Wendland, diffusion, tension of pressure",
     .method = "wcsph",
     .kernel = "wendland_c2",
     .dimensions = 2,
     .support = 3,
     .delta = 0.1,
     .artificial = 0.1,
     .negative = true},
    {.label = "wcsph, quintic, laminar, no slip",
     .method = "wcsph",
     .kernel = "quintic",
     .dimensions = 2,
     .support = 3,
     .viscosity = {1, 3},
     .no_slip = true},
    {.label = "mueller, colour field, no slip",
     .method = "mueller",
     .dimensions = 3,
     .support = 2.1,
     .viscosity = {1, 0},
     .tension = TENSION_COLOUR_FIELD,
     .no_slip = true},
    {.label = "mueller, colour field, no slip",
     .method = "mueller",
     .dimensions = 2,
     .support = 2.1,
     .viscosity = {1, 3},
     .tension = TENSION_COLOUR_FIELD,
     .no_slip = true,
     .runs = true},
    {.label = "mueller, cohesion",
     .method = "mueller",
     .dimensions = 2,
     .support = 2.1,
     .viscosity = {1, 3},
     .tension = TENSION_COHESION},
};
enum { CASES = sizeof cases / sizeof *cases, SQUARE_WCSPH = 1, SQUARE_NO_SLIP = 2 };

static WorldDef def_of(const Case *c)
{
    WorldDef def = stirred_def(c->dimensions);
    snprintf(def.method, sizeof def.method, "%s", c->method);
    if (c->kernel)
        snprintf(def.kernel, sizeof def.kernel, "%s", c->kernel);
    def.dt = 0.0005;
    def.spacing = c->dimensions == 2 ? 0.025 : 0.075;
    def.support = c->support;
    def.delta_sph = c->delta;
    def.artificial_viscosity = c->artificial;
    def.tension_model = (int)c->tension;
    def.negative_pressure = c->negative;
    def.wall_slip = c->no_slip ? SLIP_NONE : SLIP_FREE;
    for (int f = 0; f < 2; f++) {
        def.fluids[f].viscosity = c->viscosity[f];
        def.fluids[f].surface_tension = c->tension ? (c->dimensions == 2 ? 2 : 20) : 0;
    }
    return def;
}

/* The magnitudes of what particle j does to i by pressure, viscosity and tension, N. */
static double pair_terms(const Solver *s, const State *state, size_t i, size_t j, double r)
{
    const double h = (double)s->support_radius,
                 gradient = -s->lattice.gradient_scale * s->lattice.pressure_kernel->derivative(r, h);
    const uint32_t fi = state->fluid[i], fj = state->fluid[j];
    const double vi = (double)state->position[4 * i + 3], vj = (double)state->position[4 * j + 3];
    const double mu = (double)(s->viscosity[fi] + s->viscosity[fj]);
    const double alpha =
        s->continuity ? (double)(s->artificial_viscosity[fi] + s->artificial_viscosity[fj]) : 0;
    double u = 0;
    for (size_t k = 0; k < 3; k++)
        u = hypot(u, (double)(state->velocity[4 * i + k] - state->velocity[4 * j + k]));
    double sum =
        gradient * (fabs((double)state->pressure[i]) * vi * vi + fabs((double)state->pressure[j]) * vj * vj);
    sum += vi * vj * u *
           (s->continuity ? (mu + alpha) * gradient / r
                          : 0.5 * mu * s->lattice.laplacian_scale * kernel_viscosity_laplacian(r, h));
    if (fi != fj || !s->tension_model)
        return sum;
    const double t = h * h - r * r, dims = s->dimensions;
    return sum + (double)s->tension[fi] * vi * vj *
                     (s->tension_model == TENSION_COHESION
                          ? fabs(cohesion_kernel(r, h))
                          : (double)s->colour * t * fabs(dims * h * h - (dims + 4) * r * r));
}

/* The sum of these and of its weight over its mass, m/s2. */
static double scale_of(const Solver *s, const State *state, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j < state->count; j++) {
        double r2 = 0;
        for (size_t k = 0; k < 3; k++) {
            const double d = (double)(state->position[4 * i + k] - state->position[4 * j + k]);
            r2 += d * d;
        }
        if (j != i && r2 < (double)(s->support_radius * s->support_radius))
            sum += pair_terms(s, state, i, j, sqrt(r2));
    }
    return sum / (double)s->mass[state->fluid[i]] + 9.81;
}

/* The greatest of what is off, and whose it is. */
typedef struct Worst {
    double off;
    size_t particle;
} Worst;

static void worst_of(Worst *worst, double off, size_t particle)
{
    if (!(off <= worst->off)) /* NaN is worse */
        *worst = (Worst){off, particle};
}

static void require(const char *what, const Worst *worst, double most, const State *state)
{
    const float *x = state->position + 4 * worst->particle;
    if (!(worst->off < most))
        fail_msg("%s of particle %zu at (%g, %g, %g) off by %g", what, worst->particle, (double)x[0],
                 (double)x[1], (double)x[2], worst->off);
}

/* rho / rho0 - 1 by id; the caller frees it. */
static float *compressions(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    float *values = malloc(info.count * sizeof *values);
    uint32_t *id = malloc(info.count * sizeof *id);
    ParticleArrays out = {.id = id};
    out.scalar[SCALAR_COMPRESSION] = values;
    world_read(world, &out);
    fixture_order(values, id, info.count, 1);
    free(id);
    return values;
}

/* wcsph: what a step adds to the densities, within 1e-3 of the greatest addition. */
static Worst compare_rates(World *cpu, World *gpu, const float *before)
{
    float *a = compressions(cpu), *b = compressions(gpu);
    double greatest = 0;
    Worst worst = {0};
    for (size_t i = 0; i < cpu->count; i++) {
        greatest = fmax(greatest, fabs((double)(a[i] - before[i])));
        worst_of(&worst, fabs((double)(a[i] - b[i])), i);
    }
    worst.off /= greatest;
    free(a);
    free(b);
    return worst;
}

/* One step of both: density within 1e-5 of rest, acceleration within 1e-4 of the sum of the magnitudes of the
   pair terms. */
static void compare_step(const char *label, World *cpu, World *gpu)
{
    float *before = compressions(cpu);
    fixture_step(cpu, 1);
    fixture_step(gpu, 1);
    State a = fixture_read(cpu), b = fixture_read(gpu);
    Worst density = {0}, change = {0}, rate = {0};
    for (size_t i = 0; i < a.count; i++) {
        worst_of(&density, (double)(fabsf(a.density[i] - b.density[i]) / cpu->solver.density[a.fluid[i]]), i);
        double velocity = 0;
        for (size_t k = 4 * i; k < 4 * i + 3; k++)
            velocity = hypot(velocity, (double)(a.velocity[k] - b.velocity[k]));
        worst_of(&change, velocity / (cpu->def.dt * scale_of(&cpu->solver, &a, i)), i);
        assert_true(b.velocity[4 * i + 3] == 0);
    }
    if (cpu->solver.continuity)
        rate = compare_rates(cpu, gpu, before);
    printf("%dD, %s: density off by %.1e of rest, its rate by %.1e, acceleration by %.1e of its terms\n",
           cpu->def.dimensions, label, density.off, rate.off, change.off);
    require("density", &density, 1e-5, &a);
    require("rate of density", &rate, 1e-3, &a);
    require("acceleration", &change, 1e-4, &a);
    free(before);
    fixture_free(&a);
    fixture_free(&b);
}

/* Centre of mass (m), energy, and where 99 of 100 particles are left of (m). */
typedef struct Outcome {
    double centre[3], energy, front;
} Outcome;

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static Outcome outcome_of(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    State s = fixture_read(world);
    Outcome out = {.energy = sums.kinetic_energy + sums.mass * 9.81 * sums.centre[1]};
    memcpy(out.centre, sums.centre, sizeof out.centre);
    for (size_t i = 0; i < s.count; i++)
        s.density[i] = s.position[4 * i];
    qsort(s.density, s.count, sizeof *s.density, ascending);
    out.front = (double)s.density[s.count * 99 / 100];
    fixture_free(&s);
    return out;
}

/* Differences as parts of the box's width and of the energy at first. */
static void compare_outcomes(const char *label, const Outcome *a, const Outcome *b, const Outcome *first,
                             double width, double off[3])
{
    off[0] = 0;
    for (int k = 0; k < 3; k++)
        off[0] = fmax(off[0], fabs(a->centre[k] - b->centre[k]) / width);
    off[1] = fabs(a->energy - b->energy) / first->energy;
    off[2] = fabs(a->front - b->front) / width;
    printf("%s: centre off by %.1e, energy by %.1e, front by %.1e\n", label, off[0], off[1], off[2]);
}

/* Every x by one unit in the last place. */
static void perturb(World *world)
{
    WorldState saved = {0};
    Error error;
    assert_true(world_save(world, &saved, &error));
    for (size_t i = 0; i < saved.count; i++)
        saved.particles.x[i] = nextafterf(saved.particles.x[i], 0);
    if (!world_load(world, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

/* 200 steps on, with what the CPU makes of the least perturbation beside it. */
static void compare_run(const Case *c, World *cpu, World *gpu)
{
    World *other = world_on(def_of(c), "cpu");
    copy_state(cpu, gpu);
    copy_state(cpu, other);
    perturb(other);
    const Outcome before = outcome_of(cpu);
    fixture_step(cpu, 200);
    fixture_step(gpu, 200);
    fixture_step(other, 200);
    const Outcome a = outcome_of(cpu), b = outcome_of(gpu), floor = outcome_of(other);
    double off[3];
    compare_outcomes("  the cpu after a perturbation by one ulp", &a, &floor, &before, cpu->def.box_size[0],
                     off);
    compare_outcomes("  after 200 steps", &a, &b, &before, cpu->def.box_size[0], off);
    assert_true(off[0] < 0.01 && off[1] < 0.01 && off[2] < 0.01);
    world_destroy(other);
}

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        const WorldDef def = def_of(&cases[k]);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, 200);
        copy_state(cpu, gpu);
        compare_step(cases[k].label, cpu, gpu);
        if (cases[k].runs)
            compare_run(&cases[k], cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* Densities that are carried go along; two runs have the same bits. */
static void save_load_step_is_step(void **state)
{
    (void)state;
    const WorldDef def = def_of(&cases[SQUARE_WCSPH]);
    World *world = world_on(def, "compute"), *other = world_on(def, "compute");
    fixture_step(world, 40);
    copy_state(world, other);
    fixture_step(world, 40);
    fixture_step(other, 40);
    State a = fixture_read(world), b = fixture_read(other);
    assert_memory_equal(a.density, b.density, a.count * sizeof *a.density);
    assert_true(world_hash(world) == world_hash(other));
    fixture_free(&a);
    fixture_free(&b);
    world_destroy(world);
    world_destroy(other);
}

static void initial_densities_are_taken(void **state)
{
    (void)state;
    const float position[6] = {-0.3F, 0.5F, 0, 0.3F, 0.5F, 0}, density[2] = {1003, 700};
    const uint8_t fluid[2] = {0, 1};
    const InitialState initial = {.count = 2, .position = position, .fluid = fluid, .density = density};
    WorldDef def = def_of(&cases[SQUARE_WCSPH]);
    def.initial = &initial;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    State a = fixture_read(cpu), b = fixture_read(gpu);
    for (size_t i = 0; i < 2; i++) {
        assert_true(fabsf(b.density[i] - density[i]) < 1e-3F);
        assert_true(a.density[i] == b.density[i] &&
                    fabsf(a.pressure[i] - b.pressure[i]) <= 1e-6F * a.pressure[0]);
    }
    fixture_free(&a);
    fixture_free(&b);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* A block in flight, by a third of a support radius since the grid of its last step. */
static void neighbours_are_those_of_the_last_grid(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = fixture_def(3, 3, 3);
        World *world[2];
        WorldSums sums[2];
        def.dimensions = dimensions;
        def.threads = 1;
        def.dt = 0.14;
        def.gravity[1] = 0;
        def.gravity[0] = 7; /* drifts 0.07 m after the kick */
        fixture_block(&def, 0, -0.6, 1, -0.6, 0.3, 2, 0.3);
        for (int k = 0; k < 2; k++) {
            world[k] = world_on(def, k == 0 ? "cpu" : "compute");
            fixture_step(world[k], 1);
            world_sums(world[k], &sums[k]);
            world_destroy(world[k]);
        }
        printf("%dD: %.6f and %.6f neighbours\n", dimensions, sums[0].neighbours_mean,
               sums[1].neighbours_mean);
        assert_true(fabs(sums[0].neighbours_mean - sums[1].neighbours_mean) < 1e-3);
        assert_true(sums[0].neighbours_mean > 4);
    }
}

static void change(World *world, const WorldDef *def)
{
    Error error;
    if (!world_change(world, def, &error))
        fail_msg("%s", error.message);
}

/* Numbers change without new programs; a viscosity in an inviscid world brings its terms, friction of the
 * walls too. */
static void changes_reach_the_programs(void **state)
{
    (void)state;
    WorldDef def = def_of(&cases[SQUARE_NO_SLIP]);
    def.fluids[0].viscosity = def.fluids[1].viscosity = 0;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    const Compute *compute = gpu->state;
    const unsigned before = compute->program[COMPUTE_KICK];
    fixture_step(cpu, 50);
    copy_state(cpu, gpu);
    def.sound_speed = 12;
    change(cpu, &def);
    change(gpu, &def);
    assert_int_equal(compute->program[COMPUTE_KICK], before);
    assert_int_equal(compute->drag, 0);
    compare_step("another speed of sound", cpu, gpu);
    def.fluids[1].viscosity = 5;
    change(cpu, &def);
    change(gpu, &def);
    assert_int_not_equal(compute->program[COMPUTE_KICK], before);
    compare_step("and a viscosity", cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* With a shader that does not compile the world goes on as it was. */
static void a_broken_shader_changes_nothing(void **state)
{
    (void)state;
    char directory[] = "/tmp/slosh_shadersXXXXXX", folder[64], path[80];
    assert_non_null(mkdtemp(directory));
    snprintf(folder, sizeof folder, "%s/sim", directory);
    snprintf(path, sizeof path, "%s/drift.comp", folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("void main() { broken }\n", file);
    fclose(file);

    WorldDef def = def_of(&cases[SQUARE_NO_SLIP]);
    def.fluids[0].viscosity = def.fluids[1].viscosity = 0;
    World *world = world_on(def, "compute"), *other = world_on(def, "compute");
    Error error;
    def.fluids[0].viscosity = 2;
    program_set_directory(directory);
    assert_false(world_change(world, &def, &error));
    program_set_directory(NULL);
    fixture_step(world, 10);
    fixture_step(other, 10);
    assert_true(world_hash(world) == world_hash(other));
    world_destroy(world);
    world_destroy(other);
    unlink(path);
    rmdir(folder);
    rmdir(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(initial_densities_are_taken, no_gl_errors),
        cmocka_unit_test_teardown(neighbours_are_those_of_the_last_grid, no_gl_errors),
        cmocka_unit_test_teardown(changes_reach_the_programs, no_gl_errors),
        cmocka_unit_test_teardown(a_broken_shader_changes_nothing, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_terms", tests, compute_setup, context_teardown);
}
