/* Where a free surface meets a wall, and what lies on a floor alone: nothing touches. sim/box/box.h
 */
#include "tests/sim/fixture.h"

#include "sim/box/box.h"
#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph.h"

enum { MOST = 4000 };

static const double spacing = 0.05;
static float cloud[3 * MOST];

/* What touches: nearer to a wall than a tenth of a spacing. */
typedef struct Touching {
    size_t count, of;
    double nearest; /* spacings */
} Touching;

static Touching touching(World *world, const WorldDef *def)
{
    State s = fixture_read(world);
    Touching found = {0, s.count, INFINITY};
    for (size_t i = 0; i < s.count; i++) {
        double d = INFINITY;
        for (int k = 0; k < def->dimensions; k++) {
            const double x = (double)s.position[4 * i + (size_t)k],
                         low = x + (k == 1 ? 0 : def->box_size[k] / 2);
            d = fmin(d, fmin(low, def->box_size[k] - low) / spacing);
        }
        found.count += d < 0.1;
        found.nearest = fmin(found.nearest, d);
    }
    fixture_free(&s);
    return found;
}

static WorldDef tank(const char *method, double width, double height, double depth)
{
    WorldDef def = fixture_def(width, height, depth);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = depth > 0 ? 3 : 2;
    def.spacing = spacing;
    def.support = 2.6;
    def.sound_speed = 30;
    def.fluids[0].viscosity = 50;
    def.dt = 0.3 * def.support * spacing / def.sound_speed;
    if (strcmp(method, "wcsph") == 0) {
        strcpy(wcsph_def(&def)->kernel, "wendland_c2");
        wcsph_def(&def)->delta_sph = 0.1;
        wcsph_def(&def)->viscosity_form = VISCOSITY_RADIAL;
    }
    return def;
}

/* A lattice out of order: of the tank's places those with y below level + slope x. */
static size_t fill(const WorldDef *def, double level, double slope)
{
    const int size[3] = {(int)lround(def->box_size[0] / spacing), (int)lround(def->box_size[1] / spacing),
                         def->dimensions == 3 ? (int)lround(def->box_size[2] / spacing) : 1};
    uint32_t seed = 7;
    size_t count = 0;
    for (int i = 0; i < size[0] * size[1] * size[2]; i++) {
        const int index[3] = {i % size[0], i / size[0] % size[1], i / (size[0] * size[1])};
        double x[3];
        for (int k = 0; k < 3; k++)
            x[k] = index[k] + 0.5 - (k == 1 ? 0 : 0.5 * size[k]);
        if (x[1] * spacing > level + slope * x[0] * spacing)
            continue;
        assert_true(count < MOST);
        for (int k = 0; k < 3; k++)
            cloud[3 * count + (size_t)k] =
                (float)(spacing * (x[k] + (k < def->dimensions ? 0.4 * (fixture_random(&seed) - 0.5) : 0)));
        count++;
    }
    return count;
}

/* After so many seconds; what nothing holds off lies on the wall, or swings to within a tenth of a spacing.
 */
static void does_not_touch(WorldDef *def, double level, double slope, double seconds)
{
    InitialState initial = {.count = fill(def, level, slope), .position = cloud};
    def->initial = &initial;
    World *world = fixture_world(def);
    fixture_step(world, (int)(seconds / def->dt));
    const Touching found = touching(world, def);
    world_destroy(world);
    printf("%s, %dD: %zu of %zu touch a wall, the nearest is %.2f spacings off\n", def->method,
           def->dimensions, found.count, found.of, found.nearest);
    assert_true(found.nearest > 0.2);
}

static const char *const methods[] = {"mueller", "wcsph"};

/* At rest under a gravity that leans by 45 degrees: the surface ends in a wedge of 45 degrees at either wall.
 */
static void a_wedge_at_a_wall_does_not_touch_it(void **state)
{
    (void)state;
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        WorldDef def = tank(methods[m], 0.6, 1, 0.3);
        def.gravity[0] = 7, def.gravity[1] = -7;
        does_not_touch(&def, 0.4, 1, 0.8);
    }
}

/* A film of a single layer; with mueller the film floats. */
static void a_film_lies_above_its_floor(void **state)
{
    (void)state;
    WorldDef def = tank("wcsph", 1.6, 0.4, 0);
    does_not_touch(&def, 0.6 * spacing, 0, 1);
}

/* After a fall into the film the energy watch finds no trouble. Four particles interact, so that
   pressures change on the cushion. */
static void few_particles_fall_and_lie(void **state)
{
    (void)state;
    static const float at[] = {0.1F, 0.3F, 0, 0.15F, 0.3F, 0, 0.1F, 0.35F, 0, 0.15F, 0.35F, 0};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++)
        for (size_t count = 1; count <= 4; count += 3) {
            WorldDef def = tank(methods[m], 1, 1, 0);
            def.initial = &(InitialState){.count = count, .position = at};
            def.retries = 3;
            World *world = fixture_world(&def);
            fixture_step(world, (int)(2 / def.dt));
            State s = fixture_read(world);
            double highest = 0;
            for (size_t i = 0; i < s.count; i++)
                highest = fmax(highest, (double)s.position[4 * i + 1]);
            printf("%s: of %zu particles the highest stands %.3f m off the floor\n", methods[m], count,
                   highest);
            assert_true(highest < (count == 1 ? 0.06 : 0.12));
            fixture_free(&s);
            world_destroy(world);
        }
}

/* 0.05 m spacings: within 0.015 m of what gravity draws to, and no step is too long for it. */
static void it_holds_where_gravity_draws(void **state)
{
    (void)state;
    const float g[3] = {0, -10, 3}, reach = CUSHION_REACH * (float)spacing;
    Walls walls;
    walls_place(&walls, 3, (double[]){1, 1, 1}, (bool[]){true, false, false}, spacing);
    for (int step = 0; step <= 20; step++) {
        const float d = 0.1F * (float)step * reach, share = CUSHION_PUSH * fmaxf(1 - d / reach, 0);
        float low[3] = {0}, high[3] = {0}, still[3] = {0};
        static const float rest[3], leaves[3] = {0, 1, 0};
        walls_cushion(&walls, 1e-4F, g, (float[]){-0.5F + d, d, -0.5F + d}, rest, low);
        walls_cushion(&walls, 1e-4F, g, (float[]){0.5F - d, 1 - d, 0.5F - d}, rest, high);
        walls_cushion(&walls, 0, g, (float[]){-0.5F + d, d, -0.5F + d}, rest, still);
        walls_cushion(&walls, 1e-4F, g, (float[]){0, d, 0}, leaves, still);
        assert_true(low[0] == 0 && high[0] == 0 && still[1] == 0); /* periodic; a step of 0 */
        assert_true(low[2] == 0 && high[1] == 0);                  /* gravity draws away */
        assert_true(fabsf(low[1] - 10 * share) < 1e-3F && fabsf(high[2] + 3 * share) < 1e-3F);
        for (int power = 0; power < 11; power++) { /* of what is at rest: it stands within the reach yet */
            const float dt = 1e-3F * (float)(1 << power);
            float a[3] = {0};
            walls_cushion(&walls, dt, g, (float[]){0, d, 0}, rest, a);
            assert_true(a[1] * dt * dt <= 0.51F * fmaxf(reach - d, 0) + 1e-7F);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_holds_where_gravity_draws),
        cmocka_unit_test(a_wedge_at_a_wall_does_not_touch_it),
        cmocka_unit_test(few_particles_fall_and_lie),
        cmocka_unit_test(a_film_lies_above_its_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
