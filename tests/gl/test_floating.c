/* Solids that float on the backend `compute` against `cpu`, from the same start; and from a saved state. */
#include "tests/gl/compare.h"

/* A free body and a hinged body. */
static WorldDef floating_def(const char *method)
{
    WorldDef def = fixture_def(1.2, 0.9, 0);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.sound_speed = 15;
    def.dt = 0.002;
    snprintf(def.method, sizeof def.method, "%s", method);
    *world_threads(&def) = 1;
    fixture_block(&def, 0, -0.6, 0, 0, 0.6, 0.4, 0);
    def.solid_count = 2;
    def.solids[0] = (SolidDef){.kind = SOLID_BOX,
                               .centre = {-0.2, 0.4, 0},
                               .size = {0.3, 0.2, 1},
                               .axis = {0, 0, 1},
                               .angle_deg = 15,
                               .density = 300};
    def.solids[1] = (SolidDef){.kind = SOLID_SPHERE,
                               .centre = {0.35, 0.4, 0},
                               .radius = 0.12,
                               .density = 600,
                               .hinge_at = {0.3, 0.4, 0},
                               .hinge_axis = {0, 0, 1}};
    return def;
}

static void compute_moves_them_as_cpu_does(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        const WorldDef def = floating_def(fixture_method_names[m]);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 10);
        substeps(gpu, 10);
        const WorldInfo one = info_of(cpu), two = info_of(gpu);
        for (int s = 0; s < 2; s++) {
            const BoxState *a = &one.floating[s], *b = &two.floating[s];
            double moved = 0, off = 0;
            for (int k = 0; k < 3; k++) {
                moved += fabs(a->velocity[k]) + fabs(a->angular_velocity[k]);
                off += fabs(a->velocity[k] - b->velocity[k]) +
                       fabs(a->angular_velocity[k] - b->angular_velocity[k]);
            }
            if (!(moved > 0.01 && off < 0.02 * moved))
                fail_msg("%s, solid %d: moves by %g, and is off by %g", fixture_method_names[m], s, moved,
                         off);
        }
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

static void what_is_saved_goes_on_the_same(void **state)
{
    (void)state;
    const WorldDef def = floating_def("mueller");
    World *gpu = world_on(def, "compute"), *later = world_on(def, "compute");
    substeps(gpu, 10);
    substeps(later, 3); /* forces of its last step are under way */
    copy_state(gpu, later);
    substeps(gpu, 10);
    substeps(later, 10);
    assert_true(world_hash(gpu) == world_hash(later));
    world_destroy(gpu);
    world_destroy(later);
}

static void save(World *world)
{
    WorldState state = {0};
    Error error;
    if (!world_save(world, &state, &error))
        fail_msg("%s", error.message);
    world_state_free(&state);
}

/* Questions for forces in each step leave no trace. A save before, which takes late forces, changes no
 * answer. */
static void questions_leave_no_trace(void **state)
{
    enum { STEPS = 3 }; /* sound for so long */
    (void)state;
    for (int m = 0; m < 4; m++) {
        WorldDef def = floating_def(fixture_method_names[m]);
        Error error = {0};
        def.fluids[0].velocity[0] = 10; /* through a wall, which pushes behind the kick */
        World *asked = world_on(def, "compute"), *saved = world_on(def, "compute");
        assert_true(world_enable_forces(asked, &error) && world_enable_forces(saved, &error));
        for (int k = 0; k < STEPS; k++) {
            Forces one, two;
            substeps(asked, 1);
            substeps(saved, 1);
            world_forces(asked, &one);
            save(saved);
            world_forces(saved, &two);
            assert_true(world_hash(asked) == world_hash(saved));
            assert_true(one.seconds > 0 && fabs(one.solid[0].force[1]) > 0);
            assert_memory_equal(&one, &two, sizeof one);
        }
        world_destroy(asked);
        world_destroy(saved);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compute_moves_them_as_cpu_does),
        cmocka_unit_test(what_is_saved_goes_on_the_same),
        cmocka_unit_test(questions_leave_no_trace),
    };
    return cmocka_run_group_tests(tests, compare_setup, context_teardown);
}
