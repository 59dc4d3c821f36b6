/* The coarse level: its correction against a dense solution in double precision, of functions written down by
   nodes; the bits of a step on several threads; iterations in deep water. */
#include "tests/sim/fixture.h"

#include "sim/cpu/cpu.h"
#include "sim/methods/dfsph/dfsph.h"
#include "sim/step/world.h"
#include "tests/lists.h"

/* --- the correction --- */

enum { NODES_MOST = 400, PARTS = 1200 };

typedef struct Case {
    const char *name;
    int dimensions;
    int periodic; /* axis; -1: none */
    double box[3];
} Case;

/* Along a periodic axis the last coarse cell is three cells of the grid wide. */
static const Case cases[] = {
    {"plane", 2, -1, {2.3, 1.9, 0}}, {"space", 3, -1, {1.3, 1.1, 0.9}}, {"periodic", 2, 0, {2.4, 1.9, 0}}};
enum { CASES = sizeof cases / sizeof *cases };

/* Random numbers of the particles. */
typedef struct Parts {
    size_t count;
    float weight[PARTS], hold[PARTS], residual[PARTS], value[PARTS], before[PARTS];
} Parts;

/* Nodes along an axis, m. */
typedef struct Axis {
    int count;
    bool periodic;
    double x[40];
} Axis;

/* Two cells of the grid apart, the last two further if the cells are odd. */
static Axis axis_of(const Constants *constants, int k)
{
    const CellGrid *cells = &constants->cells;
    const int inner = cells->size[k] - 2, count = inner / 2 > 1 ? inner / 2 : 1;
    const double side = 1 / (double)cells->inverse[k],
                 low = (double)cells->origin[k] + side * (cells->first[k] + 1);
    Axis axis = {.count = k < constants->dimensions ? count + 1 : 1, .periodic = constants->periodic.axis[k]};
    for (int n = 0; n < axis.count; n++)
        axis.x[n] = low + side * (n < count ? 2 * n : inner);
    return axis;
}

/* The function of node n at x, and its slope, 1/m. */
static double hat(const Axis *axis, int n, double x, double *slope)
{
    const int last = axis->count - 1;
    *slope = 0;
    if (last == 0)
        return 1;
    double sum = 0;
    for (int c = 0; c < last; c++) {
        const double low = axis->x[c], high = axis->x[c + 1], part = (x - low) / (high - low);
        const int far = axis->periodic && c + 1 == last ? 0 : c + 1;
        if (x < low || x >= high)
            continue;
        sum += (n == c) * (1 - part) + (n == far) * part;
        *slope += ((n == far) - (n == c)) / (high - low);
    }
    return sum;
}

/* Of a node at a particle: the value and h times the slopes. */
static void node_at(const Axis axis[3], int node, const double x[3], double h, double out[4])
{
    double value[3], slope[3];
    for (int k = 0, rest = node; k < 3; rest /= axis[k].count, k++)
        value[k] = hat(&axis[k], rest % axis[k].count, x[k], &slope[k]);
    out[0] = value[0] * value[1] * value[2];
    for (int k = 0; k < 3; k++)
        out[1 + k] = h * slope[k] * value[(k + 1) % 3] * value[(k + 2) % 3];
}

static double matrix[NODES_MOST][NODES_MOST], right[NODES_MOST];

static void assemble(const World *world, const Axis axis[3], int nodes, const Parts *parts)
{
    static double of[NODES_MOST][4];
    const Cpu *cpu = world->state;
    const double h = (double)world->constants.support_radius;
    memset(matrix, 0, sizeof matrix);
    memset(right, 0, sizeof right);
    for (size_t i = 0; i < parts->count; i++) {
        const double x[3] = {(double)cpu->now.x[i], (double)cpu->now.y[i], (double)cpu->now.z[i]};
        for (int n = 0; n < nodes; n++)
            node_at(axis, n, x, h, of[n]);
        for (int n = 0; n < nodes; n++) {
            right[n] += (double)parts->residual[i] * of[n][0];
            for (int m = 0; m < nodes; m++)
                matrix[n][m] += (double)parts->hold[i] * of[n][0] * of[m][0] +
                                (double)parts->weight[i] *
                                    (of[n][1] * of[m][1] + of[n][2] * of[m][2] + of[n][3] * of[m][3]);
        }
    }
}

