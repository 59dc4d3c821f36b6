/* The walls of the box with wcsph: what rests goes on resting, and no energy comes from them. */
#include "fixture.h"
#include "sim/methods/wcsph/wcsph.h"

enum { MOST = 4000 };

/* A tank of 1 m width, filled 1 m high by so many layers. */
typedef struct Tank {
    int dimensions, layers;
    double support, jitter;
    const char *kernel;
} Tank;

static WorldDef tank_def(const Tank *tank)
{
    WorldDef def = fixture_def(1, 1.5, 1);
    def.dimensions = tank->dimensions;
    strcpy(def.method, "wcsph");
    strcpy(wcsph_def(&def)->kernel, tank->kernel);
    def.spacing = 1.0 / tank->layers;
    def.support = tank->support;
    def.sound_speed = 31.3; /* ten times sqrt(g H) */
    def.dt = 0.3 * def.support * def.spacing / def.sound_speed;
    wcsph_def(&def)->artificial_viscosity = 0.02;
    def.reproducible = false;
    return def;
}

/* A lattice in the tank, each particle with the density of the weight above, and moved by jitter; without
   gravity all compressed by 1 %. Layer distances match densities. */
static World *tank_world(const Tank *tank, const WorldDef *def)
{
    static float x[3 * MOST], density[MOST];
    const int side = tank->layers, rows = tank->dimensions == 3 ? side : 1;
    const double s = def->spacing, c = def->sound_speed, b = 1000 * c * c / 7, g = -def->gravity[1];
    uint32_t seed = 7;
    size_t count = 0;
    double y = 0;
    for (int layer = 0; layer < side; layer++) {
        const double p = g > 0 ? 1000 * g * (side - layer - 0.5) * s : 0.01 * 1000 * c * c;
        const double r = pow(1 + p / b, 1.0 / 7);
        for (int i = 0; i < side * rows; i++, count++) {
            const int index[3] = {i % side, 0, i / side};
            for (int k = 0; k < 3; k++) {
                const double at = k == 1 ? y + 0.5 * s / r : (index[k] - 0.5 * (side - 1)) * s;
                const double away = tank->jitter * s * (2 * fixture_random(&seed) - 1);
                x[3 * count + k] = (float)(k == 2 && rows == 1 ? 0 : at + away);
            }
            density[count] = (float)(1000 * r);
        }
        y += s / (g > 0 ? r : 1);
    }
    WorldDef with = *def;
    with.initial = &(InitialState){.count = count, .position = x, .density = density};
    return fixture_world(&with);
}

/* Kinetic, potential and compression's: of Tait, m c^2 / 7 (r^6 / 6 + 1 / r - 7 / 6), where it presses. */
static double energy(World *world, const WorldDef *def)
{
    WorldSums sums;
    world_sums(world, &sums);
    State s = fixture_read(world);
    double e = sums.kinetic_energy - sums.mass * def->gravity[1] * sums.centre[1];
    for (size_t i = 0; i < s.count; i++) {
        const double r = (double)s.density[i] / 1000;
        if (def->negative_pressure || r > 1)
            e += sums.mass / (double)s.count * def->sound_speed * def->sound_speed / 7 *
                 (pow(r, 6) / 6 + 1 / r - 7.0 / 6);
    }
    fixture_free(&s);
    return e;
}

/* For so many seconds: none of the fluid moves faster than ringing of its start, none leaks into the walls,
   and energy, of the potential energy, never grows. */
