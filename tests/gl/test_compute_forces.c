/* What box and solids feel on the backend `compute` against `cpu`, from the same states. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "sim/gpu/compute/compute.h"
#include "sim/methods/wcsph/wcsph.h"

enum { METHODS = sizeof fixture_method_names / sizeof *fixture_method_names };

/* Fluid falling on a rocking ball, a no-slip block, and the floor. */
static WorldDef fall_def(const char *method, int dimensions)
{
    WorldDef def = fixture_def(1, 1.2, 0.5);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.04 : 0.08;
    def.fluids[0].viscosity = 5;
    def.fluids[0].velocity[1] = -2;
    def.sound_speed = 20;
    def.dt = 0.001;
    wcsph_def(&def)->corrected_gradient = true;
    *world_threads(&def) = 1;
    fixture_block(&def, 0, -0.5, 0, -0.25, 0.1, 0.8, 0.25);
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_SPHERE, .centre = {-0.2, 0.3, 0}, .radius = 0.16, .axis = {0, 1, 0}, .slip = SLIP_NONE};
    add_solid_motion(&def.solids[0],
                     (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 2});
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_BOX, .centre = {0.25, 0.12, 0}, .size = {0.24, 0.24, 0.24}, .axis = {0, 1, 0}};
    return def;
}

static World *world_with_forces(const WorldDef *def, const char *backend)
{
    Error error = {{0}};
    World *world = world_on(*def, backend);
    if (!world_enable_forces(world, &error))
        fail_msg("%s", error.message);
    return world;
}

/* Error of a push over the push's magnitude; torques over the magnitude times 1 m. */
static double off(const Push *a, const Push *b, double size)
{
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = fmax(most, fmax(fabs(a->force[k] - b->force[k]), fabs(a->torque[k] - b->torque[k])));
    return most / size;
}

static double size_of(const Push *push)
{
    return hypot(hypot(push->force[0], push->force[1]), push->force[2]);
}

/* After so many steps on the CPU, of a few more: box and solids within 1e-3 of what the ball feels. */
static void compare_forces(const WorldDef *def, int before, int steps)
{
    World *cpu = world_with_forces(def, "cpu"), *gpu = world_with_forces(def, "compute");
    Forces a, b;
    fixture_step(cpu, before);
    world_forces(cpu, &a);
    copy_state(cpu, gpu);
    const size_t guarded = info_of(gpu).guarded;
    fixture_step(cpu, steps);
    fixture_step(gpu, steps);
    world_forces(cpu, &a);
    world_forces(gpu, &b);
    const double size = size_of(&a.solid[0]), block = size_of(&a.solid[1]), box = size_of(&a.box);
    const double ball_off = off(&a.solid[0], &b.solid[0], size),
                 block_off = off(&a.solid[1], &b.solid[1], size), box_off = off(&a.box, &b.box, size);
    printf("%s in %dD: ball %.3g N off by %.1e, block %.3g N %.1e, box %.3g N %.1e; guarded %zu\n",
           def->method, def->dimensions, size, ball_off, block, block_off, box, box_off,
           info_of(gpu).guarded - guarded);
    assert_true(size > 1 && block > 1 && box > 1);
    assert_float_equal(b.seconds, steps * def->dt, 1e-6);
    assert_true(ball_off < 1e-3 && block_off < 1e-3 && box_off < 1e-3);
    world_forces(gpu, &b);
    assert_true(b.seconds == 0 && size_of(&b.box) == 0);
    world_destroy(cpu);
    world_destroy(gpu);
}

static void what_is_felt_is_that_of_the_cpu(void **state)
{
    (void)state;
    for (int run = 0; run < METHODS; run++) {
        WorldDef def = fall_def(fixture_method_names[run], 2 + run % 2);
        def.wall_slip = run == 0 ? SLIP_NONE : SLIP_FREE;
        compare_forces(&def, 60, 5);
    }
}

/* Fast enough for the guards at solids and walls. */
static void guards_are_felt(void **state)
{
    (void)state;
    WorldDef def = fall_def("mueller", 2);
    def.fluids[0].velocity[1] = -30;
    def.fluids[0].viscosity = 0;
    def.sound_speed = 1;
    compare_forces(&def, 0, 12);
}

/* Asked once a frame, as `slosh run` does: what is taken back comes to no sum. */
static void time_that_went_back_is_not_summed(void **state)
{
    (void)state;
    WorldDef def = fall_def("mueller", 2);
    def.dt = 0.015;
    def.retries = 3;
    World *world = world_with_forces(&def, "compute");
    double seconds = 0;
    Forces forces;
    for (int frame = 0; frame < 20; frame++) {
        fixture_step(world, 1);
        world_forces(world, &forces);
        assert_true(isfinite(forces.box.force[1]) && isfinite(forces.solid[0].force[1]));
        seconds += forces.seconds;
    }
    assert_true(info_of(world).trouble.count > 0);
    assert_float_equal(seconds, info_of(world).time, 1e-6);
    world_destroy(world);
}

static void who_does_not_ask_has_nothing_of_it(void **state)
{
    (void)state;
    const WorldDef def = fall_def("mueller", 2);
    World *world = world_on(def, "compute");
    const Compute *compute = world->state;
    fixture_step(world, 1);
    assert_true(!compute->forces.buffer && !compute->forces.marked);
    for (int pass = COMPUTE_FORCES; pass < COMPUTE_PASS_COUNT; pass++)
        assert_int_equal(compute->program[pass], 0);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_is_felt_is_that_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(guards_are_felt, no_gl_errors),
        cmocka_unit_test_teardown(time_that_went_back_is_not_summed, no_gl_errors),
        cmocka_unit_test_teardown(who_does_not_ask_has_nothing_of_it, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_forces", tests, compare_setup, context_teardown);
}
