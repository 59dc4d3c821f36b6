/* The orientation of a device, from readings of a synthetic sensor with known pose. Noise and bias are of
   the Bosch BMI055, the DualShock 4's sensor according to teardowns; the DualSense has a similar sensor.
   Gyro: 0.014 degrees/s/sqrt(Hz), at the filter's 47 Hz 0.12 degrees/s. Zero-rate offset 1 degree/s,
   after the device's calibration 0.3 degrees/s: the effect of 20 K. Accelerometer: 150 ug/sqrt(Hz), 1.3
   mg. Readings are rounded to the reports' 1/16 degree/s and 1/8192 g. */
#include "tests/tolerance.h"

#include "app/input/device/device.h"
#include "sim/def.h"

#include <string.h>

static const double degrees = 180 / M_PI, radians = M_PI / 180, g = 9.80665, DT = 0.004;
static const double GYRO_NOISE = 0.12, ACCELEROMETER_NOISE = 0.0013, BIAS = 0.3, RAW_BIAS = 1;
enum { X, Y, Z };

static uint64_t seed;

static double uniform(void) /* 0 .. 1 */
{
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17; /* after: Marsaglia, Xorshift RNGs, 2003 */
    return (double)(seed >> 11) * 0x1p-53;
}

static double normal(void) /* Irwin and Hall: the sum of twelve has a variance of 1 */
{
    double sum = -6;
    for (int i = 0; i < 12; i++)
        sum += uniform();
    return sum;
}

/* A device in somebody's hand. */
typedef struct Sensor {
    Orientation orientation;
    double time;
    double pose[4]; /* the true pose */
    double bias[3]; /* degrees/s */
    double noise;   /* of the columns above */
} Sensor;

static Sensor sensor_at_rest(double bias, double noise)
{
    seed = 88172645463325252U;
    return (Sensor){.orientation = orientation_start(),
                    .pose = {0, 0, 0, 1},
                    .bias = {bias, -bias, bias},
                    .noise = noise};
}

/* The next report: the device turns by `rate` (degrees/s, its own axes) and is pushed (m/s2, the world's). */
static void sensor_step(Sensor *sensor, const double rate[3], const double push[3])
{
    double turn[3], outside[3], said[3], specific_force[3];
    for (int k = 0; k < 3; k++)
        turn[k] = rate[k] * radians * DT;
    quat_rotate(sensor->pose, turn, outside);
    quat_turn(outside, sensor->pose);
    sensor->time += DT;
    quat_rotate_inverse(sensor->pose, (double[]){push[X], push[Y] + g, push[Z]}, specific_force);
    for (int k = 0; k < 3; k++) {
        const double degrees_s = rate[k] + sensor->bias[k] + sensor->noise * GYRO_NOISE * normal();
        said[k] = round(degrees_s * 16) / 16 * radians;
        specific_force[k] =
            round((specific_force[k] / g + sensor->noise * ACCELEROMETER_NOISE * normal()) * 8192) / 8192 * g;
    }
    assert_true(orientation_update(&sensor->orientation, sensor->time, said, specific_force));
}

static void lie_still(Sensor *sensor, double seconds)
{
    const double end = sensor->time + seconds - DT / 2;
    while (sensor->time < end)
        sensor_step(sensor, (double[3]){0}, (double[3]){0});
}

/* About an axis of its own, so many degrees in so many seconds, gently begun and ended. */
static void turn_about(Sensor *sensor, const double axis[3], double angle, double seconds)
{
    const int steps = (int)lround(seconds / DT);
    for (int i = 0; i < steps; i++) {
        const double speed = angle / seconds * (1 - cos(2 * M_PI * (i + 0.5) / steps));
        sensor_step(sensor, (double[]){speed * axis[X], speed * axis[Y], speed * axis[Z]}, (double[3]){0});
    }
}

/* Degrees of the turn between two quaternions. */
static double between(const double a[4], const double b[4])
{
    double part[3];
    for (int k = 0; k < 3; k++) { /* the vector of conjugate(a) b */
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        part[k] = a[3] * b[k] - b[3] * a[k] - (a[i] * b[j] - a[j] * b[i]);
    }
    const double sine = sqrt(part[0] * part[0] + part[1] * part[1] + part[2] * part[2]);
    return 2 * asin(fmin(sine, 1)) * degrees;
}

