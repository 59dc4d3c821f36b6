/* Neighbour lists against brute force over all pairs: of every instruction set, in crowds larger than a
   block of candidates, in planes, across periodic sides, of coincident particles. */
#include "fixture.h"

#include "sim/cpu/cpu.h"
#include "sim/methods/wcsph/wcsph_private.h"
#include "sim/step/world.h"

#include <stdlib.h>

enum { COUNT = 1300 };

typedef struct Cloud {
    const char *name;
    double box[3], part; /* of the box that is filled */
    bool twins, periodic;
    int dimensions;
} Cloud;

static const Cloud clouds[] = {
    {"random", {2.3, 1.1, 0.9}, 1, false, false, 3},
    {"one cell wide", {0.15, 1.1, 0.9}, 1, false, false, 3},
    {"a crowd", {1, 1, 1}, 0.2, false, false, 3}, /* all see most of the others */
    {"twins", {2.3, 1.1, 0.9}, 1, true, false, 3},
    {"plane", {5, 4, 0}, 1, false, false, 2},
    {"periodic", {0.8, 0.6, 0.421}, 1, false, true, 3}, /* two cells wide along z */
    {"periodic plane", {3, 0.421, 0}, 1, true, true, 2},
};

static void fill(const Cloud *cloud, float x[3 * COUNT])
{
    uint32_t seed = 11;
    for (int i = 0; i < 3 * COUNT; i++) {
        const double size = cloud->box[i % 3];
        x[i] = (float)((fixture_random(&seed) - (i % 3 == 1 ? 0 : 0.5)) * size * cloud->part);
    }
    for (int i = 3; cloud->twins && i < 3 * COUNT; i++)
        if (i / 3 % 2)
            x[i] = x[i - 3];
}

static World *world_of(const Cloud *cloud, const float x[3 * COUNT])
{
    WorldDef def = fixture_def(cloud->box[0], cloud->box[1], cloud->dimensions == 2 ? 1 : cloud->box[2]);
    def.dimensions = cloud->dimensions;
    for (int k = 0; k < cloud->dimensions; k++)
        def.periodic[k] = cloud->periodic;
    def.initial = &(InitialState){.count = COUNT, .position = x};
    return fixture_world(&def);
}

/* 1: near, 0: not, -1: that near to h, or to being coincident, that rounding may decide. */
static int relation(const Cpu *cpu, size_t i, size_t j, double reach)
{
    const CpuParticles *p = &cpu->now;
    float d[3] = {p->x[i] - p->x[j], p->y[i] - p->y[j], p->z[i] - p->z[j]};
    periodic_nearest(&cpu->constants->periodic, d);
    const double r =
        sqrt((double)d[0] * (double)d[0] + (double)d[1] * (double)d[1] + (double)d[2] * (double)d[2]);
    return fabs(r / reach - 1) < 1e-5 ? -1 : r < reach;
}

/* The particle of entry j: across a periodic side a nearby copy. */
static size_t listed_one(const Cpu *cpu, size_t i, size_t j)
{
    const CpuParticles *p = &cpu->now;
    const double d[3] = {(double)(p->x[i] - p->x[j]), (double)(p->y[i] - p->y[j]),
                         (double)(p->z[i] - p->z[j])};
    assert_true(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) <
                1.00001 * (double)cpu->constants->support_radius);
    return j < COUNT ? j : cpu->copy_of[j];
}

/* True if a second particle has the same position. */
static bool check_list(const Cpu *cpu, size_t i, const char *name)
{
    static uint8_t listed[COUNT];
    const double h = (double)cpu->constants->support_radius;
    const NeighbourLists *lists = &cpu->lists;
    const uint32_t *list = lists->of_range[i / LISTS_GRAIN].index + lists->first[i / LANES] + i % LANES;
    const uint32_t rows = lists->rows[i / LANES] & ~(uint32_t)LISTS_FLAGS;
    uint32_t k = 0;
    bool twin = false;
    memset(listed, 0, sizeof listed);
    const uint32_t none = list_entry(COUNT + cpu->copies);
    for (; k < rows && list[k * LANES] < none; k++) {
        const size_t j = listed_one(cpu, i, list_particle(list[k * LANES]));
        assert_true(j != i && !listed[j]);
        listed[j] = 1;
    }
    for (; k < rows; k++)
        assert_int_equal(list[k * LANES], none);
    for (size_t j = 0; j < COUNT; j++) {
        const int near = relation(cpu, i, j, h);
        twin |= j != i && relation(cpu, i, j, 1e-6 * h) == 1;
        if (j != i && near >= 0 && near != listed[j])
            fail_msg("%s: particle %zu and %zu are %s", name, i, j,
                     near ? "near, not listed" : "listed, not near");
    }
    if (twin)
        assert_true(lists->rows[i / LANES] & LISTS_COINCIDENT);
    return twin;
}