/* Gauss; a node without particles has a row of zeros, and stays 0. */
static void eliminate(int nodes)
{
    for (int p = 0; p < nodes; p++) {
        if (matrix[p][p] < 1e-12)
            continue;
        for (int n = 0; n < nodes; n++) {
            const double part = n == p ? 0 : matrix[n][p] / matrix[p][p];
            for (int m = p; part != 0 && m < nodes; m++)
                matrix[n][m] -= part * matrix[p][m];
            right[n] -= part * right[p];
        }
    }
    for (int n = 0; n < nodes; n++)
        right[n] = matrix[n][n] < 1e-12 ? 0 : right[n] / matrix[n][n];
}

/* A third of the particles have no weight. `hold`: the most of a fifth of them. */
static void parts_make(Parts *parts, size_t count, float hold)
{
    uint32_t seed = 7;
    assert_in_range(count, 100, PARTS);
    parts->count = count;
    for (size_t i = 0; i < count; i++) {
        parts->weight[i] = i % 3 ? (float)fixture_random(&seed) : 0;
        parts->hold[i] = i % 5 ? 0 : hold * (float)fixture_random(&seed);
        parts->residual[i] = (float)fixture_random(&seed) - 0.4F;
        parts->value[i] = parts->before[i] = 3 * (float)fixture_random(&seed) - 1;
    }
}

static World *world_of(const Case *c)
{
    WorldDef def = fixture_def(c->box[0], c->box[1], c->box[2]);
    strcpy(def.method, "dfsph");
    def.dimensions = c->dimensions;
    if (c->periodic >= 0)
        def.periodic[c->periodic] = true;
    const double half[3] = {c->box[0] / 2, 0, c->box[2] / 2};
    fixture_block(&def, 0, -half[0], 0, -half[2], half[0], 0.7 * c->box[1], half[2]);
    return fixture_world(&def);
}

static void compare(const World *world, const Axis axis[3], int nodes, const Parts *parts, bool negative)
{
    const Cpu *cpu = world->state;
    double worst = 0, most = 0;
    for (size_t i = 0; i < parts->count; i++) {
        const double x[3] = {(double)cpu->now.x[i], (double)cpu->now.y[i], (double)cpu->now.z[i]};
        double sum = 0, of[4];
        for (int n = 0; n < nodes; n++) {
            node_at(axis, n, x, 1, of);
            sum += of[0] * right[n];
        }
        double expected = (double)parts->before[i] + (parts->weight[i] > 0 ? 0.5 * sum : 0);
        if (!negative && parts->weight[i] > 0)
            expected = fmax(expected, 0);
        most = fmax(most, fabs(sum));
        worst = fmax(worst, fabs(expected - (double)parts->value[i]));
    }
    printf("off by %.2g of %.3g, %d nodes, %zu particles\n", worst, most, nodes, parts->count);
    assert_true(most > 0.05);
    assert_true(worst < 1e-5 * (1 + most));
}

static void corrections_are_those_of_all_particles(void **state)
{
    (void)state;
    for (int c = 0; c < 2 * CASES; c++) {
        static Parts parts;
        World *world = world_of(&cases[c / 2]);
        Cpu *cpu = world->state;
        const Axis axis[3] = {axis_of(&world->constants, 0), axis_of(&world->constants, 1),
                              axis_of(&world->constants, 2)};
        const int nodes = axis[0].count * axis[1].count * axis[2].count;
        const CoarseTerms terms = {parts.weight, parts.hold, parts.residual, parts.value, 0.5F, c % 2, 1e-9};
        assert_in_range(nodes, 8, NODES_MOST);
        if (cases[c / 2].periodic >= 0)
            assert_true(world->constants.cells.size[cases[c / 2].periodic] % 2);
        parts_make(&parts, cpu->count, 0.5F);
        printf("%s: ", cases[c / 2].name);
        assemble(world, axis, nodes, &parts);
        eliminate(nodes);
        cpu_coarse_correct(cpu, &terms);
        compare(world, axis, nodes, &parts, c % 2);
        world_destroy(world);
    }
}

