/* A ball of thick fluid in mid-air, on any backend. */
#ifndef SLOSH_TEST_BALL_H
#define SLOSH_TEST_BALL_H

#include "tests/sim/fixture.h"

#include "sim/def/fluids.h"
#include "sim/step/world.h"

enum { BALL_MOST = 1200 };

static inline WorldDef thick_def(const char *method, int dimensions, double viscosity)
{
    WorldDef def = fixture_def(1.2, 1.2, dimensions == 3 ? 1.2 : 0);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = dimensions;
    def.support = dimensions == 3 ? 2.1 : 3;
    memset(def.gravity, 0, sizeof def.gravity);
    def.fluids[0].viscosity = viscosity;
    def.viscosity_solver = VISCOSITY_IMPLICIT;
    def.viscosity_tolerance = 1e-5;
    return def;
}

/* A ball in mid-air whose particles move at random, and turn about its centre. */
typedef struct Ball {
    float x[3 * BALL_MOST], v[3 * BALL_MOST];
    InitialState initial;
} Ball;

static inline void ball_make(Ball *ball, int dimensions, double speed, double turn)
{
    enum { HALF = 5, SIDE = 2 * HALF };
    size_t n = 0;
    uint32_t seed = 7;
    for (int i = 0; i < SIDE * SIDE * (dimensions == 3 ? SIDE : 1); i++) {
        const int index[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        double at[3] = {0};
        for (int k = 0; k < dimensions; k++)
            at[k] = 0.1 * (index[k] - HALF + 0.5);
        if (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] > 0.22)
            continue;
        for (int k = 0; k < 3; k++) {
            ball->x[3 * n + (size_t)k] = (float)(at[k] + (k == 1 ? 0.6 : 0));
            ball->v[3 * n + (size_t)k] =
                k == 2 && dimensions == 2 ? 0 : (float)(speed * (fixture_random(&seed) - 0.5));
        }
        ball->v[3 * n] -= (float)(turn * at[1]);
        ball->v[3 * n + 1] += (float)(turn * at[0]);
        n++;
    }
    ball->initial = (InitialState){.count = n, .position = ball->x, .velocity = ball->v};
}

/* A ball thrown at 5 m/s falls like a ball at rest: changes per step are small beside the speed. */
static inline void ball_check_thrown(const char *method, const char *backend)
{
    static Ball ball;
    WorldDef def = thick_def(method, 3, 10);
    ball_make(&ball, 3, 0, 0);
    for (size_t i = 0; i < ball.initial.count; i++)
        ball.v[3 * i] += 5;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    def.initial = &ball.initial;
    def.box_size[0] = 4;
    def.periodic[0] = true;
    def.gravity[1] = -9.81;
    def.sound_speed = 5;
    def.viscosity_tolerance = 1e-3;
    def.dt = 0.0005;
    World *world = fixture_world(&def);
    WorldSums sums;
    WorldInfo info;
    fixture_step(world, 20);
    world_sums(world, &sums);
    world_info(world, &info);
    /* of particles of 1 kg */
    const double fallen = sums.momentum[1] / (-9.81 * info.time * (double)ball.initial.count);
    printf("%s: moves down with %.4f of what it should\n", method, fallen);
    assert_float_equal(fallen, 1, 0.01);
    world_destroy(world);
}

/* A turning thick body, with a user's tolerance, through a turn. Friction alone holds the body together:
   friction taken over from the step before pulls to the old position of the middle. */
static inline void ball_check_turn(const char *method, const char *backend)
{
    static Ball ball;
    WorldDef def = thick_def(method, 3, 5000);
    ball_make(&ball, 3, 0, 5);
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    def.initial = &ball.initial;
    def.sound_speed = 5;
    def.viscosity_tolerance = world_def_default().viscosity_tolerance;
    def.dt = 0.002;
    World *world = fixture_world(&def);
    WorldSums before, after;
    const int steps = (int)(2 * M_PI / 5 / def.dt);
    world_sums(world, &before);
    fixture_step(world, steps);
    world_sums(world, &after);
    const double gained = after.angular_momentum[2] / before.angular_momentum[2] - 1;
    printf("%s: gains %.3f %% of its angular momentum a turn; %.0f iterations\n", method, 100 * gained,
           world->solves[SOLVE_VISCOSITY].iterations);
    assert_float_equal(gained, 0, 0.001);
    assert_true(after.kinetic_energy < before.kinetic_energy);
    world_destroy(world);
}

/* Three steps of 1 s with 1e5 Pa s: random motion loses energy; momenta stay within the digits of
   friction, some 1e4 times inertia. */
static inline void ball_check_long_step(const char *method, const char *backend)
{
    static Ball ball;
    WorldDef def = thick_def(method, 3, 1e5);
    Error error = {{0}};
    ball_make(&ball, 3, 0.02, 0.02);
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    def.initial = &ball.initial;
    def.sound_speed = 0.001; /* sound, which such a step does not stand, has no part in it */
    def.viscosity_tolerance = 1e-4;
    def.retries = 3;
    def.dt = 1;
    World *world = fixture_world(&def);
    WorldSums before, after;
    WorldInfo info;
    world_sums(world, &before);
    for (int step = 0; step < 3; step++)
        if (!world_step(world, NULL, &error))
            fail_msg("%s: %s", method, error.message);
    world_sums(world, &after);
    world_info(world, &info);
    printf("%s: energy %.3g J, then %.3g; turns with %.5f, then %.5f kg m2/s; %.0f iterations\n", method,
           before.kinetic_energy, after.kinetic_energy, before.angular_momentum[2], after.angular_momentum[2],
           info.solves[SOLVE_VISCOSITY].iterations);
    assert_int_equal(info.trouble.count, 0);
    assert_true(after.kinetic_energy < 0.7 * before.kinetic_energy);
    for (int k = 0; k < 3; k++) {
        assert_float_equal(before.momentum[k], after.momentum[k], 2e-3 * before.momentum_scale);
        assert_float_equal(before.angular_momentum[k], after.angular_momentum[k],
                           0.01 * before.angular_scale);
    }
    world_destroy(world);
}

#endif
