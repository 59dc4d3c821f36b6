/* The backend `compute` against `cpu`, from the same states. */
#include "tests/gl/parity.h"
#include "tests/lists.h"

#include "sim/gpu/compute/compute.h"

#include <epoxy/gl.h>

static void steps_are_those_of_the_cpu(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = stirred_def(dimensions);
        def.reproducible = dimensions == 3;
        if (dimensions == 2)
            for_layers(&def);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        fixture_step(cpu, 150);
        copy_state(cpu, gpu);
        compare_step("mueller, two viscous fluids", cpu, gpu);
        compare_run(&def, "  mueller", cpu, gpu, 200);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

static void a_run_is_the_same_each_time(void **state)
{
    (void)state;
    check_same_each_time(stirred_def(3), "compute", 50);
}

static void save_load_step_is_step(void **state)
{
    (void)state;
    check_save_load_step(stirred_def(2), "compute", 30);
}

static void prefix_sums(void **state)
{
    (void)state;
    static const size_t sizes[] = {0, 1, 63, 64, 65, 1023, 1024, 1025, 100000, 1100000};
    WorldDef def = stirred_def(2);
    def.box_size[0] = def.box_size[1] =
        60; /* with places for so many, room for the largest in its block totals */
    def.most = 300000;
    add_emit(&def.fluids[0], (Emit){.centre = {0, 30}, .direction = {0, -1}, .radius = 0.1, .speed = 1});
    def.gravity[1] = 0;
    World *world = world_on(def, "compute");
    Compute *compute = world->state;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const size_t n = sizes[s];
        uint32_t *values = calloc(n + 1, sizeof *values), *sums = calloc(n + 1, sizeof *sums), seed = 5;
        unsigned buffer;
        for (size_t i = 0; i < n; i++)
            values[i] = (uint32_t)(8 * fixture_random(&seed));
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, (GLsizeiptr)(4 * n + 4), values, GL_DYNAMIC_STORAGE_BIT);
        compute_scan(compute, buffer, n);
        glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(4 * n), sums);
        uint32_t sum = 0;
        for (size_t i = 0; i < n; i++) {
            if (sums[i] != sum)
                fail_msg("of %zu numbers, the sum before number %zu is %u, not %u", n, i, sums[i], sum);
            sum += values[i];
        }
        glDeleteBuffers(1, &buffer);
        free(values);
        free(sums);
    }
    world_destroy(world);
}

/* Ids in the backend's sorted order, with densities; freed by the caller. */
static float *sorted(World *world, uint32_t **id)
{
    const size_t n = info_of(world).count;
    float *density = malloc(4 * n + 1);
    *id = malloc(4 * n + 1);
    ParticleArrays out = {.id = *id};
    out.scalar[SCALAR_DENSITY] = density;
    world_read(world, &out);
    return density;
}

static void compare_sorted(World *cpu, World *gpu)
{
    const size_t n = info_of(cpu).count;
    uint32_t *a, *b;
    float *one = sorted(cpu, &a), *other = sorted(gpu, &b);
    assert_int_equal(info_of(gpu).count, n);
    for (size_t i = 0; i < n; i++) {
        if (a[i] != b[i])
            fail_msg("of %zu particles, number %zu is %u, not %u", n, i, b[i], a[i]);
        if (!(fabsf(one[i] / other[i] - 1) < 1e-5F))
            fail_msg("of %zu particles, %u has the density %g, not %g", n, a[i], (double)other[i],
                     (double)one[i]);
    }
    free(a);
    free(b);
    free(one);
    free(other);
}

static void swap_bits(void *column, size_t i, size_t j)
{
    uint32_t *values = column, kept = values[i];
    values[i] = values[j];
    values[j] = kept;
}