static void check_all(const char *set)
{
    static float x[3 * COUNT];
    setenv("SLOSH_SIMD", set, 1);
    for (size_t c = 0; c < sizeof clouds / sizeof *clouds; c++) {
        fill(&clouds[c], x);
        World *world = world_of(&clouds[c], x);
        const Cpu *cpu = world->state;
        assert_true(cpu->lists.ready && !cpu->lists.full);
        bool twins[COUNT / LANES + 1] = {false};
        for (size_t i = 0; i < COUNT; i++)
            twins[i / LANES] |= check_list(cpu, i, clouds[c].name);
        for (size_t g = 0; g * LANES < COUNT; g++)
            assert_int_equal((cpu->lists.rows[g] & LISTS_COINCIDENT) != 0, twins[g]);
        world_destroy(world);
    }
    unsetenv("SLOSH_SIMD");
}

static void lists_are_those_of_brute_force(void **state)
{
    (void)state;
    fixture_needs_cpu("the lists are its own");
    check_all("avx2");
}

static void in_every_instruction_set(void **state)
{
    (void)state;
    fixture_needs_cpu("the lists are its own");
    check_all("baseline");
}

/* Groups beside solids are marked, and of the others no particle has a boundary particle within h. */
static void groups_beside_solids_are_marked(void **state)
{
    (void)state;
    fixture_needs_cpu("the lists are its own");
    WorldDef def = fixture_def(2.4, 0.9, 0.6);
    strcpy(def.method, "pbf");
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.8, 0.4, 0}, .radius = 0.2, .axis = {0, 1, 0}};
    fixture_block(&def, 0, -1.2, 0, -0.3, 1.2, 0.6, 0.3);
    World *world = fixture_world(&def);
    fixture_step(world, 1);
    const Cpu *cpu = world->state;
    const CpuParticles *p = &cpu->now;
    size_t marked = 0, others = 0;
    for (size_t g = 0; g * LANES < cpu->count; g++) {
        const bool solid = cpu->lists.rows[g] & LISTS_SOLID;
        for (size_t i = g * LANES; i < (g + 1) * LANES && i < cpu->count && !solid; i++)
            for (size_t j = 0; j < cpu->count && p->fluid[i] < FLUIDS_MAX; j++)
                assert_false(p->fluid[j] >= FLUIDS_MAX &&
                             relation(cpu, i, j, 0.8 * (double)cpu->constants->support_radius) == 1);
        marked += solid;
        others += !solid;
    }
    printf("%zu groups beside the solid, %zu others\n", marked, others);
    assert_true(marked > 0 && others > marked);
    world_destroy(world);
}

/* Lists are filled up with the index behind the last particle, where one that came and went may have left
   anything. */
static void what_is_left_behind_the_last_counts_for_nothing(void **state)
{
    (void)state;
    fixture_needs_cpu("the columns are its own");
    static float x[3 * COUNT];
    fill(&clouds[0], x);
    WorldDef def = fixture_def(2.3, 1.1, 0.9);
    strcpy(def.method, "wcsph");
    wcsph_def(&def)->delta_sph = 0.1;
    def.dt = 1e-6;
    def.initial = &(InitialState){.count = COUNT, .position = x};
    World *world = fixture_world(&def);
    const CpuParticles *p = &((Cpu *)world->state)->now;
    float *const left[] = {p->kind, p->own[RELATIVE], p->own[SLOPE], p->own[SLOPE + 1], p->own[SLOPE + 2]};
    for (size_t k = 0; k < sizeof left / sizeof *left; k++)
        left[k][COUNT] = NAN;
    fixture_step(world, 1);
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++)
        assert_true(isfinite(s.density[i]));
    fixture_free(&s);
    world_destroy(world);
}

/* In the place of the C library's: of more than a megabyte there is none while memory is short. */
static bool memory_is_short;

void *aligned_alloc(size_t alignment, size_t size)
{
    void *memory = NULL;
    if (memory_is_short && size > 1000000)
        return NULL;
    return posix_memalign(&memory, alignment, size) == 0 ? memory : NULL;
}

static void memory_that_is_short_is_trouble(void **state)
{
    (void)state;
    fixture_needs_cpu("the lists are its own");
    static float x[3 * COUNT];
    Error error;
    fill(&clouds[2], x); /* a crowd: its lists take six megabytes */
    WorldDef def = fixture_def(1, 1, 1);
    def.initial = &(InitialState){.count = COUNT, .position = x};
    memory_is_short = true;
    World *world = world_create(&def, &error);
    assert_non_null(world);
    assert_true(((Cpu *)world->state)->lists.full);
    assert_false(world_step(world, NULL, &error));
    assert_non_null(strstr(error.message, step_trouble_words(STEP_TROUBLE_MEMORY)));
    world_destroy(world);
    memory_is_short = false;
    world = fixture_world(&def);
    WorldInfo info;
    world_info(world, &info);
    assert_true(info.state_bytes > sizeof(uint32_t) * COUNT * (COUNT - 1));
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_are_those_of_brute_force),
        cmocka_unit_test(in_every_instruction_set),
        cmocka_unit_test(groups_beside_solids_are_marked),
        cmocka_unit_test(what_is_left_behind_the_last_counts_for_nothing),
        cmocka_unit_test(memory_that_is_short_is_trouble),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
