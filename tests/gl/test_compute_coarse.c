/* The coarse level of `compute` against that of `cpu`: one correction of the same residuals, and iterations
   in deep water. */
#include "tests/gl/compare.h"

#include "sim/cpu/cpu.h"
#include "sim/gpu/compute/compute.h"
#include "sim/methods/dfsph/dfsph_private.h"
#include "tests/lists.h"

#include <epoxy/gl.h>

typedef struct Tank {
    const char *name;
    int dimensions, layers;
    double wide, deep, above; /* m; of the box, in spacings */
    const char *sides;        /* periodic */
    bool negative, thin;
} Tank;

/* A box far above the water has places for several cells (CellFold.shared). Across periodic sides the cells
   of the grid are odd. */
static const Tank tanks[] = {
    {"plane", 2, 30, 0.5, 0, 15, .sides = ""},
    {"periodic, pressure that pulls", 3, 14, 0.4, 0.3, 8, .sides = "xz", .negative = true},
    {"far above", 3, 14, 0.3, 0.2, 4000, .sides = ""},
    {"thin", 2, 4, 0.5, 0, 10, .thin = true},
};

static WorldDef tank_def(const Tank *tank)
{
    static const Motion motion = {
        .kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.05, .frequency = 1.5};
    const double spacing = 0.025;
    WorldDef def = fixture_def(tank->wide, spacing * (tank->layers + tank->above), tank->deep);
    strcpy(def.method, "dfsph");
    def.dimensions = tank->dimensions;
    def.spacing = spacing;
    def.support = tank->dimensions == 2 ? 3.1 : 2.22;
    def.dt = 0.003;
    def.reproducible = true;
    def.negative_pressure = tank->negative;
    dfsph_def(&def)->surface_lack = 1;
    for (int k = 0; tank->sides && k < 3; k++)
        def.periodic[k] = strchr(tank->sides, "xyz"[k]) != NULL;
    add_motion(&def, motion);
    fixture_block(&def, 0, -0.5 * tank->wide, 0, -0.5 * tank->deep, 0.5 * tank->wide, spacing * tank->layers,
                  0.5 * tank->deep);
    return def;
}

/* A column of scratch, or each fourth number of a buffer of vec4. */
static float *numbers(unsigned buffer, size_t first, size_t stride, size_t count)
{
    const size_t bytes = (first + stride * (count - 1) + 1) * sizeof(float);
    float *all = malloc(bytes), *out = malloc(count * sizeof *out);
    assert_non_null(all);
    assert_non_null(out);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)bytes, all);
    for (size_t i = 0; i < count; i++)
        out[i] = all[first + stride * i];
    free(all);
    return out;
}

static WorkGroups groups(size_t count)
{
    return (WorkGroups){.along = (uint)count, .rows = 1, .deep = 1};
}

/* A correction is due. */
static void put_block(const Compute *c)
{
    const SolveBlock block = {.coarse_groups = groups((c->count + COMPUTE_GROUP - 1) / COMPUTE_GROUP),
                              .coarse_cell_groups = groups(compute_coarse_shape(c->constants).cells),
                              .coarse_solve_groups = groups(1),
                              .coarse = 1};
    assert_in_range(block.coarse_cell_groups.along, 1, COMPUTE_ALONG);
    glNamedBufferSubData(c->solve, 0, sizeof block, &block);
}

static bool found_thin(const Compute *c)
{
    SolveBlock block;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(c->solve, 0, sizeof block, &block);
    return block.coarse == 0;
}

