/* The acceleration kept by a world, on each backend with support: against free flight and rest, against
   velocities before and after a step, over saved states, and in pictures. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "render/particles/particles.h"
#include "sim/state.h"

static const char *const backends[] = {"cpu", "compute"};

/* In the order of ids: x y z of each. */
static float *accelerations(World *world, size_t *count)
{
    const WorldInfo info = info_of(world);
    float *all = malloc(3 * info.count * sizeof *all), *one = malloc(info.count * sizeof *one);
    uint32_t *id = malloc(info.count * sizeof *id);
    for (int k = 0; k < 3; k++) {
        ParticleArrays out = {.id = id};
        out.scalar[SCALAR_ACCELERATION_X + k] = one;
        assert_true(world_read(world, &out));
        for (size_t i = 0; i < info.count; i++)
            all[3 * id[i] + (size_t)k] = one[i];
    }
    free(one);
    free(id);
    *count = info.count;
    return all;
}

static void none_is_known(World *world)
{
    size_t count;
    float *a = accelerations(world, &count);
    for (size_t i = 0; i < 3 * count; i++)
        assert_true(isnan(a[i]));
    free(a);
}

static WorldDef def_of(const char *backend, const char *method)
{
    WorldDef def = fixture_def(2, 2, 2);
    *world_threads(&def) = 1;
    def.acceleration = true;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    snprintf(def.method, sizeof def.method, "%s", method);
    return def;
}

/* Particles without neighbours. */
static const float places[] = {-0.5F, 1, 0, 0.5F, 1.2F, 0, 0, 1.5F, 0.5F};
static const InitialState lone = {.count = 3, .position = places};

static void what_falls_has_that_of_gravity(void **state)
{
    (void)state;
    for (int b = 0; b < 2; b++)
        for (int m = 0; m < 4; m++) {
            WorldDef def = def_of(backends[b], fixture_method_names[m]);
            size_t count;
            def.initial = &lone;
            World *world = fixture_world(&def);
            none_is_known(world);
            fixture_step(world, 3);
            float *a = accelerations(world, &count);
            for (size_t i = 0; i < count; i++)
                assert_true(fabsf(a[3 * i]) + fabsf(a[3 * i + 2]) < 1e-4F &&
                            fabsf(a[3 * i + 1] + 9.81F) < 1e-3F);
            free(a);
            world_destroy(world);
        }
}

/* At rest in a box that turns by w: w^2 times the way from the axis, outwards. */
static void what_rests_in_a_turning_box_flies_outwards(void **state)
{
    (void)state;
    for (int b = 0; b < 2; b++) {
        WorldDef def = def_of(backends[b], "mueller");
        size_t count;
        def.initial = &lone;
        def.gravity[1] = 0;
        def.dt = 1e-4;
        add_motion(&def, (Motion){.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 0.5});
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        const WorldInfo info = info_of(world);
        const double w = info.box.angular_velocity[2];
        assert_true(fabs(w) > 0.1);
        float *a = accelerations(world, &count);
        for (size_t i = 0; i < count; i++) {
            const double x = (double)places[3 * i],
                         y = (double)places[3 * i + 1] - 1; /* turns about the centre */
            assert_true(fabs((double)a[3 * i] - w * w * x) < 2e-3 * w * w);
            assert_true(fabs((double)a[3 * i + 1] - w * w * y) < 2e-3 * w * w);
            assert_true(fabsf(a[3 * i + 2]) < 1e-4F);
        }
        free(a);
        world_destroy(world);
    }
}

static WorldDef tank(const char *backend, const char *method)
{
    WorldDef def = def_of(backend, method);
    def.box_size[0] = def.box_size[2] = 0.4;
    def.box_size[1] = 0.6;
    def.spacing = 0.05;
    def.sound_speed = 20;
    def.dt = 0.001;
    fixture_block(&def, 0, -0.2, 0, -0.2, 0, 0.4, 0.2);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 1});
    return def;
}

/* Whatever the order of particles was. */
static void it_is_what_velocities_change_by(void **state)
{
    (void)state;
    for (int b = 0; b < 2; b++)
        for (int m = 0; m < 4; m++) {
            WorldDef def = tank(backends[b], fixture_method_names[m]);
            size_t count;
            def.fluids[0].velocity[0] = 1, def.fluids[0].velocity[2] = 0.5; /* from cell to cell */
            World *world = fixture_world(&def);
            fixture_step(world, 15);
            State before = fixture_read(world);
            fixture_step(world, 1);
            State after = fixture_read(world);
            float *a = accelerations(world, &count);
            for (size_t i = 0; i < count; i++)
                for (size_t k = 0; k < 3; k++) {
                    const float change =
                        (after.velocity[4 * i + k] - before.velocity[4 * i + k]) / (float)def.dt;
                    assert_true(fabsf(a[3 * i + k] - change) <= 1e-6F * fabsf(change));
                }
            free(a);
            fixture_free(&before);
            fixture_free(&after);
            world_destroy(world);
        }
}

/* In the mean, over the weight; the walls hold all of it. */
static void what_rests_has_none(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        WorldDef def = tank("cpu", fixture_method_names[m]);
        size_t count;
        double sum = 0;
        own_fills(&def.fluids[0])->max[0] = 0.2;
        def.fluids[0].start = START_HYDROSTATIC;
        def.motion_count = 0;
        World *world = fixture_world(&def);
        fixture_step(world, 400);
        float *a = accelerations(world, &count);
        for (size_t i = 0; i < count; i++)
            sum += (double)a[3 * i + 1];
        printf("%s: %.4f g\n", fixture_method_names[m], sum / (double)count / 9.81);
        assert_true(fabs(sum / (double)count) < 0.05 * 9.81);
        free(a);
        world_destroy(world);
    }
}