/* Returns how far off it is, degrees. */
static double check_pose(const Sensor *sensor, double tolerance, const char *what)
{
    double turned[4];
    orientation_turned(&sensor->orientation, turned);
    const double off = between(turned, sensor->pose);
    check_near(off, 0, tolerance, what);
    return off;
}

static const double axes[][3] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},          {-1, 0, 0},
                                 {0, -1, 0}, {0, 0, -1}, {0.6, -0.48, 0.64}, {-0.6, 0.64, 0.48}};
enum { AXES = sizeof axes / sizeof *axes };

static void a_turn_is_followed(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < AXES; i++)
        for (int angle = 10; angle < 100; angle += 35) {
            Sensor sensor = sensor_at_rest(BIAS, 1);
            lie_still(&sensor, 1);
            turn_about(&sensor, axes[i], angle, 0.4);
            worst = fmax(worst, check_pose(&sensor, 0.5, "at the end of the turn"));
            lie_still(&sensor, 1);
            worst = fmax(worst, check_pose(&sensor, 0.5, "a second later"));
        }
    print_message("turns: at most %.3f degrees off\n", worst);
}

/* Not a moment to learn a bias. */
static void a_turn_is_followed_from_the_first_report(void **state)
{
    (void)state;
    for (int i = 0; i < AXES; i++) {
        Sensor sensor = sensor_at_rest(BIAS, 1);
        turn_about(&sensor, axes[i], 40, 0.5);
        check_pose(&sensor, 1, "at the end of the turn");
    }
}

/* Accelerometer only: the device was tilted before plugging in. */
static void the_first_report_gives_the_tilt(void **state)
{
    (void)state;
    static const double tilt[3] = {0.35, 0, -0.2};
    Sensor sensor = sensor_at_rest(0, 0);
    quat_turn(tilt, sensor.pose);
    lie_still(&sensor, DT);
    check_pose(&sensor, 0.02, "the tilt");
}

static void at_rest_it_does_not_drift(void **state)
{
    (void)state;
    Sensor sensor = sensor_at_rest(BIAS, 1);
    double worst = 0, turned[4] = {0, 0, 0, 1};
    for (int i = 0; i < 60 / DT; i++) {
        sensor_step(&sensor, (double[3]){0}, (double[3]){0});
        orientation_turned(&sensor.orientation, turned);
        worst = fmax(worst, between(turned, sensor.pose));
    }
    assert_true(sensor.orientation.resting);
    print_message("a minute at rest: at most %.3f degrees off, %.3f at its end\n", worst,
                  between(turned, sensor.pose));
    check_near(worst, 0, 0.5, "the farthest in a minute");
    check_near(between(turned, sensor.pose), 0, 0.1, "after a minute");
    for (int k = 0; k < 3; k++)
        check_near(sensor.orientation.bias[k] * degrees, sensor.bias[k], 0.02, "the bias");
}

/* Like a device with lost calibration. */
/* An accelerometer with too large readings, hardly trusted before the device has lain still: then the
   size of a g is learned. */
static void gravity_is_what_it_feels(void **state)
{
    (void)state;
    static const double still[3] = {0}, specific_force[3] = {0, 1.14 * 9.80665, 0};
    Orientation orientation = orientation_start();
    for (int i = 1; i <= 500; i++)
        assert_true(orientation_update(&orientation, i * DT, still, specific_force));
    check_near(orientation.gravity, specific_force[Y], 1e-6, "m/s2");
}

static void a_large_bias_is_learned_too(void **state)
{
    (void)state;
    Sensor sensor = sensor_at_rest(RAW_BIAS, 1);
    lie_still(&sensor, 60);
    check_pose(&sensor, 0.5, "after a minute");
}

/* In a trembling hand learning stops: earlier values stay in use. */
static void in_the_hand_it_hardly_drifts(void **state)
{
    (void)state;
    Sensor sensor = sensor_at_rest(BIAS, 1);
    lie_still(&sensor, 10);
    for (int i = 0; i < 60 / DT; i++) {
        double rate[3];
        for (int k = 0; k < 3; k++)
            rate[k] = 4 * sin(2 * M_PI * (8 + k) * i * DT);
        sensor_step(&sensor, rate, (double[3]){0});
    }
    assert_false(sensor.orientation.resting);
    const double off = check_pose(&sensor, 0.5, "after a minute");
    print_message("a minute in a trembling hand: %.3f degrees off\n", off);
}

