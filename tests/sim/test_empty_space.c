/* Boxes that are mostly empty: cells share places, which costs no memory and changes no bit. */
#include "fixture.h"

#include "sim/cpu/cpu.h"
#include "sim/step/backend.h"
#include "sim/step/world.h"

#include <stdlib.h>

/* Two distant clumps, the first on the floor; `periodic`: along x and z, with clumps across the sides. */
static WorldDef two_clumps(double size, bool periodic)
{
    WorldDef def = fixture_def(size, size, size);
    const double near = 0.5 * size - 0.4;
    def.fluids[0].viscosity = 1;
    def.periodic[0] = def.periodic[2] = periodic;
    fixture_block(&def, 0, -0.5 * size, 0, -0.5 * size, 0.5 - 0.5 * size, 0.5, 0.5 - 0.5 * size);
    fixture_block(&def, 0, near, size - 0.9, near, near + 0.4, size - 0.5, near + 0.4);
    return def;
}

static bool equal(const State *a, const State *b)
{
    return a->count == b->count && memcmp(a->position, b->position, 16 * a->count) == 0 &&
           memcmp(a->velocity, b->velocity, 16 * a->count) == 0 &&
           memcmp(a->density, b->density, 4 * a->count) == 0;
}

static CellFold fold_of(const WorldDef *def, size_t particles)
{
    Constants constants;
    Error error;
    assert_true(constants_create(&constants, def, &error));
    const CellFold fold = cell_fold(&constants, particles);
    constants_destroy(&constants);
    return fold;
}

/* Sums by cell have the same bits on ranks with different sharing: each cell's particles are contiguous. */
static void check_cells_are_whole(const World *world)
{
    const Cpu *cpu = world->state;
    for (size_t i = 1; i < cpu->count; i++)
        for (size_t j = 0; j < i && cpu->cell[i] != cpu->cell[i - 1]; j++)
            assert_int_not_equal(cpu->cell[i], cpu->cell[j]);
}

/* The energy watch's bound for the surface of fluid with tension: sides of empty cells. If empty cells
   share places with fluid, some sides are missed. */
static EnergySums energy_of(World *world)
{
    EnergySums sums = {.own = 0};
    if (fixture_on_cpu())
        world->backend->energy(world->state, true, &sums);
    return sums;
}

static void check_energy(const EnergySums *shared, const EnergySums *alone)
{
    printf("bare %g m2 of %g\n", shared->bare, alone->bare);
    assert_true(shared->bare <= alone->bare && shared->bare >= 0.9 * alone->bare);
    EnergySums same = *shared;
    same.bare = alone->bare;
    assert_memory_equal(&same, alone, sizeof same);
}

/* As after room for so many that no cells share a place. */
static void compare(const WorldDef *def, const char *what)
{
    WorldDef roomy = *def;
    roomy.pours = true;
    roomy.most = 9000;
    State state[2];
    double neighbours[2];
    EnergySums energy[2];
    assert_true(fold_of(def, 200).shared && !fold_of(&roomy, 9000).shared);
    for (int k = 0; k < 2; k++) {
        World *world = fixture_world(k ? &roomy : def);
        WorldSums sums;
        fixture_step(world, fixture_count(20, 10));
        world_sums(world, &sums);
        neighbours[k] = sums.neighbours_mean;
        energy[k] = energy_of(world);
        if (fixture_on_cpu())
            check_cells_are_whole(world);
        state[k] = fixture_read(world);
        world_destroy(world);
    }
    assert_true(state[0].count > 150 && state[0].count < 260);
    if (!equal(&state[0], &state[1]))
        fail_msg("%s: other bits", what);
    assert_true(neighbours[0] == neighbours[1]);
    check_energy(&energy[0], &energy[1]);
    for (int k = 0; k < 2; k++)
        fixture_free(&state[k]);
}

static void no_bit_changes(void **state)
{
    (void)state;
    fixture_needs("shared places");
    for (int m = 0; m < (fixture_on_cpu() ? fixture_methods() : 1); m++)
        for (int periodic = 0; periodic < 2; periodic++) {
            WorldDef def = two_clumps(8, periodic);
            snprintf(def.method, sizeof def.method, "%s", fixture_method_names[m]);
            compare(&def, def.method);
        }
    WorldDef def = two_clumps(8, false);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-3.5, 0.9, -3.5}, .radius = 0.3, .slip = SLIP_NONE};
    compare(&def, "a sphere");
    def.tension_model = TENSION_COHESION;
    def.fluids[0].surface_tension = 0.07;
    compare(&def, "tension");
}

/* Small drops all over the box, so that many cells share a place; neighbours by their ids are in several
 * drops. */