static void rests(const Tank *tank, double seconds)
{
    const WorldDef def = tank_def(tank);
    World *world = tank_world(tank, &def);
    WorldSums start, now;
    world_sums(world, &start);
    const double potential = 0.5 * start.mass * 9.81, frames = seconds / def.dt / 20;
    double last = energy(world, &def), gained = 0, fastest = 0, sunk = 0;
    for (int i = 0; i < frames; i++) {
        fixture_step(world, 20);
        const double e = energy(world, &def);
        world_sums(world, &now);
        gained = fmax(gained, (e - last) / potential);
        last = fmin(last, e);
        fastest = fmax(fastest, sqrt(2 * now.kinetic_energy / now.mass));
        sunk = fmax(sunk, start.centre[1] - now.centre[1]);
    }
    printf(
        "%dD, %s, support %.1f, %.1f s: at most %.3f m/s (rms), now %.4f; sunk by %.4f m, energy grew by %.1e\n",
        tank->dimensions, tank->kernel, tank->support, seconds, fastest,
        sqrt(2 * now.kinetic_energy / now.mass), sunk, gained);
    assert_true(fastest < 0.08);
    assert_true(sqrt(2 * now.kinetic_energy / now.mass) < 0.04);
    assert_true(sunk < 0.005);
    assert_true(gained < 2e-5);
    world_destroy(world);
}

static void a_tank_at_rest_stays_at_rest(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    rests(&(Tank){2, 20, 3, 0.1, "wendland_c2"}, fixture_coarse(3, 0.2));
    rests(&(Tank){2, 20, 3.5, 0.1, "wendland_c2"}, fixture_coarse(3, 0.2));
    rests(&(Tank){3, 9, 3, 0.1, "wendland_c2"}, fixture_coarse(1, 0.1));
}

/* Kernels that pair particles would have fluid stick to its images. */
static void any_kernel_holds(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    rests(&(Tank){2, 20, 2.6, 0.1, "cubic"}, fixture_coarse(2, 0.2));
    rests(&(Tank){2, 20, 3, 0.1, "quintic"}, fixture_coarse(2, 0.2));
}

/* Nothing dissipates in a closed box, pressed and out of order: energy stays. */
static void walls_keep_energy(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const Tank tank = {dimensions, 10, 2.6, 0.2, "wendland_c2"};
        WorldDef def = tank_def(&tank);
        memset(def.gravity, 0, sizeof def.gravity);
        def.box_size[1] = 1;
        wcsph_def(&def)->artificial_viscosity = wcsph_def(&def)->delta_sph = 0;
        def.negative_pressure = true;
        def.dt /= 4;
        World *world = tank_world(&tank, &def);
        WorldSums now;
        const double start = energy(world, &def);
        double worst = 0;
        for (int i = 0; i < fixture_count(20, 2); i++) {
            fixture_step(world, 20);
            worst = fmax(worst, fabs(energy(world, &def) / start - 1));
        }
        world_sums(world, &now);
        printf("%dD: energy within %.1e of itself, %.2f of it kinetic\n", dimensions, worst,
               now.kinetic_energy / start);
        assert_true(now.kinetic_energy > 0.01 * start);
        assert_true(worst < 0.002);
        world_destroy(world);
    }
}

/* The lattice under its own weight: no layer next to the floor or a side feels a force. */
static void pressure_goes_on_behind_walls(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const Tank tank = {dimensions, 12, 3, 0, "wendland_c2"};
        WorldDef def = tank_def(&tank);
        wcsph_def(&def)->artificial_viscosity = wcsph_def(&def)->delta_sph = 0;
        def.dt = 1e-5;
        World *world = tank_world(&tank, &def);
        fixture_step(world, 1);
        State s = fixture_read(world);
        double worst = 0;
        for (size_t i = 0; i < s.count; i++)
            if (s.position[4 * i + 1] < 1 - 3.5 / 12) /* sees no surface */
                for (int k = 0; k < 3; k++)
                    worst = fmax(worst, fabs((double)s.velocity[4 * i + k]) / def.dt / 9.81);
        printf("%dD: lattice at rest accelerates by %.3f g\n", dimensions, worst);
        assert_true(worst < 0.1);
        fixture_free(&s);
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tank_at_rest_stays_at_rest),
        cmocka_unit_test(any_kernel_holds),
        cmocka_unit_test(walls_keep_energy),
        cmocka_unit_test(pressure_goes_on_behind_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