static void shaken_it_stays_upright(void **state)
{
    (void)state;
    double worst = 0;
    Sensor sensor = sensor_at_rest(BIAS, 1);
    lie_still(&sensor, 1);
    for (int i = 0; i < 10 / DT; i++)
        sensor_step(&sensor, (double[3]){0}, (double[]){1.5 * g * sin(2 * M_PI * 2 * i * DT), 0, 0});
    worst = check_pose(&sensor, 1, "while shaken");
    for (int i = 0; i < 0.6 / DT; i++) /* a single lasting push */
        sensor_step(&sensor, (double[3]){0}, (double[]){0, 0, 0.8 * g});
    worst = fmax(worst, check_pose(&sensor, 1, "pushed"));
    print_message("shaken: %.3f degrees off\n", worst);
}

static void a_slow_turn_is_no_bias(void **state)
{
    (void)state;
    Sensor sensor = sensor_at_rest(BIAS, 1);
    lie_still(&sensor, 2);
    for (int i = 0; i < 10 / DT; i++)
        sensor_step(&sensor, (double[]){0, 3, 0}, (double[3]){0});
    check_pose(&sensor, 0.5, "after ten seconds");
}

/* Held at some angle, with the user in a new seat: a tilt of the top away from the user is again a tilt
   away. */
static void any_pose_can_be_the_neutral_one(void **state)
{
    (void)state;
    double turned[4], away[4] = {0, 0, 0, 1};
    Sensor sensor = sensor_at_rest(BIAS, 1);
    lie_still(&sensor, 1);
    turn_about(&sensor, (double[]){0, 1, 0}, 130, 0.5);
    turn_about(&sensor, (double[]){1, 0, 0}, 35, 0.5);
    orientation_neutral(&sensor.orientation);
    orientation_turned(&sensor.orientation, turned);
    check_near(between(turned, (double[]){0, 0, 0, 1}), 0, 1e-6, "at once");
    turn_about(&sensor, (double[]){-1, 0, 0}, 25, 0.5); /* about the device's right side, the user's right */
    orientation_turned(&sensor.orientation, turned);
    quat_turn((double[]){-25 * radians, 0, 0}, away);
    check_near(between(turned, away), 0, 1, "the turn");
}

/* With the right side up, the device still has a heading. */
static void neutral_on_its_side(void **state)
{
    (void)state;
    double turned[4], expected[4] = {0, 0, 0, 1};
    Sensor sensor = sensor_at_rest(0, 0);
    lie_still(&sensor, 1);
    turn_about(&sensor, (double[]){0, 0, 1}, 90, 0.5);
    orientation_neutral(&sensor.orientation);
    turn_about(&sensor, (double[]){0, 1, 0}, 20, 0.5); /* its top points to the left now: -x */
    orientation_turned(&sensor.orientation, turned);
    quat_turn((double[]){-20 * radians, 0, 0}, expected);
    check_near(between(turned, expected), 0, 0.2, "the turn");
}

static void down_is_where_things_fall(void **state)
{
    (void)state;
    double down[3];
    Sensor sensor = sensor_at_rest(0, 0);
    lie_still(&sensor, 1);
    orientation_down(&sensor.orientation, down);
    check_vector(down, 0, -1, 0, 1e-3, "down");
    turn_about(&sensor, (double[]){0, 0, -1}, 90, 0.5); /* to the right */
    orientation_down(&sensor.orientation, down);
    check_vector(down, 1, 0, 0, 1e-2, "down");
}

