/* Emitters and drains on the backend `compute` against `cpu`. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "sim/flow/flow.h"
#include "sim/start/start.h"

/* A jet falling into a tray beside a drain; two fluids, a moving solid, a moving box. */
static WorldDef jet_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 0.9, 0.8);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.03 : 0.06;
    def.sound_speed = 20;
    def.dt = 0.002;
    *world_threads(&def) = 1;
    def.most = 3000;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 800, .viscosity = 3};
    fixture_block(&def, 0, -0.6, 0, -0.4, 0.6, 0.2, 0.4);
    add_emit(
        &def.fluids[1],
        (Emit){
            .centre = {-0.2, 0.8, 0}, .direction = {0.3, -1, 0}, .radius = 0.135, .speed = 2, .start = 0.05});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0.4, 0, -0.4}, .max = {0.6, 0.2, 0.4}});
    add_drain(&def, (Fill){.kind = FILL_BALL, .centre = {-0.5, 0.1, 0}, .radius = 0.08});
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 2});
    SolidDef *ball = &def.solids[def.solid_count++];
    *ball = (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.3, 0}, .radius = 0.15, .slip = SLIP_NONE};
    add_solid_motion(ball,
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.1, .frequency = 3});
    return def;
}

/* The same particles in each world, by ids. */
static void same_ids(World *a, World *b)
{
    Snapshot x = snapshot_read(a), y = snapshot_read(b);
    assert_int_equal(x.count, y.count);
    for (size_t k = 0; k < x.count; k++)
        if (x.who[k].id != y.who[k].id)
            fail_msg("one has particle %u, the other %u", x.who[k].id, y.who[k].id);
    snapshot_free(&x);
    snapshot_free(&y);
}

/* A jet falling into drains without a splash: rounding errors do not grow. */
static WorldDef fountain_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 0.8, 0.8);
    def.dimensions = dimensions;
    def.spacing = 0.05;
    def.sound_speed = 20;
    def.dt = 0.004;
    *world_threads(&def) = 1;
    def.most = 2000;
    def.gravity[1] = -6;
    def.fluids[0].viscosity = 10;
    add_emit(&def.fluids[0],
             (Emit){.centre = {-0.4, 0.4, 0}, .direction = {1, 0.3, 0}, .radius = 0.11, .speed = 2});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {-0.6, 0, -0.4}, .max = {0.6, 0.2, 0.4}});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0.3, 0, -0.4}, .max = {0.6, 0.8, 0.4}});
    return def;
}

