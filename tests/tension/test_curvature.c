/* Surface tension by curvature against theory: pressure in a drop, oscillation, contact angle on a floor;
   invariants. */
#include "tests/sim/fixture.h"

#include "sim/def/fluids.h"
#include "sim/methods/wcsph/wcsph.h"

enum { MOST = 4000 };

static const double sigma = 0.072, spacing = 0.0005;
static float cloud[3 * MOST];

/* A ball or disc at (0, height, 0), pulled out by `stretch` along x; what is below the floor is left out. */
static WorldDef drop(int dimensions, double radius, double height, double stretch)
{
    static InitialState initial;
    WorldDef def = fixture_def(0.05, 0.03, 0.03);
    WcsphDef *own = wcsph_def(&def);
    strcpy(def.method, "wcsph");
    def.dimensions = dimensions;
    def.spacing = spacing;
    def.support = dimensions == 3 ? 3 : 3.5;
    def.sound_speed = 4;
    def.dt = 1.2e-4;
    def.tension_model = TENSION_CURVATURE;
    def.fluids[0].surface_tension = sigma;
    def.fluids[0].contact_angle = 90;
    memset(def.gravity, 0, sizeof def.gravity);
    strcpy(own->kernel, "wendland_c2");
    own->shifting = 0.2;
    own->delta_sph = 0.1;
    own->artificial_viscosity = 0.02;
    own->viscosity_form = VISCOSITY_RADIAL;

    uint32_t seed = 7;
    size_t count = 0;
    const int reach = (int)(radius / spacing) + 1, deep = dimensions == 3 ? reach : 0;
    for (int i = -reach; i < reach; i++)
        for (int j = -reach; j < reach; j++)
            for (int k = -deep; k < deep + (deep == 0); k++) {
                double x[3] = {i + 0.5, j + 0.5, deep > 0 ? k + 0.5 : 0}, r2 = 0;
                for (int a = 0; a < 3; a++) {
                    r2 += x[a] * x[a] * spacing * spacing;
                    x[a] = spacing * (x[a] + (a < dimensions ? 0.4 * (fixture_random(&seed) - 0.5) : 0));
                }
                if (r2 > radius * radius || (height == 0 && x[1] < 0))
                    continue;
                assert_true(count < MOST);
                cloud[3 * count] = (float)(x[0] * stretch);
                cloud[3 * count + 1] = (float)(height + x[1] / stretch);
                cloud[3 * count++ + 2] = (float)x[2];
            }
    initial = (InitialState){.count = count, .position = cloud};
    def.initial = &initial;
    return def;
}

typedef struct Shape {
    double centre[3], moment[3]; /* of the particles, m; m2 about the centre */
    double pressure;             /* mean within half the radius, Pa */
    double area;                 /* volume in three dimensions */
} Shape;

static Shape shape_of(const World *world, const WorldDef *def, double radius)
{
    Shape shape = {0};
    State s = fixture_read((World *)world);
    for (size_t i = 0; i < s.count; i++)
        for (int k = 0; k < 3; k++)
            shape.centre[k] += (double)s.position[4 * i + k] / (double)s.count;
    double inner = 0;
    for (size_t i = 0; i < s.count; i++) {
        double r2 = 0;
        for (int k = 0; k < 3; k++) {
            const double x = (double)s.position[4 * i + k] - shape.centre[k];
            shape.moment[k] += x * x / (double)s.count;
            r2 += x * x;
        }
        if (r2 < 0.25 * radius * radius) {
            shape.pressure += (double)s.pressure[i];
            inner++;
        }
    }
    shape.pressure /= inner;
    shape.area = (double)s.count * pow(def->spacing, def->dimensions);
    fixture_free(&s);
    return shape;
}

static void pressure_in_a_drop(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const double wanted = dimensions == 3 ? 0.0036 : 0.006;
        WorldDef def = drop(dimensions, wanted, 0.015, 1);
        def.fluids[0].viscosity = 0.05;
        World *world = fixture_world(&def);
        fixture_step(world, dimensions == 3 ? 200 : 700);
        double mean = 0;
        Shape shape;
        for (int k = 0; k < 10; k++) {
            fixture_step(world, dimensions == 3 ? 8 : 30);
            shape = shape_of(world, &def, wanted);
            mean += shape.pressure / 10;
        }
        const double radius = dimensions == 3 ? cbrt(shape.area * 3 / (4 * M_PI)) : sqrt(shape.area / M_PI),
                     right = (dimensions - 1) * sigma / radius;
        printf("%dD, radius of %.1f spacings: %.2f Pa, right %.2f, %.1f %%\n", dimensions, radius / spacing,
               mean, right, 100 * (mean / right - 1));
        assert_true(fabs(mean / right - 1) < (dimensions == 3 ? 0.13 : 0.1));
        world_destroy(world);
    }
}

/* An ellipse swings at sqrt(6 sigma / (rho R^3)): a quarter of a period is where it is round; no momentum of
   note comes up. */