/* A second without reports, during a tilt: the accelerometer is trusted at once afterwards. */
static void after_a_gap_the_tilt_is_right(void **state)
{
    (void)state;
    static const double tilt[3] = {0.3, 0, 0.2}, still[3] = {0};
    Sensor sensor = sensor_at_rest(0, 1);
    lie_still(&sensor, 5);
    quat_turn(tilt, sensor.pose);
    sensor.time += 1;
    lie_still(&sensor, 0.1);
    check_pose(&sensor, 1, "the tilt");

    /* A device in rotation at the last report is not turned further for hours. */
    Orientation orientation = orientation_start();
    double turned[4];
    const double upright[3] = {0, g, 0}, fast[3] = {0, 1, 0};
    assert_true(orientation_update(&orientation, 1, still, upright));
    assert_true(orientation_update(&orientation, 10000, fast, upright));
    orientation_turned(&orientation, turned);
    assert_true(between(turned, (double[]){0, 0, 0, 1}) < 1.01 * ORIENTATION_GAP * degrees);
}

static void time_that_does_not_go_on_turns_nothing(void **state)
{
    (void)state;
    static const double fast[3] = {0, 2, 0}, upright[3] = {0, 9.80665, 0}, times[] = {5, 5, 4.9, -1e9, -1e9};
    Orientation orientation = orientation_start();
    double turned[4];
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        assert_true(orientation_update(&orientation, times[i], fast, upright));
        orientation_turned(&orientation, turned);
        check_near(between(turned, (double[]){0, 0, 0, 1}), 0, 1e-6, "the turn");
    }
    assert_true(orientation_update(&orientation, -1e9 + 0.01, fast, upright));
    orientation_turned(&orientation, turned);
    check_near(between(turned, (double[]){0, 0, 0, 1}), 0.02 * degrees, 0.01, "the turn");
}

static void what_is_not_finite_changes_nothing(void **state)
{
    (void)state;
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e300};
    Sensor sensor = sensor_at_rest(BIAS, 1);
    lie_still(&sensor, 1);
    const Orientation before = sensor.orientation;
    for (int place = 0; place < 7; place++)
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            double v[7] = {sensor.time + DT, 0.1, 0.1, 0.1, 0, g, 0};
            if (place == 0 && isfinite(bad[i]))
                continue;
            v[place] = bad[i];
            assert_false(orientation_update(&sensor.orientation, v[0], &v[1], &v[4]));
            assert_memory_equal(&sensor.orientation, &before, sizeof before);
        }
}

/* A device in free fall, without readings, or upside down: always a pose. */
static void anything_gives_a_pose(void **state)
{
    (void)state;
    Orientation orientation = orientation_start();
    double time = 0;
    seed = 1;
    for (int i = 0; i < 100000; i++) {
        double rate[3], specific_force[3], norm = 0, turned[4];
        for (int k = 0; k < 3; k++) {
            rate[k] = i % 7 ? 100 * (uniform() - 0.5) : 0;
            specific_force[k] = i % 5 ? 40 * (uniform() - 0.5) : 0;
        }
        if (i % 11 == 0)
            specific_force[X] = specific_force[Z] = 0, specific_force[Y] = -g;
        time += 0.1 * (uniform() - 0.1);
        orientation_update(&orientation, time, rate, specific_force);
        if (i % 1000 == 0)
            orientation_neutral(&orientation);
        orientation_turned(&orientation, turned);
        for (int k = 0; k < 4; k++)
            norm += turned[k] * turned[k];
        check_near(norm, 1, 1e-9, "the quaternion's length");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turn_is_followed),
        cmocka_unit_test(a_turn_is_followed_from_the_first_report),
        cmocka_unit_test(the_first_report_gives_the_tilt),
        cmocka_unit_test(at_rest_it_does_not_drift),
        cmocka_unit_test(gravity_is_what_it_feels),
        cmocka_unit_test(a_large_bias_is_learned_too),
        cmocka_unit_test(in_the_hand_it_hardly_drifts),
        cmocka_unit_test(shaken_it_stays_upright),
        cmocka_unit_test(a_slow_turn_is_no_bias),
        cmocka_unit_test(any_pose_can_be_the_neutral_one),
        cmocka_unit_test(neutral_on_its_side),
        cmocka_unit_test(down_is_where_things_fall),
        cmocka_unit_test(after_a_gap_the_tilt_is_right),
        cmocka_unit_test(time_that_does_not_go_on_turns_nothing),
        cmocka_unit_test(what_is_not_finite_changes_nothing),
        cmocka_unit_test(anything_gives_a_pose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
