/* Solids by themselves: distances, poses, the layers of boundary particles, the guard. */
#include "fixture.h"

#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"

#include "tests/lists.h"
#include "tests/tolerance.h"

static const SolidDef shapes[] = {
    {.kind = SOLID_SPHERE, .radius = 1},
    {.kind = SOLID_BOX, .size = {2, 1, 0.6}, .axis = {0, 0, 1}, .angle_deg = 20},
    {.kind = SOLID_CYLINDER, .radius = 0.6, .height = 1.4, .axis = {1, 1, 0}},
    {.kind = SOLID_BOWL, .radius = 1, .thickness = 0.3, .axis = {0, 1, 0.2}},
};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

/* In a cube, or square, of that half width. */
static void random_point(uint32_t *seed, int dimensions, double width, double x[3])
{
    for (int k = 0; k < 3; k++)
        x[k] = k < dimensions ? width * (2 * fixture_random(seed) - 1) : 0;
}

/* Whether the matter is there, by the definitions. */
static bool is_matter(const SolidDef *s, int dimensions, const double x[3])
{
    const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    switch (s->kind) {
    case SOLID_BOX:
        return fabs(x[0]) < s->size[0] / 2 && fabs(x[1]) < s->size[1] / 2 &&
               (dimensions == 2 || fabs(x[2]) < s->size[2] / 2);
    case SOLID_CYLINDER:
        return hypot(x[0], x[2]) < s->radius && fabs(x[1]) < s->height / 2;
    case SOLID_BOWL:
        return x[1] < 0 && r > s->radius && r < s->radius + s->thickness;
    default:
        return r < s->radius;
    }
}

/* Outside: no matter within the distance, and matter just beyond it along the normal; inside: matter within
   the depth. */
static void distances_are_to_the_nearest_matter(void **state)
{
    (void)state;
    uint32_t seed = 3;
    for (int k = 0; k < SHAPES; k++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            if (dimensions == 2 && shapes[k].kind == SOLID_CYLINDER)
                continue;
            int inside = 0;
            for (int n = 0; n < 2000; n++) {
                double x[3], away[3], other[3], normal[3];
                random_point(&seed, dimensions, 1.6, x);
                const double d = solid_distance(&shapes[k], dimensions, x);
                assert_true((d < 0) == is_matter(&shapes[k], dimensions, x));
                inside += d < 0;
                do
                    random_point(&seed, dimensions, 1, away);
                while (away[0] * away[0] + away[1] * away[1] + away[2] * away[2] > 1);
                for (int a = 0; a < 3; a++)
                    other[a] = x[a] + 0.999 * fabs(d) * away[a];
                if (is_matter(&shapes[k], dimensions, other) != (d < 0))
                    fail_msg("%s in %dD: the distance %g at %g %g %g is not that of the nearest surface",
                             solid_name(shapes[k].kind), dimensions, d, x[0], x[1], x[2]);
                solid_normal(&shapes[k], dimensions, x, normal);
                for (int a = 0; a < 3; a++)
                    other[a] = x[a] - (d + 1e-5) * normal[a];
                if (d > 0 && !is_matter(&shapes[k], dimensions, other))
                    fail_msg("%s in %dD: at %g %g %g the surface is not %g m along the normal",
                             solid_name(shapes[k].kind), dimensions, x[0], x[1], x[2], d);
            }
            assert_true(inside > 50);
        }
}

/* A pose turns the shape's axis to where the def says, and moves about the centre. */
static void poses_follow_the_def(void **state)
{
    (void)state;
    SolidDef solid = {
        .kind = SOLID_CYLINDER, .centre = {1, 2, 3}, .radius = 1, .height = 1, .axis = {0, 3, 4}};
    add_solid_motion(&solid, (Motion){.kind = MOTION_ACCELERATE, .axis = {1, 0, 0}, .acceleration = 2});
    add_solid_motion(&solid, (Motion){.kind = MOTION_SPIN, .axis = {1, 0, 0}, .rate = M_PI / 6});
    BoxState pose;
    double axis[3];
    solid_pose(&solid, 3, &pose);
    check_near(pose.position[0], 1 + 9, 1e-12, "pose.position[0]");
    check_near(pose.position[1], 2, 1e-12, "pose.position[1]");
    check_near(pose.velocity[0], 6, 1e-12, "pose.velocity[0]");
    quat_rotate(pose.orientation, (double[3]){0, 1, 0}, axis);
    check_near(axis[1], -0.8, 1e-12, "axis[1]"); /* (0, 0.6, 0.8) turned by 90 degrees about x */
    check_near(axis[2], 0.6, 1e-12, "axis[2]");

    SolidPose single;
    const float arm[3] = {10, 3, 3};
    float v[3];
    solid_pose_at(&solid, 3, &single);
    solid_velocity_at(&single, arm, v); /* w x (0, 1, 0) = rate z */
    check_near(v[0], 6, 1e-5, "v[0]");
    check_near(v[2], M_PI / 6, 1e-5, "v[2]");

    for (int down = -1; down <= 1; down += 2) {
        SolidDef bowl = {.kind = SOLID_BOWL, .radius = 1, .thickness = 1, .axis = {0, down, 0}};
        solid_pose(&bowl, 0, &pose);
        quat_rotate(pose.orientation, (double[3]){0, 1, 0}, axis);
        check_near(axis[1], down, 1e-12, "axis[1]");
    }
}

