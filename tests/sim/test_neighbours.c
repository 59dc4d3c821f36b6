/* The grid search, the pair sums and the order of particles against brute force over all pairs. */
#include "tests/lists.h"

#include "fixture.h"

#include "sim/kernel/kernel.h"
#include "sim/methods/mueller/mueller.h"

typedef struct Cloud {
    size_t count;
    float *position;
} Cloud;

typedef void (*CloudMaker)(float *position, size_t count, const double box[3]);

static void make_random(float *x, size_t count, const double box[3])
{
    uint32_t seed = 7;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            x[3 * i + (size_t)k] = (float)((fixture_random(&seed) - (k == 1 ? 0 : 0.5)) * box[k]);
}

/* Everything within two support radii, on both sides of a corner of cells. */
static void make_clustered(float *x, size_t count, const double box[3])
{
    make_random(x, count, (double[3]){box[0] * 0.2, box[1] * 0.2, box[2] * 0.2});
}

static void make_wall_hugging(float *x, size_t count, const double box[3])
{
    make_random(x, count, box);
    for (size_t i = 0; i < count; i++) {
        const size_t axis = i % 3;
        const bool high = i / 3 % 2;
        const double half = 0.5 * box[axis];
        x[3 * i + axis] = (float)(axis == 1 ? (high ? box[1] : 0) : (high ? half : -half));
    }
}

static void make_coincident(float *x, size_t count, const double box[3])
{
    make_random(x, count, box);
    for (size_t i = 1; i < count; i += 2)
        memcpy(x + 3 * i, x + 3 * (i - 1), 3 * sizeof *x);
}

static const struct {
    const char *name;
    CloudMaker make;
} clouds[] = {
    {"random", make_random},
    {"clustered", make_clustered},
    {"wall-hugging", make_wall_hugging},
    {"coincident", make_coincident},
};

static double brute_neighbours(const float *x, size_t count, float h)
{
    size_t pairs = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            const float dx = x[3 * i] - x[3 * j], dy = x[3 * i + 1] - x[3 * j + 1],
                        dz = x[3 * i + 2] - x[3 * j + 2];
            pairs += i != j && dx * dx + dy * dy + dz * dz < h * h;
        }
    return (double)pairs / (double)count;
}

/* Also boxes of one, two and a few cells along x, where rows of cells touch. */
static void neighbours_equal_brute_force(void **state)
{
    (void)state;
    const double widths[] = {0.15, 0.3, 2.3};
    enum { COUNT = 1200 };
    float *x = malloc(3 * COUNT * sizeof *x);
    for (int w = 0; w < 3; w++)
        for (int c = 0; c < 4; c++) {
            if (fixture_on_fragment() && (w < 2 || c == 1))
                continue; /* hundreds of particles a cell are more than its grid has places for */
            WorldDef def = fixture_def(widths[w], 1.1, 0.9);
            fixture_layers(&def, 20);
            InitialState initial = {.count = COUNT, .position = x};
            clouds[c].make(x, COUNT, def.box_size);
            def.initial = &initial;
            World *world = fixture_world(&def);
            WorldSums sums;
            world_sums(world, &sums);
            const double expected = brute_neighbours(x, COUNT, (float)(def.support * def.spacing));
            if (sums.neighbours_mean != expected)
                fail_msg("%s, width %g: %.6f neighbours, brute force finds %.6f", clouds[c].name, widths[w],
                         sums.neighbours_mean, expected);
            world_destroy(world);
        }
    free(x);
}

/* Far from the walls the density is that of the sum of W over all particles, calibrated. */
static void density_equals_brute(const char *name)
{
    const Kernel *kernel = density_kernel_find(name);
    WorldDef def = fixture_def(4, 4, 4);
    strcpy(mueller_def(&def)->density_kernel, name);
    enum { COUNT = 1500 };
    float x[3 * COUNT];
    make_random(x, COUNT, (double[3]){1.5, 1.5, 1.5});
    for (size_t i = 0; i < COUNT; i++)
        x[3 * i + 1] += 1;
    def.initial = &(InitialState){.count = COUNT, .position = x};
    World *world = fixture_world(&def);
    State s = fixture_read(world);

    const double h = def.support * def.spacing;
    Lattice lattice; /* tested in test_kernel.c */
    lattice_calibrate(3, def.spacing, h, kernel, &density_kernels[0], &lattice);
    double worst = 0;
    size_t worst_id = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double sum = 0;
        for (size_t j = 0; j < COUNT; j++) {
            const double dx = x[3 * i] - x[3 * j], dy = x[3 * i + 1] - x[3 * j + 1],
                         dz = x[3 * i + 2] - x[3 * j + 2];
            sum += kernel->value(sqrt(dx * dx + dy * dy + dz * dz), h);
        }
        const double n = sum * lattice.density_scale / lattice.number_density;
        const double error = fabs(s.density[i] / 1000 - (1 + lattice.stiffness_scale * (n - 1)));
        if (error > worst) {
            worst = error;
            worst_id = i;
        }
    }
    if (worst > 1e-5)
        fail_msg("%s: density of particle %zu is off by %g of the rest density", name, worst_id, worst);
    fixture_free(&s);
    world_destroy(world);
}