/* Of the same k and residuals. Returns the worst difference of k over the greatest change. */
static double correct_both(World *cpu_world, World *gpu_world, bool thin)
{
    static const Pass *const passes[] = {&dfsph_state, &dfsph_divergence_begin, &dfsph_divergence_push,
                                         &dfsph_divergence_rate};
    Cpu *cpu = cpu_world->state;
    Compute *gpu = gpu_world->state;
    const ApparentGravity g = {.origin = {0.5F, -11, 0}}; /* more than what k held in the last step */
    const PassInput input = {.dt = 0.003F, .apparent = &g, .gravity = {0.5F, -11, 0}};
    const ComputeScratch scratch = compute_scratch_of(gpu->constants);
    const ColumnDef *residual_column = NULL;
    for (int k = 0; k < scratch.count; k++)
        if (strcmp(scratch.row[k]->name, "residual") == 0)
            residual_column = scratch.row[k];
    assert_non_null(residual_column);
    cpu_world->backend->grid(cpu);
    cpu_world->backend->run(cpu, &dfsph_state, &input);
    gpu_world->backend->grid(gpu);
    compute_set_force(gpu, &input);
    for (size_t k = 0; k < sizeof passes / sizeof *passes; k++)
        compute_pass(gpu, passes[k], &input);
    const size_t count = cpu->count, at = compute_scratch_place(gpu, residual_column);
    float *before = numbers(gpu->near, 3, 4, count), *residual = numbers(gpu->scratch, at, 1, count);
    put_block(gpu);
    compute_correct(gpu, &dfsph_coarse, &input);
    assert_true(found_thin(gpu) == thin);
    float *after = numbers(gpu->near, 3, 4, count);
    memcpy(cpu->now.pressure_term, before, count * sizeof *before);
    memcpy(cpu->now.own[RESIDUAL], residual, count * sizeof *residual);
    memset(cpu->now.own[FACTOR], 0, count * sizeof(float)); /* near has the iteration's own step already */
    cpu_world->backend->run(cpu, &dfsph_coarse, &input);
    assert_true(cpu->thin == thin);
    double worst = 0, change = 0, more = 0;
    for (size_t i = 0; i < count; i++) {
        change = fmax(change, fabs((double)cpu->now.pressure_term[i] - (double)before[i]));
        more += cpu->now.pressure_term[i] > before[i];
        worst = fmax(worst, fabs((double)cpu->now.pressure_term[i] - (double)after[i]));
    }
    printf("k changes by %.3g at most, off by %.2g, more for %g of %zu\n", change, worst, more, count);
    assert_true(thin ? change == 0 && worst == 0 : change > 0 && more > 0.5 * (double)count);
    free(before);
    free(residual);
    free(after);
    return thin ? 0 : worst / change;
}

static void corrections_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof tanks / sizeof *tanks; k++) {
        const WorldDef def = tank_def(&tanks[k]);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, 12);
        copy_state(cpu, gpu);
        printf("%s: ", tanks[k].name);
        assert_true(((const Compute *)gpu->state)->fold.shared == (tanks[k].above > 1000));
        assert_true(correct_both(cpu, gpu, tanks[k].thin) < 1e-4);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

typedef struct Iterations {
    double first, mean; /* of the solver of divergence: in the first step; a step */
} Iterations;

static Iterations iterations_of(const char *backend, bool coarse)
{
    enum { STEPS = 20 };
    WorldDef def = tank_def(&tanks[0]);
    Iterations found = {0};
    dfsph_def(&def)->coarse = coarse;
    World *world = world_on(def, backend);
    for (int k = 0; k < STEPS; k++) {
        fixture_step(world, 1);
        const double of = info_of(world).solves[1].iterations;
        found.first = k == 0 ? of : found.first;
        found.mean += of / STEPS;
    }
    printf("%s, %s: %g iterations in the first step, %.2f a step\n", backend, coarse ? "coarse" : "alone",
           found.first, found.mean);
    world_destroy(world);
    return found;
}

/* Later steps are not the same, since fluid that is heaved has no order. */
static void deep_water_takes_fewer_iterations_as_on_the_cpu(void **state)
{
    (void)state;
    const Iterations alone = iterations_of("compute", false), with = iterations_of("compute", true),
                     on_cpu = iterations_of("cpu", true);
    assert_true(with.mean < 0.6 * alone.mean);
    assert_true(with.first < 0.5 * alone.first);
    assert_true(fabs(with.first - on_cpu.first) <= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(corrections_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(deep_water_takes_fewer_iterations_as_on_the_cpu, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_coarse", tests, compare_setup, context_teardown);
}
