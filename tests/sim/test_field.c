/* The field on a grid against its sum over all particles in double, particle by particle. */
#include "fixture.h"

#include "sim/kernel/kernel.h"
#include "sim/mesh.h"

enum { COUNT = 500 };

typedef struct Cloud {
    float position[4 * COUNT], scalar[COUNT];
} Cloud;

/* Particles of about the volume that they take up, in a box of a metre around the origin. */
static FieldParticles some_particles(Cloud *cloud, double support)
{
    uint32_t seed = 7;
    for (size_t i = 0; i < COUNT; i++) {
        for (size_t k = 0; k < 3; k++)
            cloud->position[4 * i + k] = (float)(fixture_random(&seed) - 0.5);
        cloud->position[4 * i + 3] = (float)(1.0 / COUNT * (0.5 + fixture_random(&seed)));
        cloud->scalar[i] = (float)(20 * fixture_random(&seed) - 10);
    }
    return (FieldParticles){COUNT, cloud->position, cloud->scalar, support};
}

static float *new_values(const VolumeGrid *grid)
{
    float *values = malloc(volume_grid_cells(grid) * sizeof *values);
    for (size_t i = 0; i < volume_grid_cells(grid); i++)
        values[i] = NAN; /* that the sum must set */
    return values;
}

static void sum(const FieldParticles *particles, const VolumeGrid *grid, int threads, float *field,
                float *weighted)
{
    Error error = {0};
    FieldSlabs slabs = {0};
    if (!field_sum(particles, grid, threads, &slabs, field, weighted, &error))
        fail_msg("%s", error.message);
    field_slabs_free(&slabs);
}

static void assert_like_brute_force(const FieldParticles *particles, const VolumeGrid *grid,
                                    const float *field, const float *weighted)
{
    size_t at = 0;
    for (int k = 0; k < grid->size[2]; k++)
        for (int j = 0; j < grid->size[1]; j++)
            for (int i = 0; i < grid->size[0]; i++, at++) {
                const int index[3] = {i, j, k};
                double r[3], by_scalar;
                for (int axis = 0; axis < 3; axis++)
                    r[axis] = grid->corner[axis] + grid->cell * (index[axis] + 0.5);
                const double value = field_at(particles, r, &by_scalar);
                if (!(fabs(field[at] - value) < 3e-6) || !(fabs(weighted[at] - by_scalar) < 3e-5))
                    fail_msg("value %d %d %d: %g and %g, not %g and %g", i, j, k, (double)field[at],
                             (double)weighted[at], value, by_scalar);
            }
}

/* Around the particles, cutting particles, beside, coarse, a single cell, long, and cells far smaller
   than h. */
static void each_value_is_the_sum_over_all_particles(void **state)
{
    (void)state;
    static const VolumeGrid grids[] = {
        {{33, 35, 37}, {-0.8, -0.85, -0.9}, 0.05},
        {{20, 9, 13}, {-0.1, 0.2, -0.7}, 0.03},
        {{4, 4, 4}, {3, 0, 0}, 0.1},
        {{3, 2, 2}, {-1, -1, -1}, 0.9},
        {{1, 1, 1}, {-0.05, -0.05, -0.05}, 0.1},
        {{5, 3, 90}, {-0.05, -0.05, -0.9}, 0.02},
        {{699, 2, 3}, {-0.35, -0.05, 0.1}, 0.001},
    };
    Cloud cloud;
    const FieldParticles particles = some_particles(&cloud, 0.21);
    for (size_t g = 0; g < sizeof grids / sizeof *grids; g++) {
        float *field = new_values(&grids[g]), *weighted = new_values(&grids[g]);
        sum(&particles, &grids[g], 2, field, weighted);
        assert_like_brute_force(&particles, &grids[g], field, weighted);
        memset(field, 0xff, volume_grid_cells(&grids[g]) * sizeof *field);
        sum(&particles, &grids[g], 2, NULL, field);
        assert_memory_equal(field, weighted, volume_grid_cells(&grids[g]) * sizeof *field);
        sum(&particles, &grids[g], 2, field, NULL);
        sum(&particles, &grids[g], 1, weighted, NULL);
        assert_memory_equal(field, weighted, volume_grid_cells(&grids[g]) * sizeof *field);
        free(field);
        free(weighted);
    }
}