static void a_fountain_gives_and_takes_as_many(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const WorldDef def = fountain_def(dimensions);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 300);
        substeps(gpu, 300);
        const WorldInfo a = info_of(cpu), b = info_of(gpu);
        printf("%dD: in 300 steps %lu came and %lu went, on the CPU %lu and %lu\n", dimensions,
               (unsigned long)b.emitted, (unsigned long)b.drained, (unsigned long)a.emitted,
               (unsigned long)a.drained);
        assert_true(a.emitted > 200 && a.drained > 100);
        assert_true(a.emitted == b.emitted && a.drained == b.drained);
        same_ids(cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* Where it splashes the last bit grows: from the same state each time. */
static void as_many_come_and_go(void **state)
{
    (void)state;
    static const char *const names[] = {"2D, mueller", "3D, mueller", "2D, wcsph"};
    for (int run = 0; run < 3; run++) {
        WorldDef def = jet_def(run == 1 ? 3 : 2);
        const int parts = run == 2 ? 2 : 1; /* half a step for carried density: a solid's particles come
                                               nearer than h */
        snprintf(def.method, sizeof def.method, "%s", run == 2 ? "wcsph" : "mueller");
        def.dt /= parts;
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        for (int i = 0; i < 8; i++) {
            substeps(cpu, 20 * parts);
            substeps(gpu, 20 * parts);
            const WorldInfo a = info_of(cpu), b = info_of(gpu);
            assert_true(a.emitted == b.emitted && a.drained == b.drained && a.count == b.count);
            same_ids(cpu, gpu);
            copy_state(cpu, gpu);
        }
        assert_true(info_of(cpu).emitted > 60 && info_of(cpu).drained > 20);
        compare_one_step(names[run], cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* Scenes of play, coarser. */
static void scenes_stay_with_the_cpu(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double spacing;
        int before;
    } scenes[] = {{"bowl", 0.016, 1000}, {"fountain", 0.022, 600}};
    for (int n = 0; n < 2; n++) {
        WorldDef def = scene_def(scenes[n].name, scenes[n].spacing);
        strcpy(def.method, "mueller"); /* small steps, in which the backends stay together for long */
        def.sound_speed = 12;
        def.dt = 0.001;
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, scenes[n].before);
        copy_state(cpu, gpu);
        compare_one_step(scenes[n].name, cpu, gpu);
        compare_run(&def, scenes[n].name, cpu, gpu, 200);
        const WorldInfo a = info_of(cpu), b = info_of(gpu);
        printf("%s: %lu came and %lu went, on the CPU %lu and %lu\n", scenes[n].name,
               (unsigned long)b.emitted, (unsigned long)b.drained, (unsigned long)a.emitted,
               (unsigned long)a.drained);
        assert_true(a.count > 150 && fabs((double)b.emitted / (double)a.emitted - 1) < 0.01);
        assert_true(fabs((double)b.drained - (double)a.drained) < 0.01 * (double)a.emitted);
        assert_true(least_clearance(gpu, &def) > -1e-5);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* An empty box, and a disk at its left side. */
static WorldDef free_jet_def(void)
{
    WorldDef def = fixture_def(4, 1, 1);
    def.spacing = 0.05;
    def.gravity[1] = 0;
    def.sound_speed = 20;
    def.most = 4000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {-1.8, 0.5, 0}, .direction = {1, 0, 0}, .radius = 0.2, .speed = 2});
    return def;
}

/* Up to the bound and no further; where a drain takes some away, on again. */
static void the_bound_holds(void **state)
{
    (void)state;
    WorldDef def = free_jet_def();
    def.most = 300;
    World *world = world_on(def, "compute");
    substeps(world, 200);
    assert_true(info_of(world).count == 300 && info_of(world).emitted == 300 && info_of(world).full);
    world_destroy(world);
    add_drain(&def, (Fill){.kind = FILL_BALL, .centre = {-1.3, 0.5, 0}, .radius = 0.4});
    world = world_on(def, "compute");
    for (int i = 0; i < 300; i++) {
        substeps(world, 1);
        assert_true(info_of(world).count <= 300);
    }
    Snapshot s = snapshot_read(world);
    for (size_t i = 0; i < s.count; i++) /* a step's way at most is between it and the last draining */
        assert_true(hypot(hypot(s.position[4 * i] + 1.3, s.position[4 * i + 1] - 0.5),
                          s.position[4 * i + 2]) > 0.4 - 0.02);
    for (size_t k = 1; k < s.count; k++)
        assert_true(s.who[k].id > s.who[k - 1].id);
    assert_true(info_of(world).drained > 200 && info_of(world).emitted == s.count + info_of(world).drained);
    snapshot_free(&s);
    world_destroy(world);
}

/* Two disks at the same place give a single particle where two lack space; no particle starts inside a
   solid. */
static void nothing_comes_where_something_is(void **state)
{
    (void)state;
    WorldDef def = free_jet_def();
    own_emits(&def.fluids[0])->centre[0] = 0;
    add_emit(&def.fluids[0], def.fluids[0].emits[0])->direction[0] = -1;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    substeps(cpu, 3);
    substeps(gpu, 3);
    assert_true(info_of(gpu).emitted > 0);
    same_ids(cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);

    def = free_jet_def();
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-1.8, 0.5, 0}, .radius = 0.45, .axis = {0, 1, 0}};
    gpu = world_on(def, "compute");
    substeps(gpu, 50);
    assert_int_equal(info_of(gpu).emitted, 0);
    world_destroy(gpu);
}