static void density_equals_brute_force(void **state)
{
    (void)state;
    density_equals_brute("spiky");
    density_equals_brute("poly6");
}

/* A coincident pair parts, to opposite sides, and the same way every time. */
static void coincident_pair_parts(void **state)
{
    (void)state;
    float x[2][3];
    for (int run = 0; run < 2; run++) {
        WorldDef def = fixture_def(4, 4, 4);
        def.spacing = 0.1;
        def.sound_speed = 10;
        memset(def.gravity, 0, sizeof def.gravity);
        /* a dense cluster, so that there is a pressure to part them */
        enum { COUNT = 64 };
        float p[3 * COUNT];
        uint32_t seed = 3;
        for (size_t i = 0; i < 3 * COUNT; i++)
            p[i] = (float)(0.1 * fixture_random(&seed)) + (i % 3 == 1 ? 2.0f : 0.0f);
        memcpy(p + 3, p, 3 * sizeof *p);
        def.initial = &(InitialState){.count = COUNT, .position = p};
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        State s = fixture_read(world);
        for (int k = 0; k < 3; k++)
            x[run][k] = s.velocity[k] - s.velocity[4 + k];
        fixture_free(&s);
        world_destroy(world);
    }
    assert_true(fabsf(x[0][0]) + fabsf(x[0][1]) + fabsf(x[0][2]) > 1e-3f);
    assert_memory_equal(x[0], x[1], sizeof x[0]);
}

/* Two runs that differ in the order in which the same particles are numbered agree to rounding only; the same
   run with any number of threads and any instruction set agrees to the bit. */
static uint64_t hash_after(const WorldDef *def, int threads, const char *simd)
{
    if (simd)
        setenv("SLOSH_SIMD", simd, 1);
    else
        unsetenv("SLOSH_SIMD");
    WorldDef with = *def;
    *world_threads(&with) = threads;
    World *world = fixture_world(&with);
    fixture_step(world, fixture_count(60, 30));
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    unsetenv("SLOSH_SIMD");
    return hash;
}

static WorldDef collapsing_column(void)
{
    WorldDef def = fixture_def(3, 1.5, 0.8);
    def.spacing = fixture_coarse(0.05, 0.1);
    def.fluids[0].viscosity = 2;
    def.fluid_count = 2;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 800, .viscosity = 10};
    fixture_block(&def, 0, -1.5, 0, -0.4, -0.5, 0.6, 0.4);
    fixture_block(&def, 1, -1.5, 0.6, -0.4, -0.5, 1.2, 0.4);
    add_motion(&def, (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 10, .frequency = 1});
    return def;
}

static void equal_bits_for_any_threads_and_simd(void **state)
{
    (void)state;
    const WorldDef def = collapsing_column();
    const uint64_t one = hash_after(&def, 1, NULL);
    assert_int_not_equal(one, 0);
    const int threads[] = {2, 3, 8};
    for (int i = 0; fixture_on_cpu() && i < 3; i++)
        assert_int_equal(hash_after(&def, threads[i], NULL), one);
    assert_int_equal(hash_after(&def, 2, NULL), one); /* and from run to run */
    if (fixture_on_cpu())
        assert_int_equal(hash_after(&def, 2, "baseline"), one);
}

/* The bits of a run without libm, on every x86-64 with this compiler family. A change of the solver's
   arithmetic changes the bits: check the change, then write the new number here. */
static void golden_hash(void **state)
{
    (void)state;
    fixture_needs_cpu("the golden bits are those of its sums");
    WorldDef def = collapsing_column();
    def.motion_count = 0;
    const uint64_t golden = 0xe4855f437fa9cca9;
    const uint64_t hash = hash_after(&def, 2, NULL);
    if (hash != golden)
        fail_msg("the state's hash is 0x%016llx, not 0x%016llx", (unsigned long long)hash,
                 (unsigned long long)golden);
}

static void an_unknown_set_is_refused(void **state)
{
    (void)state;
    Error error;
    WorldDef def = fixture_def(0.5, 0.5, 0.5);
    fixture_block(&def, 0, -1, 0, -1, 1, 0.3, 1);
    fixture_needs_cpu("sets of instructions are the CPU's");
    setenv("SLOSH_SIMD", "nonsense", 1);
    assert_null(world_create(&def, &error));
    assert_string_equal(error.message, "SLOSH_SIMD is 'nonsense'; auto, avx2 and baseline are there");
    unsetenv("SLOSH_SIMD");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_equal_brute_force),
        cmocka_unit_test(density_equals_brute_force),
        cmocka_unit_test(coincident_pair_parts),
        cmocka_unit_test(equal_bits_for_any_threads_and_simd),
        cmocka_unit_test(golden_hash),
        cmocka_unit_test(an_unknown_set_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