static void same_accelerations(World *one, World *other)
{
    size_t count, others;
    float *a = accelerations(one, &count), *b = accelerations(other, &others);
    assert_true(count == others);
    assert_memory_equal(a, b, 3 * count * sizeof *a);
    free(a);
    free(b);
}

/* Columns of a saved state continue; missing columns are unknown before the next step. Bits of particles
   do not depend on observers. */
static void states_have_it(void **state)
{
    (void)state;
    Error error = {{0}};
    for (int b = 0; b < 2; b++) {
        WorldDef def = tank(backends[b], "wcsph"), blind;
        def.reproducible = true; /* a GPU else sorts as it comes */
        blind = def;
        blind.acceleration = false;
        World *kept = fixture_world(&def), *late = fixture_world(&blind), *loaded = fixture_world(&def);
        WorldState saved = {.count = 0}, without = {.count = 0};
        fixture_step(kept, 5);
        fixture_step(late, 5);
        assert_true(world_hash(kept) == world_hash(late));
        assert_true(world_save(kept, &saved, &error) && world_load(loaded, &saved, &error));
        same_accelerations(kept, loaded);
        assert_true(world_save(late, &without, &error) && world_load(loaded, &without, &error));
        none_is_known(loaded);
        none_is_known(late);
        assert_true(world_keep_acceleration(late, &error));
        none_is_known(late);
        fixture_step(kept, 3);
        fixture_step(late, 3);
        fixture_step(loaded, 3);
        assert_true(world_hash(kept) == world_hash(late));
        same_accelerations(kept, late);
        same_accelerations(kept, loaded);
        world_state_free(&saved);
        world_state_free(&without);
        world_destroy(kept);
        world_destroy(late);
        world_destroy(loaded);
    }
}

/* Requested within a frame of too long steps: a GPU's trouble is still undetected, and the sentinel goes
   back to the frame's begin. */
static void a_state_in_trouble_is_not_gone_back_to(void **state)
{
    (void)state;
    WorldDef def = tank("compute", "mueller");
    Error error = {{0}};
    def.acceleration = false;
    def.retries = 3;
    def.dt = 0.4;
    def.substeps = 4;
    World *world = fixture_world(&def);
    for (int i = 0; i < 2; i++)
        assert_true(world_substep(world, NULL, &error));
    assert_true(world_keep_acceleration(world, &error));
    for (int i = 0; i < 20 && info_of(world).trouble.count == 0; i++)
        if (!world_substep(world, NULL, &error))
            fail_msg("%s", error.message);
    assert_int_equal(info_of(world).trouble.count, 1);
    assert_true(info_of(world).trouble.back_to == 0);
    world_destroy(world);
}

static void read_back(const ParticleAttribute *from, size_t count, float *to)
{
    assert_true(from->buffer);
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride), to);
}

/* Length and components belong to the same particle, and equal the values read. */
static void pictures_get_it(void **state)
{
    (void)state;
    const ParticleWants wants = {.scalars = SCALAR_BIT(SCALAR_ACCELERATION),
                                 .vectors = VECTOR_BIT(VECTOR_ACCELERATION),
                                 .attributes = PARTICLE_ID};
    const DerivedSpace space = {.flat = false};
    const WorldDef def = tank("compute", "dfsph");
    Error error = {{0}};
    Derived derived = {0};
    ParticleBuffers shared;
    size_t count;
    World *world = fixture_world(&def);
    fixture_step(world, 5);
    float *a = accelerations(world, &count), *length = malloc(4 * count), *vector = malloc(16 * count);
    uint32_t *id = malloc(4 * count);
    world_share(world, particle_wants_attributes(&wants), &shared);
    assert_true(derived_update(&derived, &wants, &error));
    derived_fill(&derived, &wants, &space, &shared);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    read_back(&shared.id, count, (float *)id);
    read_back(&shared.scalar[SCALAR_ACCELERATION], count, length);
    read_back(&shared.vector[VECTOR_ACCELERATION], count, vector);
    for (size_t i = 0; i < count; i++) {
        const float *read = a + 3 * id[i], *v = vector + 4 * i;
        assert_memory_equal(read, v, 3 * sizeof *v);
        assert_true(fabsf(length[i] - sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) <= 1e-6F * length[i]);
    }
    derived_destroy(&derived);
    world_destroy(world);
    free(a);
    free(id);
    free(length);
    free(vector);
}

static void fragment_has_none(void **state)
{
    (void)state;
    Error error = {{0}};
    const WorldDef def = tank("fragment", "mueller");
    assert_false(world_can(&def, &error));
    assert_non_null(strstr(error.message, "backend fragment has no acceleration"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(what_falls_has_that_of_gravity, no_gl_errors),
        cmocka_unit_test_teardown(what_rests_in_a_turning_box_flies_outwards, no_gl_errors),
        cmocka_unit_test_teardown(it_is_what_velocities_change_by, no_gl_errors),
        cmocka_unit_test_teardown(what_rests_has_none, no_gl_errors),
        cmocka_unit_test_teardown(states_have_it, no_gl_errors),
        cmocka_unit_test_teardown(a_state_in_trouble_is_not_gone_back_to, no_gl_errors),
        cmocka_unit_test_teardown(pictures_get_it, no_gl_errors),
        cmocka_unit_test(fragment_has_none),
    };
    return cmocka_run_group_tests(tests, compare_setup, context_teardown);
}