static void threads_and_what_was_summed_before_change_no_bit(void **state)
{
    (void)state;
    static const VolumeGrid grid = {{40, 41, 42}, {-0.9, -0.9, -0.9}, 0.045},
                            small = {{3, 3, 3}, {0, 0, 0}, 0.1};
    Cloud cloud;
    const FieldParticles particles = some_particles(&cloud, 0.3);
    FieldSlabs slabs = {0};
    float *one = new_values(&grid), *many = new_values(&grid), *few = new_values(&small);
    assert_true(field_sum(&particles, &grid, 1, &slabs, one, NULL, NULL));
    assert_true(field_sum(&particles, &small, 3, &slabs, few, NULL, NULL));
    assert_true(field_sum(&particles, &grid, 5, &slabs, many, NULL, NULL));
    assert_memory_equal(one, many, volume_grid_cells(&grid) * sizeof *one);
    field_slabs_free(&slabs);
    free(one);
    free(many);
    free(few);
}

/* The sum of the values times a cell's volume, of a grid with a margin of h around the particles. */
static void the_integral_is_the_fluids_volume(void **state)
{
    (void)state;
    static const VolumeGrid grid = {{64, 64, 64}, {-0.8, -0.8, -0.8}, 0.025};
    Cloud cloud;
    const FieldParticles particles = some_particles(&cloud, 0.25);
    double volume = 0, integral = 0;
    float *field = new_values(&grid);
    sum(&particles, &grid, 2, field, NULL);
    for (size_t i = 0; i < COUNT; i++)
        volume += cloud.position[4 * i + 3];
    for (size_t i = 0; i < volume_grid_cells(&grid); i++)
        integral += field[i] * 0.025 * 0.025 * 0.025;
    assert_true(fabs(integral / volume - 1) < 1e-4);
    free(field);
}

/* A lattice of volume spacing^3 each: 1 inside, 0.5 at the face half a spacing above its last layer. */
static void a_lattice_has_one_inside_and_a_half_at_its_face(void **state)
{
    (void)state;
    enum { SIDE = 9 };
    static float position[4 * SIDE * SIDE * SIDE];
    for (size_t i = 0; i < SIDE * SIDE * SIDE; i++) {
        const size_t row = i / SIDE, slice = row / SIDE;
        const float p[4] = {0.1F * (float)(i % SIDE), 0.1F * (float)(row % SIDE), 0.1F * (float)slice,
                            0.001F};
        memcpy(position + 4 * i, p, sizeof p);
    }
    const FieldParticles particles = {SIDE * SIDE * SIDE, position, NULL, 0.21};
    assert_true(fabs(field_at(&particles, (double[]){0.4, 0.4, 0.4}, NULL) - 1) < 0.02);
    assert_true(fabs(field_at(&particles, (double[]){0.4, 0.85, 0.4}, NULL) - 0.5) < 0.03);
    assert_true(field_at(&particles, (double[]){0.4, 1.02, 0.4}, NULL) == 0);
}

static void what_is_not_finite_is_left_out(void **state)
{
    (void)state;
    static const VolumeGrid grid = {{8, 8, 8}, {-0.4, -0.4, -0.4}, 0.1};
    float position[6][4] = {{0.1F, 0, 0, 0.001F}, {NAN, 0, 0, 0.001F},    {0, INFINITY, 0, 0.001F},
                            {0, 0, 0, NAN},       {0, 0, -1e30F, 0.001F}, {0, 0, 0, 0.001F}};
    const float scalar[6] = {1, 1, 1, 1, 1, NAN};
    FieldParticles particles = {6, position[0], scalar, 0.2};
    double low[3], high[3];
    float *field = new_values(&grid), *weighted = new_values(&grid);
    sum(&particles, &grid, 2, field, weighted);
    particles.count = 1;
    assert_like_brute_force(&particles, &grid, field, weighted);
    assert_true(field_bounds(&particles, low, high));
    assert_true(low[0] == (double)0.1F && high[0] == low[0] && low[2] == 0 && high[1] == 0);
    particles.count = 6;
    assert_true(field_bounds(&particles, low, high));
    assert_true(low[2] == (double)-1e30F && high[0] == (double)0.1F && low[0] == 0);
    free(field);
    free(weighted);
}

static void no_particles_make_a_field_of_zeros(void **state)
{
    (void)state;
    static const VolumeGrid grid = {{9, 9, 9}, {0, 0, 0}, 0.1};
    const FieldParticles none = {.support = 0.2};
    double low[3], high[3];
    float *field = new_values(&grid);
    sum(&none, &grid, 2, field, NULL);
    for (size_t i = 0; i < volume_grid_cells(&grid); i++)
        assert_true(field[i] == 0);
    assert_false(field_bounds(&none, low, high));
    free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_value_is_the_sum_over_all_particles),
        cmocka_unit_test(threads_and_what_was_summed_before_change_no_bit),
        cmocka_unit_test(the_integral_is_the_fluids_volume),
        cmocka_unit_test(a_lattice_has_one_inside_and_a_half_at_its_face),
        cmocka_unit_test(what_is_not_finite_is_left_out),
        cmocka_unit_test(no_particles_make_a_field_of_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