/* As many as their volume asks for, all in the matter, the first layer half a spacing behind the surface. */
static void layers_fill_the_matter(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            const double s = 0.05;
            if (dimensions == 2 && shapes[k].kind == SOLID_CYLINDER)
                continue;
            const size_t count = boundary_layers(&shapes[k], dimensions, s, 100, NULL);
            float *x = malloc(3 * count * sizeof *x);
            assert_int_equal(boundary_layers(&shapes[k], dimensions, s, 100, x), count);
            check_near((double)count / boundary_estimate(&shapes[k], dimensions, s, 100), 1, 0.06,
                       "(double)count / boundary_estimate(&shapes[k], dimensions, s, 100)");
            double first = -INFINITY;
            for (size_t i = 0; i < count; i++) {
                const double at[3] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
                const double d = solid_distance(&shapes[k], dimensions, at);
                assert_true(d < 0);
                first = fmax(first, d);
            }
            if (shapes[k].kind != SOLID_BOWL) /* whose rim is cut from shells */
                check_near(first / s, -0.5, 0.02, "depth of the first layer");
            free(x);

            const size_t skin = boundary_layers(&shapes[k], dimensions, s, 0.1, NULL);
            assert_true(skin < count || shapes[k].kind == SOLID_BOWL);
        }
}

/* Volume of the layers of a solid of few spacings, for all parts of a spacing in the size, and the mean
   square of the distance from the middle. The matter of a particle has a mean square of 1/12 for each axis
   with layers. Layers at half their thickness would give a ball 0.94 of the mean square. */
static void a_small_solid_has_its_volume(void **state)
{
    (void)state;
    for (double n = 3; n < 5; n += 0.23)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            const double ball = n * n * dimensions / (dimensions + 2), edge = n * n / 3;
            const struct {
                SolidDef solid;
                double volume, square, own; /* spacings */
            } of[] = {{{.kind = SOLID_SPHERE, .radius = n},
                       dimensions == 3 ? 4 * M_PI / 3 * n * n * n : M_PI * n * n,
                       ball,
                       1.0 / 12},
                      {{.kind = SOLID_BOX, .size = {2 * n, 2.4 * n, 1.6 * n}},
                       dimensions == 3 ? 7.68 * n * n * n : 4.8 * n * n,
                       edge * (1 + 1.44 + (dimensions == 3 ? 0.64 : 0)),
                       dimensions / 12.0},
                      {{.kind = SOLID_CYLINDER, .radius = n, .height = 2 * n},
                       2 * M_PI * n * n * n,
                       n * n / 2 + edge,
                       2.0 / 12}};
            for (int k = 0; k < dimensions; k++) {
                float x[3 * 2000];
                double sum = 0;
                const size_t count = boundary_layers(&of[k].solid, dimensions, 1, 100, NULL);
                assert_true(count <= 2000);
                boundary_layers(&of[k].solid, dimensions, 1, 100, x);
                for (size_t i = 0; i < 3 * count; i++)
                    sum += (double)(x[i] * x[i]);
                check_near((double)count / of[k].volume, 1, 0.015, "volume");
                check_near((sum / (double)count + of[k].own) / of[k].square, 1, 0.02, "mean square");
            }
        }
}

typedef struct Weight {
    double mean, rms; /* of rest density */
} Weight;

/* The density that the matter would give if it were not particles. */
static double matter_density(const SolidDef *solid, const double p[3], double h, double step)
{
    double sum = 0;
    for (double dx = -h; dx <= h; dx += step)
        for (double dy = -h; dy <= h; dy += step)
            for (double dz = -h; dz <= h; dz += step) {
                const double at[3] = {p[0] + dx, p[1] + dy, p[2] + dz};
                if (is_matter(solid, 3, at))
                    sum += density_kernels[0].value(sqrt(dx * dx + dy * dy + dz * dz), h);
            }
    return sum * step * step * step;
}

/* What the layers give in front of the surface less what the matter would. */
static Weight weigh(const SolidDef *solid)
{
    enum { POINTS = 300 };
    const double s = 0.05, h = 2.1 * s;
    const size_t count = boundary_layers(solid, 3, s, h, NULL);
    float *x = malloc(3 * count * sizeof *x);
    Lattice lattice;
    uint32_t seed = 9;
    Weight weight = {0};
    lattice_calibrate(3, s, h, &density_kernels[0], &density_kernels[0], &lattice);
    boundary_layers(solid, 3, s, h, x);
    for (int points = 0; points < POINTS;) {
        double p[3], n = 0;
        random_point(&seed, 3, 1.5, p);
        const double d = solid_distance(solid, 3, p);
        if (d < 0.3 * s || d > 1.5 * s)
            continue;
        for (size_t i = 0; i < count; i++)
            n += density_kernels[0].value(
                hypot(hypot(p[0] - x[3 * i], p[1] - x[3 * i + 1]), p[2] - x[3 * i + 2]), h);
        const double error =
            lattice.density_scale * n / lattice.number_density - matter_density(solid, p, h, s / 5);
        weight.mean += error / POINTS;
        weight.rms += error * error / POINTS;
        points++;
    }
    free(x);
    weight.rms = sqrt(weight.rms);
    return weight;
}

