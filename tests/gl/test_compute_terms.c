/* The backend `compute` against `cpu`: wcsph, surface tension, no-slip walls, changes while a world lives.
   Each term of each pass once; gl.compute_mixes has more of their mixes. */
#include "tests/gl/parity_case.h"
#include "tests/scratch.h"

#include "sim/gpu/compute/compute.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"

#include <epoxy/gl.h>
#include <sys/stat.h>
#include <unistd.h>

/* clang-format off */
static const ParityCase cases[] = {
    {"both viscosities, diffusion, cohesion", 3, 2.1, {2, 0}, TENSION_COHESION,
     .kernel = "cubic", .delta = 0.1, .artificial = 0.2, .solids = true, .runs = true},
    {"Wendland, diffusion, tension of pressure", 2, 3,
     .kernel = "wendland_c2", .delta = 0.1, .artificial = 0.1, .negative = true},
    {"quintic, laminar, no slip", 2, 3, {1, 3}, .kernel = "quintic", .no_slip = true, .solids = true},
    {"Wendland, radial and artificial, no slip", 3, 2.1, {2, 0},
     .kernel = "wendland_c2", .artificial = 0.1, .form = VISCOSITY_RADIAL, .no_slip = true, .solids = true},
    {"colour field, no slip", 3, 2.1, {1, 0}, TENSION_COLOUR_FIELD, .method = "mueller", .no_slip = true},
    {"cohesion", 2, 2.1, {1, 3}, TENSION_COHESION, .method = "mueller"},
    {"Wendland, laminar, periodic, lid, shifting", 2, 3, {1, 3}, .kernel = "wendland_c2", .delta = 0.1,
     .negative = true, .no_slip = true, .solids = true, .sides = "x", .shifting = 0.2, .lid = 1},
    {"Wendland, radial, solids", 2, 3, {1, 3}, .kernel = "wendland_c2", .form = VISCOSITY_RADIAL, .solids = true},
    {"cubic, corrected gradient", 3, 2.1, .kernel = "cubic", .artificial = 0.1, .solids = true, .corrected = true},
    {"quintic, 1 : 100", 2, 3, .kernel = "quintic", .delta = 0.1, .artificial = 0.1, .solids = true, .light = 10},
    {"Wendland, corrected gradient, shifting, 1 : 100", 2, 3, {1, 3}, .kernel = "wendland_c2", .delta = 0.1, .negative = true,
     .solids = true, .shifting = 0.2, .corrected = true, .light = 10},
    {"quintic, periodic, shifting", 2, 3, {1, 3}, .kernel = "quintic", .negative = true, .sides = "xy", .shifting = 0.2},
    {"cubic, periodic, cohesion, shifting", 3, 2.1, .tension = TENSION_COHESION,
     .kernel = "cubic", .delta = 0.1, .artificial = 0.1, .sides = "xz", .shifting = 0.1},
    {"Wendland, curvature, shifting", 2, 3, .tension = TENSION_CURVATURE, .kernel = "wendland_c2", .delta = 0.1,
     .artificial = 0.1, .negative = true, .shifting = 0.2, .solids = true, .runs = true},
    {"Wendland, curvature, shifting, corrected", 3, 2.6, {1, 3}, TENSION_CURVATURE, .kernel = "wendland_c2", .delta = 0.1,
     .form = VISCOSITY_RADIAL, .negative = true, .shifting = 0.2, .corrected = true, .no_slip = true},
    {"cubic, curvature, periodic", 3, 2.1, .tension = TENSION_CURVATURE, .kernel = "cubic", .artificial = 0.1,
     .sides = "x"},
    {"quintic, periodic", 3, 2.1, {1, 3}, .method = "mueller", .kernel = "quintic", .solids = true, .sides = "x"},
};
/* clang-format on */
static const ParityTable table = {"wcsph", 0.0005, 200, sizeof cases / sizeof *cases, cases};
enum { SQUARE_WCSPH = 1, SQUARE_NO_SLIP = 2 };

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    parity_check(&table);
}

