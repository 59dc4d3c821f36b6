/* Sensors against weighted least squares over all particles, and against fields that are known. */
#include "tests/probe/cloud.h"

#include "app/run/measure/measure.h"

static unsigned seed = 1;

static double number(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed >> 8) / 16777216.0;
}

/* ---- the reference: least squares for a + b . (x - at), by elimination, over all particles ---- */

static void solve(int n, double m[4][5])
{
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p; r < n; r++)
            best = fabs(m[r][p]) > fabs(m[best][p]) ? r : best;
        for (int c = 0; c <= 4; c++) {
            const double kept = m[p][c];
            m[p][c] = m[best][c];
            m[best][c] = kept;
        }
        for (int r = 0; r < n; r++)
            for (int c = 4; r != p && c >= p; c--)
                m[r][c] -= m[r][p] / m[p][p] * m[p][c];
    }
}

/* The vector from the sensor, across periodic sides the shorter way. */
static double away(const WorldDef *def, const Sensor *sensor, const float *x, double d[3])
{
    double r2 = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = (double)x[k] - sensor->at[k];
        if (def->periodic[k])
            d[k] -= def->box_size[k] * round(d[k] / def->box_size[k]);
        r2 += d[k] * d[k];
    }
    return sqrt(r2);
}

/* The pressure. The sensors add 1e-4 of the radius squared times the weights to the moments about the
   mean, so the bound is for a particle's distance from the mean. */
static double reference(const WorldDef *def, const Sensor *sensor, const Cloud *cloud, double *weights)
{
    const int n = def->dimensions + 1;
    double mean[3] = {0}, d[3], w = 0, m[4][5] = {{0}};
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < cloud->count; i++) {
            const double q = away(def, sensor, cloud->position + 4 * i, d) / sensor->radius;
            const double v = q < 1 ? pow(1 - q, 4) * (1 + 4 * q) : 0;
            const double basis[4] = {1, d[0] - mean[0], d[1] - mean[1], d[2] - mean[2]};
            w += pass == 0 ? v : 0;
            for (int a = 0; pass == 1 && a < n; a++) {
                for (int b = 0; b < n; b++)
                    m[a][b] += v * basis[a] * basis[b];
                m[a][4] += v * basis[a] * (double)cloud->pressure[i];
            }
            for (int k = 0; pass == 0 && k < 3; k++)
                mean[k] += v * d[k];
            if (pass == 0 && i + 1 == cloud->count)
                for (int k = 0; k < 3; k++)
                    mean[k] /= w;
        }
    for (int k = 1; k < n; k++)
        m[k][k] += 1e-4 * sensor->radius * sensor->radius * w;
    solve(n, m);
    *weights = w;
    double value = m[0][4] / m[0][0];
    for (int k = 1; k < n; k++)
        value -= mean[k - 1] * m[k][4] / m[k][k];
    return value;
}

static void compare(const WorldDef *def, const Cloud *cloud)
{
    enum { SENSORS = 60 };
    Sensor sensor[SENSORS];
    SensorReading reading[SENSORS];
    for (int i = 0; i < SENSORS; i++) {
        sensor[i] = (Sensor){.radius = number(0.12, 0.3), .wants = ~0u};
        for (int k = 0; k < def->dimensions; k++)
            sensor[i].at[k] = number(k == 1 ? 0 : -0.5, k == 1 ? 1 : 0.5);
    }
    Sensors *sensors = sensors_create(sensor, SENSORS, def);
    sensors_read(sensors, cloud, reading);
    for (int i = 0; i < SENSORS; i++) {
        double weights;
        const double right = reference(def, &sensor[i], cloud, &weights);
        near(reading[i].pressure, right * fmin(2 * reading[i].filling, 1), 1e-9 * 1000);
        assert_true(weights > 0 && reading[i].filling > 0.5);
    }
    sensors_destroy(sensors);
}

static Cloud scattered(const WorldDef *def, int count)
{
    Cloud cloud = cloud_of(def);
    for (int i = 0; i < count; i++)
        cloud_add(&cloud, number(-0.5, 0.5), number(0, 1), def->dimensions == 3 ? number(-0.5, 0.5) : 0,
                  number(-1000, 1000));
    return cloud;
}

static void are_least_squares_over_all(void **state)
{
    (void)state;
    WorldDef def = cloud_box(3, 0.045);
    const Cloud in_space = scattered(&def, 12000);
    compare(&def, &in_space);
    def.periodic[0] = def.periodic[2] = true;
    compare(&def, &in_space);
    def = cloud_box(2, 0.03);
    const Cloud flat = scattered(&def, 1300);
    compare(&def, &flat);
    def.periodic[1] = true;
    compare(&def, &flat);
}

/* ---- fluid at rest ---- */