/* A disk of more candidates than fit into the buffer at once. */
static void a_wide_layer_comes_in_parts(void **state)
{
    (void)state;
    WorldDef def = fixture_def(4, 0.5, 4);
    def.spacing = 0.05;
    def.gravity[1] = 0;
    def.most = 6000;
    add_emit(&def.fluids[0],
             (Emit){.centre = {0, 0.25, 0}, .direction = {0, 1, 0}, .radius = 1.95, .speed = 1});
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    substeps(cpu, 1);
    substeps(gpu, 1);
    assert_true(info_of(gpu).count > 4200);
    same_ids(cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* From cpu to compute, steps, back, steps: equal to a single backend; into worlds with more or fewer
   particles. */
static void the_state_goes_to_and_fro(void **state)
{
    (void)state;
    const WorldDef def = jet_def(3);
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute"), *other = world_on(def, "compute");
    substeps(cpu, 90);
    copy_state(cpu, gpu);
    substeps(gpu, 20);
    copy_state(gpu, cpu);
    same_ids(cpu, gpu);
    copy_state(gpu, other);
    assert_true(info_of(cpu).count != seed_count(&def, def.spacing));
    assert_true(world_hash(gpu) == world_hash(other));
    substeps(other, 40);
    copy_state(gpu, other); /* which has more by now */
    substeps(gpu, 10);
    substeps(other, 10);
    substeps(cpu, 10);
    assert_true(world_hash(gpu) == world_hash(other));
    same_ids(cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
    world_destroy(other);
}

/* A step far too long: what had come in since the mark goes back. */
static void going_back_takes_back_what_came(void **state)
{
    (void)state;
    WorldDef def = jet_def(3);
    def.retries = 3;
    def.dt = 0.06;
    def.substeps = 2;
    World *world = world_on(def, "compute");
    Error error;
    for (int i = 0; i < 20 && world_step(world, NULL, &error); i++)
        continue;
    const WorldInfo info = info_of(world);
    assert_true(info.trouble.count > 0);
    assert_int_equal(info.count, seed_count(&def, def.spacing) + info.emitted - info.drained);
    Snapshot s = snapshot_read(world);
    for (size_t k = 1; k < s.count; k++)
        assert_true(s.who[k].id > s.who[k - 1].id);
    snapshot_free(&s);
    world_destroy(world);
}

/* A far too long step in a frame of many: the watch trips early, and drains continue until the frame
   ends. */
static WorldDef boiling_def(int retries)
{
    WorldDef def = fixture_def(1.2, 0.9, 0.8);
    def.sound_speed = 20;
    *world_threads(&def) = 1;
    def.retries = retries;
    def.dt = 0.8;
    def.substeps = 8;
    fixture_block(&def, 0, -0.6, 0, -0.4, 0.6, 0.8, 0.4);
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {0.4, 0, -0.4}, .max = {0.6, 0.2, 0.4}});
    return def;
}

/* The old particles minus the removed particles, each exactly once. */
static void assert_counted(World *world, size_t initial)
{
    const WorldInfo info = info_of(world);
    assert_true(info.count <= initial && info.drained <= initial);
    assert_int_equal(info.count + info.drained, initial);
    Snapshot s = snapshot_read(world);
    assert_true(s.count == 0 || s.who[s.count - 1].id < initial);
    for (size_t k = 1; k < s.count; k++)
        assert_true(s.who[k].id > s.who[k - 1].id);
    for (size_t i = 0; info.trouble.count == 0 && i < s.count;
         i++) { /* nothing moves after the last draining */
        const float *x = s.position + 4 * i;
        assert_false(fill_holds(&world->def.drains[0], 3, (const double[3]){x[0], x[1], x[2]}, 0));
    }
    snapshot_free(&s);
}

static void drains_count_behind_a_blow_up(void **state)
{
    (void)state;
    for (int retries = 0; retries <= 2; retries++) {
        const WorldDef def = boiling_def(retries);
        const size_t initial = seed_count(&def, def.spacing);
        World *world = world_on(def, "compute");
        Error error = {0};
        bool good = true;
        for (int i = 0; i < 4 << retries && good; i++) {
            good = world_step(world, NULL, &error);
            assert_counted(world, initial);
        }
        const WorldInfo info = info_of(world);
        printf("%d retries: %zu particles of %zu, %lu drained; %d times back; %s\n", retries, info.count,
               initial, (unsigned long)info.drained, (int)info.trouble.count,
               good ? "goes on" : error.message);
        assert_false(good);
        assert_non_null(strstr(error.message, "blew up"));
        assert_int_equal(info.trouble.count, retries);
        world_destroy(world);
    }
}

/* Steps with flows wait as others do, once, and read nothing back. */
static void check_waits(const WorldDef *def)
{
    enum { STEPS = 60 };
    World *world = world_on(*def, "compute");
    const GlCalls before = gl_calls();
    substeps(world, STEPS);
    const GlCalls of = gl_calls_since(&before);
    assert_int_equal(of.readbacks, 0);
    assert_in_range(of.waits, 1, STEPS);
    world_destroy(world);
}

static void nothing_is_read_back(void **state)
{
    (void)state;
    WorldDef def = jet_def(3);
    long first;
    assert_true(emit_layers(&def.fluids[1].emits[0], def.spacing, 0, 60 * def.dt, &first) > 1);
    check_waits(&def);
    def.drain_count = 0;
    check_waits(&def);
    def.fluids[1].emit_count = 0;
    check_waits(&def);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_fountain_gives_and_takes_as_many, no_gl_errors),
        cmocka_unit_test_teardown(as_many_come_and_go, no_gl_errors),
        cmocka_unit_test_teardown(scenes_stay_with_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(the_bound_holds, no_gl_errors),
        cmocka_unit_test_teardown(nothing_comes_where_something_is, no_gl_errors),
        cmocka_unit_test_teardown(a_wide_layer_comes_in_parts, no_gl_errors),
        cmocka_unit_test_teardown(the_state_goes_to_and_fro, no_gl_errors),
        cmocka_unit_test_teardown(going_back_takes_back_what_came, no_gl_errors),
        cmocka_unit_test_teardown(drains_count_behind_a_blow_up, no_gl_errors),
        cmocka_unit_test_teardown(nothing_is_read_back, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_flow", tests, compare_setup, context_teardown);
}