static WorldDef def_of(int at)
{
    return parity_def(&table, &cases[at]);
}

/* Densities that are carried go along; two runs have the same bits. */
static void save_load_step_is_step(void **state)
{
    (void)state;
    WorldDef def = def_of(SQUARE_WCSPH);
    def.reproducible = true; /* a GPU else sorts as it comes */
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
    WorldDef def = def_of(SQUARE_WCSPH);
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

/* Views get the density that is carried. */
static void views_see_the_densities(void **state)
{
    (void)state;
    World *world = world_on(def_of(SQUARE_WCSPH), "compute");
    fixture_step(world, 20);
    const size_t count = world->count;
    float *read = malloc(count * sizeof *read), *shared = malloc(count * sizeof *shared), greatest = 0;
    ParticleArrays arrays = {0};
    ParticleBuffers buffers = {0};
    arrays.scalar[SCALAR_DENSITY] = read;
    world_read(world, &arrays);
    compute_share(world->state, PARTICLE_SCALAR(SCALAR_DENSITY), &buffers);
    glGetNamedBufferSubData(buffers.scalar[SCALAR_DENSITY].buffer, 0, (GLsizeiptr)(count * sizeof *shared),
                            shared);
    for (size_t i = 0; i < count; i++) {
        assert_true(fabsf(read[i] - shared[i]) < 2e-4F);
        greatest = fmaxf(greatest, read[i]);
    }
    assert_true(greatest > 1001);
    free(read);
    free(shared);
    world_destroy(world);
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
        *world_threads(&def) = 1;
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
    WorldDef def = def_of(SQUARE_NO_SLIP);
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

static const Pass *pass_named(const Method *method, const char *name)
{
    const Pass *const *pass = method->passes;
    while (strcmp((*pass)->name, name) != 0)
        pass++;
    return *pass;
}

/* No program, no buffer is made anew; a state brings the viscosity of its time. */
static void a_table_is_a_number_each_step(void **state)
{
    (void)state;
    WorldDef def = def_of(SQUARE_NO_SLIP);
    def.fluids[0].viscosity_table = (TimeTable){3, {0, 40 * def.dt, 100 * def.dt}, {4, 4, 0}};
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    const Compute *compute = gpu->state;
    const ComputePass forces = compute_method_pass(compute, pass_named(gpu->constants.method, "force"));
    const unsigned force = compute->program[forces], kick = compute->program[COMPUTE_KICK];
    const size_t bytes = compute->bytes;
    fixture_step(cpu, 60);
    assert_true(cpu->constants.viscosity[0] > 1 && cpu->constants.viscosity[0] < 4);
    copy_state(cpu, gpu);
    compare_step("a viscosity by a table", cpu, gpu);
    fixture_step(gpu, 100);
    assert_true(gpu->constants.viscosity[0] < 1e-6F);
    assert_true(compute->program[forces] == force && compute->program[COMPUTE_KICK] == kick);
    assert_true(compute->bytes == bytes);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* After a shader that does not compile the world continues unchanged. */
static void a_broken_shader_changes_nothing(void **state)
{
    (void)state;
    char directory[SCRATCH_SIZE], folder[SCRATCH_PATH], path[SCRATCH_PATH + 16];
    scratch_folder(directory);
    snprintf(folder, sizeof folder, "%s/sim", directory);
    snprintf(path, sizeof path, "%s/drift.comp", folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("void main() { broken }\n", file);
    fclose(file);

    WorldDef def = def_of(SQUARE_NO_SLIP);
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
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(initial_densities_are_taken, no_gl_errors),
        cmocka_unit_test_teardown(views_see_the_densities, no_gl_errors),
        cmocka_unit_test_teardown(neighbours_are_those_of_the_last_grid, no_gl_errors),
        cmocka_unit_test_teardown(changes_reach_the_programs, no_gl_errors),
        cmocka_unit_test_teardown(a_table_is_a_number_each_step, no_gl_errors),
        cmocka_unit_test_teardown(a_broken_shader_changes_nothing, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_terms", tests, compare_setup, context_teardown);
}