static void drops_change_no_bit(void **state)
{
    (void)state;
    fixture_needs("shared places");
    enum { DROPS = 25, COUNT = 8 * DROPS };
    WorldDef def = fixture_def(8, 8, 8);
    float x[3 * COUNT];
    uint32_t seed = 5;
    for (int drop = 0; drop < DROPS; drop++) {
        double middle[3];
        for (int k = 0; k < 3; k++)
            middle[k] = 0.5 + 7 * fixture_random(&seed) - (k == 1 ? 0 : 4);
        for (int i = 0; i < 8; i++)
            for (int k = 0; k < 3; k++)
                x[3 * (DROPS * i + drop) + k] =
                    (float)(middle[k] + 0.08 * (i >> k & 1) + 0.01 * fixture_random(&seed));
    }
    const InitialState initial = {.count = COUNT, .position = x};
    def.initial = &initial;
    def.tension_model = TENSION_COHESION;
    def.fluids[0].surface_tension = 0.07;
    compare(&def, "drops");
}

/* A number in [1, inner], the first and the last one often. */
static int random_place(uint32_t *seed, int inner)
{
    const int r = (int)(fixture_random(seed) * (inner + 4)) - 1;
    return r < 1 ? 1 : r > inner ? inner : r;
}

/* The 27 cells around one, across periodic sides: the number of each, and its place. */
static void cells_around(const Constants *s, const CellFold *fold, const int at[3], uint32_t cell[27],
                         uint32_t place[27])
{
    const int *size = s->cells.size;
    for (int n = 0; n < 27; n++) {
        const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        uint32_t to[3];
        for (int k = 0; k < 3; k++) {
            const int inner = size[k] - 2, x = at[k] + step[k];
            to[k] = (uint32_t)(!s->periodic.axis[k] ? x : x < 1 ? inner : x > inner ? 1 : x);
        }
        cell[n] = (to[2] * (uint32_t)size[1] + to[1]) * (uint32_t)size[0] + to[0];
        place[n] = cell_fold_at(fold, to[0], to[1], to[2]);
        assert_true(place[n] < fold->count && place[n] == cell_fold_of(fold, &s->cells, cell[n]));
    }
}

static void check_fold(const WorldDef *def, size_t particles)
{
    Constants s;
    Error error;
    uint32_t seed = (uint32_t)particles, cell[27], place[27];
    assert_true(constants_create(&s, def, &error));
    const CellFold fold = cell_fold(&s, particles);
    assert_true(fold.shared && fold.count < s.cells.count / 2);
    for (int n = 0; n < 200; n++) {
        int at[3];
        for (int k = 0; k < 3; k++)
            at[k] = random_place(&seed, s.cells.size[k] - 2);
        cells_around(&s, &fold, at, cell, place);
        for (int i = 0; i < 27; i++)
            for (int j = 0; j < i; j++)
                if (place[i] == place[j] && cell[i] != cell[j])
                    fail_msg("%zu particles: cells %u and %u, which one walk visits, share a place",
                             particles, cell[i], cell[j]);
    }
    constants_destroy(&s);
}

static void a_walk_meets_each_cell_once(void **state)
{
    (void)state;
    fixture_needs_cpu("no backend changes it");
    static const double boxes[][3] = {{9, 9, 9},       {200, 1, 1},  {1, 300, 1.3},
                                      {0.6, 0.5, 900}, {40, 40, 40}, {77, 31, 3}};
    for (size_t b = 0; b < sizeof boxes / sizeof *boxes; b++)
        for (int sides = 0; sides < 8; sides++)
            for (size_t particles = 1; particles < 100; particles *= 7) {
                WorldDef def = fixture_def(boxes[b][0], boxes[b][1], boxes[b][2]);
                for (int k = 0; k < 3; k++)
                    def.periodic[k] = sides >> k & 1;
                check_fold(&def, particles);
            }
}

static size_t bytes_of(double size)
{
    WorldDef def = two_clumps(size, false);
    World *world = fixture_world(&def);
    WorldInfo info;
    fixture_step(world, 1);
    world_info(world, &info);
    world_destroy(world);
    return info.state_bytes;
}

/* Ten times as wide, a thousand times as many cells. */
static void empty_space_takes_no_memory(void **state)
{
    (void)state;
    fixture_needs("shared places");
    const size_t few = bytes_of(2), many = bytes_of(20), most = bytes_of(100);
    printf("%zu bytes in 2 m, %zu in 20 m, %zu in 100 m\n", few, many, most);
    assert_true(many < 1.1 * (double)few && most < 1.2 * (double)few);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_bit_changes),
        cmocka_unit_test(drops_change_no_bit),
        cmocka_unit_test(a_walk_meets_each_cell_once),
        cmocka_unit_test(empty_space_takes_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