static void drop_swings(void **state)
{
    (void)state;
    WorldDef def = drop(2, 0.005, 0.015, 1.1);
    World *world = fixture_world(&def);
    double before = 1, round = 0, time = 0;
    const double least = 0.01;
    int crossings = 0;
    double first = 0;
    while (crossings < 3 && time < 0.5) {
        fixture_step(world, 5);
        time += 5 * def.dt;
        const Shape shape = shape_of(world, &def, 0.005);
        const double now = sqrt(shape.moment[0]) - sqrt(shape.moment[1]);
        if (now * before < 0 && time - round > least) {
            round = time;
            first = crossings++ ? first : time;
        }
        before = now;
    }
    const Shape shape = shape_of(world, &def, 0.005);
    const double radius = sqrt(shape.area / M_PI),
                 right = sqrt(6 * sigma / (1000 * radius * radius * radius));
    const double omega = 2 * M_PI / (round - first);
    WorldSums sums;
    world_sums(world, &sums);
    const double speed =
        sqrt(sums.momentum[0] * sums.momentum[0] + sums.momentum[1] * sums.momentum[1]) / sums.mass;
    printf("swings at %.2f rad/s, right %.2f, %.1f %%; drifts at %.2g m/s\n", omega, right,
           100 * (omega / right - 1), speed);
    assert_int_equal(crossings, 3);
    assert_true(fabs(omega / right - 1) < 0.1);
    assert_true(speed < 1e-6 * 0.1 * radius * right); /* of the greatest speed */
    world_destroy(world);
}

/* The rate at which the heights of a drop's swings fade: of a straight line through their logarithms. */
static double fading(World *world, const WorldDef *def, double radius, int swings)
{
    double before = 1, height = 0, at = 0, time = 0, sum[4] = {0};
    int count = -1; /* the first is the start's */
    while (count < swings && time < 2) {
        fixture_step(world, 10);
        time += 10 * def->dt;
        const Shape shape = shape_of(world, def, radius);
        const double now = sqrt(shape.moment[0]) - sqrt(shape.moment[1]);
        if (now * before < 0) {
            const double terms[4] = {at, log(height), at * at, at * log(height)};
            for (int k = 0; k < 4 && count >= 0; k++)
                sum[k] += terms[k];
            count++;
            height = 0;
        }
        if (fabs(now) > height) {
            height = fabs(now);
            at = time;
        }
        before = now;
    }
    assert_int_equal(count, swings);
    return -(count * sum[3] - sum[0] * sum[1]) / (count * sum[2] - sum[0] * sum[0]);
}

/* At 2 n (n - 1) nu / R^2, n = 2: Lamb, Hydrodynamics, 355, in the plane. A force that is the same in any
   crowd of the surface's particles gives half of the energy back. */
static void a_swing_fades(void **state)
{
    (void)state;
    WorldDef def = drop(2, 0.005, 0.015, 1.1);
    def.fluids[0].viscosity = 0.0175;
    World *world = fixture_world(&def);
    const double area = shape_of(world, &def, 0.005).area, rate = fading(world, &def, 0.005, 8),
                 right = 4 * def.fluids[0].viscosity / 1000 / (area / M_PI);
    world_destroy(world);
    printf("a swing fades at %.2f 1/s, right %.2f, %.1f %%\n", rate, right, 100 * (rate / right - 1));
    assert_true(fabs(rate / right - 1) < 0.25);
}

/* The height of a segment's centre of mass over the root of its area, of that angle. */
static double segment(double angle)
{
    const double area = angle - sin(angle) * cos(angle), s = sin(angle);
    return (2 * s * s * s / (3 * area) - cos(angle)) / sqrt(area);
}

static double angle_of(double height, double area)
{
    double low = 0.01, high = M_PI;
    for (int k = 0; k < 60; k++) {
        const double middle = (low + high) / 2;
        *(segment(middle) < height / sqrt(area) ? &low : &high) = middle;
    }
    return low * 180 / M_PI;
}

/* A drop starting as a half disc on a floor with the angle, after a number of steps: the angle, in the
   mean over the last thousand. The drop does not walk. */
static double angle_after(double angle, int steps)
{
    WorldDef def = drop(2, 0.006, 0, 1);
    def.fluids[0].viscosity = 0.15;
    def.fluids[0].contact_angle = angle;
    World *world = fixture_world(&def);
    const double start = shape_of(world, &def, 0.006).centre[0];
    double mean = 0, walk = 0;
    fixture_step(world, steps - 1000);
    for (int m = 0; m < 20; m++) {
        fixture_step(world, 50);
        const Shape shape = shape_of(world, &def, 0.006);
        walk = shape.centre[0] - start;
        mean += angle_of(shape.centre[1], shape.area) / 20;
    }
    world_destroy(world);
    printf("contact angle of %.0f: %.1f degrees, walks %.2g m\n", angle, mean, walk);
    assert_true(fabs(walk) < 0.1 * spacing);
    return mean;
}

static void angle_on_a_floor(void **state)
{
    (void)state;
    static const double angles[] = {60, 120};
    for (int k = 0; k < 2; k++)
        assert_true(fabs(angle_after(angles[k], 3600) - angles[k]) < 7);
}

/* At 0 degrees a drop ends as a film, at 180 it lets go of the floor; both stand. */
static void wholly_wet_and_dry(void **state)
{
    (void)state;
    assert_true(angle_after(0, 1600) < 40);
    assert_true(angle_after(180, 1600) > 150);
}

static void other_methods_refuse_it(void **state)
{
    (void)state;
    WorldDef def = drop(2, 0.004, 0.015, 1);
    Error error = {0};
    strcpy(def.method, "mueller");
    assert_null(world_create(&def, &error));
    assert_string_equal(error.message,
                        "method mueller has no surface tension by curvature; use method wcsph, or cohesion");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_in_a_drop), cmocka_unit_test(drop_swings),
        cmocka_unit_test(a_swing_fades),      cmocka_unit_test(angle_on_a_floor),
        cmocka_unit_test(wholly_wet_and_dry), cmocka_unit_test(other_methods_refuse_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
