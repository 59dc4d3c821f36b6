/* A method with a column (tests/sim/toy_method.h) on the backend compute: the column always follows the
   particle. */
#include "tests/gl/compare.h"
#include "tests/lists.h"
#include "tests/sim/toy_method.h"
#include "tests/sim/toy_shaders.h"

#include "sim/gpu/compute/compute.h"
#include "sim/gpu/gl.h"
#include "sim/state.h"

#include <epoxy/gl.h>

/* Springs soon oscillate, so that particles change cells; emitters and drains on request. */
static WorldDef toy_def(bool flows)
{
    WorldDef def = fixture_def(1, 1, 1);
    strcpy(def.method, "toy");
    *world_threads(&def) = 1;
    def.spacing = 0.08;
    fixture_block(&def, 0, -0.4, 0, -0.4, 0.2, 0.5, 0.4);
    if (!flows)
        return def;
    def.most = 3000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {-0.2, 0.8, 0}, .direction = {0, -1, 0}, .radius = 0.2, .speed = 3});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0, 0, -0.5}, .max = {0.5, 0.2, 0.5}});
    return def;
}

static WorldState saved_of(World *world)
{
    WorldState saved = {.count = 0};
    Error error;
    if (!world_save(world, &saved, &error))
        fail_msg("%s", error.message);
    return saved;
}

/* Places, velocities and ages of the same particles: within 1e-4 of the greatest. */
static void compare(World *cpu, World *gpu, const char *what)
{
    WorldState a = saved_of(cpu), b = saved_of(gpu);
    const float *const one[] = {a.particles.x, a.particles.y, a.particles.vx, a.particles.own[0]},
                       *const other[] = {b.particles.x, b.particles.y, b.particles.vx, b.particles.own[0]};
    size_t *at = calloc(10000, sizeof *at);
    float off[4] = {0}, greatest[4] = {0};
    assert_int_equal(a.count, b.count);
    for (size_t i = 0; i < b.count; i++)
        at[b.particles.id[i]] = i + 1;
    for (size_t i = 0; i < a.count; i++) {
        const size_t j = at[a.particles.id[i]];
        assert_true(j > 0);
        for (int k = 0; k < 4; k++) {
            greatest[k] = fmaxf(greatest[k], fabsf(one[k][i]));
            off[k] = fmaxf(off[k], fabsf(one[k][i] - other[k][j - 1]));
        }
    }
    printf("%s: %zu particles; x off by %.1e of the greatest, y by %.1e, speed by %.1e, age by %.1e\n", what,
           a.count, (double)(off[0] / greatest[0]), (double)(off[1] / greatest[1]),
           (double)(off[2] / greatest[2]), (double)(off[3] / greatest[3]));
    for (int k = 0; k < 4; k++)
        assert_true(greatest[k] > 0.01F && off[k] <= 1e-4F * greatest[k]);
    free(at);
    world_state_free(&a);
    world_state_free(&b);
}

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int flows = 0; flows < 2; flows++) {
        const WorldDef def = toy_def(flows);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, 60);
        fixture_step(gpu, 60);
        assert_true(!flows || (info_of(gpu).emitted > 50 && info_of(gpu).drained > 50));
        compare(cpu, gpu, flows ? "emitters and drains" : "a block");
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* The shader reads it in the method's block. */
static void a_live_key_reaches_both(void **state)
{
    (void)state;
    WorldDef def = toy_def(false);
    World *const worlds[] = {world_on(def, "cpu"), world_on(def, "compute")};
    *(double *)method_def(&def, &toy) = 800;
    for (int k = 0; k < 2; k++) {
        Error error;
        fixture_step(worlds[k], 5);
        if (!world_change(worlds[k], &def, &error))
            fail_msg("%s", error.message);
        fixture_step(worlds[k], 20);
    }
    compare(worlds[0], worlds[1], "a live key");
    world_destroy(worlds[0]);
    world_destroy(worlds[1]);
}

static void it_moves_from_backend_to_backend(void **state)
{
    (void)state;
    const WorldDef def = toy_def(true);
    World *straight = world_on(def, "cpu"), *moved = world_on(def, "cpu");
    fixture_step(straight, 60);
    for (int k = 0; k < 3; k++) {
        Error error;
        fixture_step(moved, 20);
        if (!world_move(&moved, k == 1 ? "cpu" : "compute", &error))
            fail_msg("%s", error.message);
    }
    compare(straight, moved, "cpu, compute, cpu");
    world_destroy(straight);
    world_destroy(moved);
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    WorldDef def = toy_def(true);
    def.reproducible = true; /* a GPU else sorts as it comes */
    check_save_load_step(def, "compute", 30);
}

/* As the sentinel does it, on the device. */
static void it_goes_back(void **state)
{
    (void)state;
    World *world = world_on(toy_def(false), "compute");
    Error error;
    fixture_step(world, 10);
    WorldState before = saved_of(world);
    assert_true(world->backend->mark(world->state, &error));
    fixture_step(world, 10);
    world->backend->back(world->state, before.count, 0);
    WorldState after = saved_of(world);
    assert_memory_equal(before.particles.id, after.particles.id, before.count * sizeof(ParticleId));
    assert_memory_equal(before.particles.own[0], after.particles.own[0], 4 * before.count);
    world_state_free(&before);
    world_state_free(&after);
    world_destroy(world);
}

/* Declarations under different names. */
static void own_columns_stand_beside_forces(void **state)
{
    (void)state;
    World *world = world_on(toy_def(false), "compute");
    const Compute *compute = world->state;
    Error error = {0};
    const char *const stages[] = {"sim/toy/forces.comp", NULL};
    const unsigned program = program_create("forces", stages, compute->defines, &error);
    if (!program)
        fail_msg("%s", error.message);
    glDeleteProgram(program);
    world_destroy(world);
}

static int setup(void **state)
{
    toy_shaders_add();
    return compare_setup(state);
}

static int teardown(void **state)
{
    toy_shaders_remove();
    return context_teardown(state);
}

int main(void)
{
    toy_method_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(a_live_key_reaches_both, no_gl_errors),
        cmocka_unit_test_teardown(it_moves_from_backend_to_backend, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(it_goes_back, no_gl_errors),
        cmocka_unit_test_teardown(own_columns_stand_beside_forces, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.toy_method", tests, setup, teardown);
}