/* Fluid that its surfaces hold all over is left to iterations, until the next grid. */
static void thin_fluid_is_left_alone(void **state)
{
    (void)state;
    static Parts parts;
    World *world = world_of(&cases[0]);
    Cpu *cpu = world->state;
    const CoarseTerms terms = {parts.weight, parts.hold, parts.residual, parts.value, 0.5F, true, 1e-9};
    parts_make(&parts, cpu->count, 5);
    cpu_coarse_correct(cpu, &terms);
    assert_true(cpu->thin);
    assert_memory_equal(parts.value, parts.before, sizeof parts.value);
    cpu_grid(cpu);
    assert_false(cpu->thin);
    world_destroy(world);
}

/* --- in a step --- */

/* A tank that is heaved by 0.45 g, `deep` layers of water. */
static WorldDef heaved(double wide, int deep, bool coarse)
{
    static const Motion motion = {
        .kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.05, .frequency = 1.5};
    WorldDef def = fixture_def(wide, 0.0375 * deep, 0);
    strcpy(def.method, "dfsph");
    def.dimensions = 2;
    def.spacing = 0.025;
    def.support = 3.1;
    def.step_mode = STEP_CFL;
    def.cfl_number = 0.2;
    def.max_dt = 0.01;
    dfsph_def(&def)->coarse = coarse;
    dfsph_def(&def)->surface_lack = 1;
    add_motion(&def, motion);
    fixture_block(&def, 0, -0.5 * wide, 0, 0, 0.5 * wide, 0.025 * deep, 0);
    return def;
}

static double iterations_of(int deep, bool coarse)
{
    const WorldDef def = heaved(0.5, deep, coarse);
    World *world = fixture_world(&def);
    WorldInfo info;
    do {
        fixture_step(world, 1);
        world_info(world, &info);
    } while (info.time < 0.5);
    world_destroy(world);
    printf("%d deep, %s: %.2f iterations a step\n", deep, coarse ? "coarse" : "alone",
           info.solved.iterations_mean);
    return info.solved.iterations_mean;
}

/* Measured at 10, 20 and 40 layers: 9.2, 11.5, 7.8; alone 9.2, 21.6, 33.3. */
static void deep_water_takes_no_more_iterations(void **state)
{
    (void)state;
    const double flat = iterations_of(10, true), middle = iterations_of(20, true),
                 deep = iterations_of(40, true), flat_alone = iterations_of(10, false),
                 deep_alone = iterations_of(40, false);
    assert_true(middle < 1.3 * flat);
    assert_true(deep < 1.3 * flat);
    assert_true(deep < 0.5 * deep_alone);
    assert_true(flat < 1.3 * flat_alone);
}

static void steps_have_the_same_bits_on_any_threads(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = heaved(5.5, 40, true); /* several ranges of each loop */
        *world_threads(&def) = 1 + 2 * k;
        World *world = fixture_world(&def);
        fixture_step(world, 40);
        hash[k] = world_hash(world);
        assert_non_null(((const Cpu *)world->state)->coarse);
        world_destroy(world);
    }
    assert_true(hash[0] != 0 && hash[0] == hash[1]);
}

/* The level is left out where a solid is, since a floating solid got wrong forces. */
static void solids_have_no_level(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        WorldDef def = heaved(0.5, 40, true);
        if (k == 1)
            def.solids[def.solid_count++] =
                (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 1.3, 0}, .radius = 0.1, .axis = {0, 1, 0}};
        World *world = fixture_world(&def);
        fixture_step(world, 40);
        assert_true((((const Cpu *)world->state)->coarse == NULL) == (k == 1));
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corrections_are_those_of_all_particles),  cmocka_unit_test(thin_fluid_is_left_alone),
        cmocka_unit_test(deep_water_takes_no_more_iterations),     cmocka_unit_test(solids_have_no_level),
        cmocka_unit_test(steps_have_the_same_bits_on_any_threads),
    };
    return cmocka_run_group_tests_name("dfsph.coarse", tests, NULL, NULL);
}