/* A round solid's layers weigh as much, and are as smooth, as those of the block, which are a lattice. */
static void layers_weigh_as_a_lattice_does(void **state)
{
    (void)state;
    const Weight block = weigh(&shapes[1]);
    for (int k = 0; k < SHAPES; k++) {
        const Weight weight = weigh(&shapes[k]);
        printf("%s: density by its layers less that of its matter: mean %.2f %%, rms %.2f %% of rest\n",
               solid_name(shapes[k].kind), 100 * weight.mean, 100 * weight.rms);
        check_near(weight.mean, block.mean, 0.006, "mean");
        assert_true(weight.rms < block.rms + 0.006);
    }
}

/* A plate of minimal thickness, moving and turning; particles fast enough to cross in a step. */
static void the_guard_lets_nothing_through(void **state)
{
    (void)state;
    SolidDef plate = {.kind = SOLID_BOX, .centre = {0, 1, 0}, .size = {3, 0.05, 3}, .axis = {0, 1, 0}};
    add_solid_motion(&plate,
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.3, .frequency = 2});
    add_solid_motion(&plate,
                     (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 10, .frequency = 3});
    uint32_t seed = 4;
    const double dt = 0.01;
    int held = 0;
    enum { COUNT = 200, STEPS = 200 };
    for (int n = 0; n < COUNT; n++) {
        float x[3] = {(float)fixture_random(&seed) - 0.5f, (float)(n % 2 ? 1.5 : 0.5),
                      (float)fixture_random(&seed) - 0.5f};
        for (int i = 0; i < STEPS; i++) {
            SolidStep step;
            solid_step_make(&plate, i * dt, (i + 1) * dt, &step);
            const float before[3] = {x[0], x[1], x[2]}, pull = n % 2 ? -20.0f : 20.0f;
            float v[3] = {0.1f, pull, 0}, in_plate[3];
            x[1] += pull * (float)dt; /* four times the plate's thickness */
            if (solid_guard(&plate, &step, 3, before, x, v)) {
                float wall[3];
                held++;
                solid_velocity_at(&step.end, x, wall);
                const float normal[3] = {step.end.r[0][1], step.end.r[1][1], step.end.r[2][1]};
                float into = 0;
                for (int k = 0; k < 3; k++)
                    into += (v[k] - wall[k]) * normal[k] * (n % 2 ? 1.0f : -1.0f);
                assert_true(into > -1e-3f);
            }
            solid_from_box(&step.end, x, in_plate);
            const float side = n % 2 ? in_plate[1] : -in_plate[1];
            if (side < 0.0249f)
                fail_msg("particle %d came to the other side at step %d: %g m from the middle", n, i, side);
        }
    }
    assert_true(held > COUNT * STEPS / 2);
}

/* Paths of all lengths about fixed, turned shapes: particles reported as beside need no guard, and most
   unguarded particles are reported so. */
static void what_lies_beside_is_not_held(void **state)
{
    (void)state;
    uint32_t seed = 5;
    for (int k = 0; k < SHAPES; k++)
        for (int dimensions = shapes[k].kind == SOLID_CYLINDER ? 3 : 2; dimensions <= 3; dimensions++) {
            int told = 0, left = 0;
            SolidStep step;
            solid_step_make(&shapes[k], 0, 0.01, &step);
            for (int n = 0; n < 20000; n++) {
                double from[3], way[3];
                random_point(&seed, dimensions, 2.5, from);
                random_point(&seed, dimensions, n % 2 ? 1 : 0.05, way);
                const float before[3] = {(float)from[0], (float)from[1], (float)from[2]};
                float x[3], v[3] = {0};
                for (int i = 0; i < 3; i++)
                    x[i] = (float)(from[i] + way[i]);
                const WayBounds bounds = way_bounds(before, x);
                const bool beside = solid_step_beside(&step, dimensions, &bounds);
                const bool held = solid_guard(&shapes[k], &step, dimensions, before, x, v);
                assert_false(beside && held);
                told += beside;
                left += !held;
            }
            assert_true(told > left / 2);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_to_the_nearest_matter),
        cmocka_unit_test(poses_follow_the_def),
        cmocka_unit_test(layers_fill_the_matter),
        cmocka_unit_test(a_small_solid_has_its_volume),
        cmocka_unit_test(layers_weigh_as_a_lattice_does),
        cmocka_unit_test(the_guard_lets_nothing_through),
        cmocka_unit_test(what_lies_beside_is_not_held),
    };
    return cmocka_run_group_tests_name("sim.solid", tests, NULL, NULL);
}