static SensorReading read_at(const WorldDef *def, const Cloud *cloud, double x, double y, double z,
                             double radius)
{
    const Sensor sensor = {{x, y, z}, radius, ~0u};
    SensorReading reading;
    Sensors *sensors = sensors_create(&sensor, 1, def);
    sensors_read(sensors, cloud, &reading);
    sensors_destroy(sensors);
    return reading;
}

/* A field that is linear in space, on the floor, at a wall, in an edge, in a corner: Shepard's sum would be
   off by a quarter of the radius times the slope, 9810 * 0.0375 Pa = 368 Pa. */
static void what_is_linear_is_exact_at_walls(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.04), flat = cloud_box(2, 0.02);
    const double places[][3] = {{0, 0.3, 0}, {0, 0, 0}, {0.5, 0.3, 0}, {0.5, 0, 0}, {-0.5, 0, 0.5}};
    for (int i = 0; i < 5; i++) {
        const double *x = places[i], right = 9810 * (0.6 - x[1]);
        const Cloud cloud = cloud_at_rest(&def, 0.6);
        SensorReading reading = read_at(&def, &cloud, x[0], x[1], x[2], 0.16);
        near(reading.pressure, right, x[1] > 0 ? 1 : 15);
        near(reading.filling, 1, 0.03);
        near(reading.density, 1000, 1e-3);
        near(reading.velocity[0], x[1], 0.002);
        near(reading.velocity[1], -x[0], 0.002);
        if (x[2] != 0)
            continue;
        const Cloud plane = cloud_at_rest(&flat, 0.6);
        reading = read_at(&flat, &plane, x[0], x[1], 0, 0.08);
        near(reading.pressure, right, x[1] > 0 ? 1 : 8);
        near(reading.filling, 1, 0.03);
    }
}

/* At the surface half of the ball is full, and above there is nothing to have a density. */
static void the_surface_is_half_full(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.04);
    const Cloud cloud = cloud_at_rest(&def, 0.6);
    SensorReading reading = read_at(&def, &cloud, 0.02, 0.6, 0, 0.12);
    near(reading.filling, 0.5, 0.02);
    near(reading.pressure, 0, 30);
    reading = read_at(&def, &cloud, 0.5, 0.6, 0, 0.12); /* on the wall too */
    near(reading.filling, 0.5, 0.02);
    reading = read_at(&def, &cloud, 0, 0.65, 0, 0.12);
    assert_true(reading.filling < 0.3 && isnan(reading.density) && isnan(reading.velocity[0]));
    reading = read_at(&def, &cloud, 0, 0.9, 0, 0.12);
    assert_true(reading.filling == 0 && reading.pressure == 0);
}

/* A drop never reports more than the drop's total, however few the particles. */
static void few_particles_are_not_extrapolated(void **state)
{
    (void)state;
    const WorldDef def = cloud_box(3, 0.04);
    Cloud cloud = cloud_of(&def);
    cloud_add(&cloud, 0.03, 0.5, 0, 100);
    near(read_at(&def, &cloud, 0, 0.5, 0, 0.12).pressure, 0, 100);
    cloud_add(&cloud, 0.031, 0.5, 0, 200); /* a slope of 1e5 Pa/m, over 1 mm */
    const double pressure = read_at(&def, &cloud, -0.06, 0.5, 0, 0.12).pressure;
    near(pressure, 0, 300);
    cloud.count = 0;
    assert_true(read_at(&def, &cloud, 0, 0.5, 0, 0.12).pressure == 0);
}

/* No fluid can be inside a solid: a sensor's ball on a solid's face is full with the fluid in front. */
static void solids_are_no_place_for_fluid(void **state)
{
    (void)state;
    WorldDef def = cloud_box(3, 0.05);
    def.solid_count = 1;
    def.solids[0] = (SolidDef){
        .kind = SOLID_BOX, .centre = {0.25, 0.5, 0}, .size = {0.5, 1, 1}, .axis = {0, 1, 0}, .angle_deg = 0};
    Cloud all = cloud_at_rest(&def, 0.6), cloud = cloud_of(&def);
    for (size_t i = 0, count = all.count; i < count; i++)
        if (all.position[4 * i] < 0)
            cloud_add(&cloud, (double)all.position[4 * i], (double)all.position[4 * i + 1],
                      (double)all.position[4 * i + 2], (double)all.pressure[i]);
    const SensorReading reading = read_at(&def, &cloud, 0, 0.3, 0, 0.16);
    near(reading.filling, 1, 0.03);
    near(reading.pressure, 9810 * 0.3, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(are_least_squares_over_all),    cmocka_unit_test(what_is_linear_is_exact_at_walls),
        cmocka_unit_test(the_surface_is_half_full),      cmocka_unit_test(few_particles_are_not_extrapolated),
        cmocka_unit_test(solids_are_no_place_for_fluid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