/* The same particles, at rest, in the opposite order. */
static void reverse(World *world)
{
    WorldState saved = {0};
    Error error;
    if (!world_save(world, &saved, &error))
        fail_msg("%s", error.message);
    const ParticleColumns *p = &saved.particles;
    for (size_t i = 0, j = saved.count - 1; i < j; i++, j--) {
        void *const columns[] = {p->x, p->y, p->z};
        const ParticleId id = p->id[i];
        p->id[i] = p->id[j];
        p->id[j] = id;
        for (size_t k = 0; k < sizeof columns / sizeof *columns; k++)
            swap_bits(columns[k], i, j);
    }
    if (!world_load(world, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

/* A number of particles at random places in a cube, sorted by each backend, from two orders and after a
   step. */
static void compare_sort(size_t count, double width)
{
    float *x = malloc(12 * count);
    uint32_t seed = (uint32_t)count;
    const double side =
        fmax(0.3, width + 0.01); /* in shared cells, the two backends would sort by different keys */
    WorldDef def = fixture_def(side, side, side);
    *world_threads(&def) = 1;
    def.dt = 1e-6;
    for (size_t i = 0; i < 3 * count; i++)
        x[i] = (float)(0.005 + width * fixture_random(&seed) - (i % 3 == 1 ? 0 : 0.5 * side));
    def.initial = &(InitialState){.count = count, .position = x};
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    compare_sorted(cpu, gpu);
    reverse(gpu);
    compare_sorted(cpu, gpu);
    fixture_step(cpu, 1);
    fixture_step(gpu, 1);
    compare_sorted(cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
    free(x);
}

/* Counts around a thread group's size, all in a cell of 0.21 m or spread. */
static void it_sorts_as_the_cpu_does(void **state)
{
    (void)state;
    static const size_t sizes[] = {1, 63, 64, 65, 1200};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        compare_sort(sizes[s], 0.2);
        compare_sort(sizes[s], 0.95);
    }
}

/* A drained world continues, and accepts new fluid. */
static void no_particle_at_all(void **state)
{
    (void)state;
    WorldDef def = fixture_def(2, 1, 1);
    fixture_block(&def, 0, -1, 0, -0.5, -0.5, 0.5, 0.5);
    add_emit(&def.fluids[0],
             (Emit){.centre = {0, 0.5, 0}, .direction = {1, 0, 0}, .radius = 0.2, .speed = 2, .start = 0.02});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {-1, 0, -0.5}, .max = {-0.25, 1, 0.5}});
    def.most = 1000;
    *world_threads(&def) = 1;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    assert_true(info_of(gpu).count > 100);
    fixture_step(cpu, 5);
    fixture_step(gpu, 5);
    WorldSums sums;
    world_sums(gpu, &sums);
    assert_int_equal(info_of(gpu).count, 0);
    assert_true(sums.mass == 0 && sums.kinetic_energy == 0);
    compare_sorted(cpu, gpu);
    assert_true(world_hash(gpu) == world_hash(cpu));
    fixture_step(cpu, 80);
    fixture_step(gpu, 80);
    assert_true(info_of(gpu).count > 20);
    compare_sorted(cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

static WorldGauge gauge_of(World *world)
{
    WorldGauge gauge = {0};
    world_gauge_request(world);
    while (!world_gauge(world, &gauge))
        glFinish();
    return gauge;
}

/* What is plotted, of all particles of each group. */
static void gauges_are_those_of_the_cpu(void **state)
{
    (void)state;
    WorldDef def = stirred_def(3);
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    fixture_step(cpu, 20);
    copy_state(cpu, gpu);
    copy_state(cpu, cpu); /* densities belong to the old places */
    const WorldGauge is = gauge_of(gpu), wanted = gauge_of(cpu);
    assert_true(wanted.kinetic_energy > 0 && wanted.density_error_max > 0);
    assert_float_equal(is.kinetic_energy / wanted.kinetic_energy, 1, 1e-4);
    assert_float_equal(is.potential_energy / wanted.potential_energy, 1, 1e-4);
    assert_float_equal(is.compression_energy / wanted.compression_energy, 1, 1e-3);
    assert_float_equal(is.density_error_mean / wanted.density_error_mean, 1, 1e-3);
    assert_float_equal(is.density_error_max / wanted.density_error_max, 1, 1e-3);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* Whoever is the fastest in a work group: steps and the sentinel go by it. */
static double energy_now(World *world)
{
    EnergySums sums;
    world->backend->energy(world->state, true, &sums);
    return sums.own;
}

/* Energy asked for ahead is of the state now, whatever came since. */
static void energy_ahead_is_of_the_state_now(void **state)
{
    (void)state;
    const Backend *backend = &backend_compute;
    WorldDef def = stirred_def(3);
    def.retries = 3;
    World *world = world_on(def, "compute");
    WorldState saved = {0};
    Error error = {0};
    fixture_step(world, 20);
    const double before = energy_now(world);
    assert_true(world_save(world, &saved, &error));
    backend->energy_ahead(world->state);
    assert_true(energy_now(world) == before);

    backend->energy_ahead(world->state);
    backend->kick(world->state, (const float[3]){0, -10, 0}, 0.1F);
    const double kicked = energy_now(world);
    assert_true(fabs(kicked - before) > 0.1 * before);

    backend->energy_ahead(world->state);
    assert_true(world_load(world, &saved, &error));
    const double loaded = energy_now(world);
    assert_true(loaded == energy_now(world) && fabs(loaded - before) < 0.01 * before);
    world_state_free(&saved);
    world_destroy(world);
}

static void the_fastest_is_found(void **state)
{
    (void)state;
    enum { ROW = 128 };
    static float x[3 * ROW], v[3 * ROW];
    WorldDef def = fixture_def(0.3 * ROW, 1, 1);
    memset(def.gravity, 0, sizeof def.gravity);
    def.initial = &(InitialState){.count = ROW, .position = x, .velocity = v};
    for (int fastest = 5; fastest < ROW; fastest += 20) {
        for (int i = 0; i < ROW; i++) { /* alone, each in a separate cell, in cell order */
            x[3 * i] = (float)(0.3 * (i + 0.5 - 0.5 * ROW));
            x[3 * i + 1] = 0.5F;
            v[3 * i + 1] = i == fastest ? 2 : 1;
        }
        World *gpu = world_on(def, "compute");
        WorldNumbers numbers;
        fixture_step(gpu, 1);
        world_save_numbers(gpu, &numbers);
        if (fabs(numbers.stepping.max_speed - 2) > 1e-4)
            fail_msg("particle %d has 2 m/s, the greatest is said to be %g", fastest,
                     numbers.stepping.max_speed);
        world_destroy(gpu);
    }
}

static void what_it_cannot_do_is_said(void **state)
{
    (void)state;
    WorldDef def = stirred_def(2);
    Error error = {0};
    def.most = 40000000; /* with places for so many, more than 512 MiB; llvmpipe allows 128 */
    add_emit(&def.fluids[0], (Emit){.centre = {0, 1}, .direction = {0, -1}, .radius = 0.1, .speed = 1});
    snprintf(def.backend, sizeof def.backend, "compute");
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (most > 500000000)
        skip();
    assert_null(world_create(&def, &error));
    assert_non_null(strstr(error.message, "this driver allows shaders"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(prefix_sums, no_gl_errors),
        cmocka_unit_test_teardown(it_sorts_as_the_cpu_does, no_gl_errors),
        cmocka_unit_test_teardown(no_particle_at_all, no_gl_errors),
        cmocka_unit_test_teardown(steps_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(a_run_is_the_same_each_time, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
        cmocka_unit_test_teardown(gauges_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(energy_ahead_is_of_the_state_now, no_gl_errors),
        cmocka_unit_test_teardown(the_fastest_is_found, no_gl_errors),
        cmocka_unit_test_teardown(what_it_cannot_do_is_said, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute", tests, compare_setup, context_teardown);
}
