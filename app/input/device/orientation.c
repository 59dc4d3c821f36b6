#include "app/input/device/device.h"

#include "sim/def.h"

#include <math.h>
#include <string.h>

static const double radians = M_PI / 180, standard_gravity = 9.80665;

/* Relative deviation from gravity, below which the accelerometer counts fully, and above which not at all. */
static const double gravity_sure = 0.02, gravity_unsure = 0.15;

enum { RESTS_MOST = 20 }; /* the bias is the mean of at most so many rests: it drifts with temperature */

Orientation orientation_start(void)
{
    return (Orientation){.pose = {0, 0, 0, 1}, .neutral = {0, 0, 0, 1}, .gravity = standard_gravity};
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Turns the pose by a rotation vector in the device's frame. */
static void turn_by(const double rotation[3], double pose[4])
{
    double outside[3];
    quat_rotate(pose, rotation, outside);
    quat_turn(outside, pose);
}

/* Returns 1 if only gravity is felt, 0 if the device is shaken or falls. */
static double trust(const Orientation *o, const double specific_force[3])
{
    const double off = fabs(length(specific_force) / o->gravity - 1);
    return off <= gravity_sure     ? 1
           : off >= gravity_unsure ? 0
                                   : (gravity_unsure - off) / (gravity_unsure - gravity_sure);
}

/* Computes the turn around a level axis that brings the felt gravity upright. */
static void to_upright(const Orientation *o, const double specific_force[3], double rotation[3])
{
    double up[3];
    quat_rotate(o->pose, specific_force, up);
    const double level = hypot(up[0], up[2]), angle = atan2(level, up[1]);
    rotation[0] = level > 0 ? -angle * up[2] / level : angle; /* upside down: any axis will do */
    rotation[1] = 0;
    rotation[2] = level > 0 ? angle * up[0] / level : 0;
}

/* Corrects the tilt: at first by the mean of all readings, later with the time constant. */
static void level_pose(Orientation *o, double dt, const double specific_force[3])
{
    double rotation[3];
    const double share = trust(o, specific_force) * fmax(dt / ORIENTATION_LEVELS, dt / (o->levelled_s + dt));
    if (!(share > 0))
        return;
    o->levelled_s += dt;
    to_upright(o, specific_force, rotation);
    for (int k = 0; k < 3; k++)
        rotation[k] *= fmin(share, 1);
    quat_turn(rotation, o->pose);
}

/* Returns the heading of the pose's right side, as a turn around the vertical. If the right side points up
   or down, the side away from the user is used. */
static void heading_of(const double pose[4], double out[4])
{
    double right[3], near[3];
    quat_rotate(pose, (const double[]){1, 0, 0}, right);
    quat_rotate(pose, (const double[]){0, 0, 1}, near);
    const double angle = fabs(right[1]) < 0.9 ? atan2(-right[2], right[0]) : atan2(near[0], near[2]);
    out[0] = out[2] = 0;
    out[1] = sin(angle / 2);
    out[3] = cos(angle / 2);
}

static void inverse(const double q[4], double out[4])
{
    for (int k = 0; k < 4; k++)
        out[k] = k < 3 ? -q[k] : q[k];
}

static void begin(Orientation *o, const double specific_force[3])
{
    double rotation[3];
    to_upright(o, specific_force, rotation);
    quat_turn(rotation, o->pose);
    o->begun = true;
}

static void window_add(RestWindow *window, double dt, const double rate[3], const double specific_force[3])
{
    const bool first = window->reports == 0;
    for (int k = 0; k < 3; k++) {
        window->rate_sum[k] += rate[k];
        window->rate_low[k] = first ? rate[k] : fmin(window->rate_low[k], rate[k]);
        window->rate_high[k] = first ? rate[k] : fmax(window->rate_high[k], rate[k]);
        window->acceleration_low[k] =
            first ? specific_force[k] : fmin(window->acceleration_low[k], specific_force[k]);
        window->acceleration_high[k] =
            first ? specific_force[k] : fmax(window->acceleration_high[k], specific_force[k]);
    }
    window->acceleration_sum += length(specific_force);
    window->seconds += dt;
    window->reports++;
}

static bool window_still(const Orientation *o)
{
    const RestWindow *window = &o->window;
    bool still = true;
    for (int k = 0; k < 3; k++)
        still =
            still && window->rate_high[k] - window->rate_low[k] < ORIENTATION_STEADY * radians &&
            fabs(window->rate_sum[k] / window->reports) < ORIENTATION_BIAS_MOST * radians &&
            window->acceleration_high[k] - window->acceleration_low[k] < ORIENTATION_STILL * standard_gravity;
    return still;
}

/* Updates the bias after a rest, and undoes the pose's drift during the rest. */
static void learn(Orientation *o)
{
    const RestWindow *window = &o->window;
    double excess[3], back[3];
    o->rests = o->rests < RESTS_MOST ? o->rests + 1 : RESTS_MOST;
    for (int k = 0; k < 3; k++) {
        excess[k] = window->rate_sum[k] / window->reports - o->bias[k];
        back[k] = -excess[k] * window->seconds;
        o->bias[k] += excess[k] / o->rests;
        o->rate[k] -= excess[k] / o->rests;
    }
    turn_by(back, o->pose);
    const double specific_force = window->acceleration_sum / window->reports;
    if (fabs(specific_force / standard_gravity - 1) < gravity_unsure)
        o->gravity += (specific_force - o->gravity) / o->rests;
}

static void watch_for_rest(Orientation *o, double dt, const double rate[3], const double specific_force[3])
{
    window_add(&o->window, dt, rate, specific_force);
    const bool still = window_still(o);
    if (!still)
        o->resting = false;
    if (still && o->window.seconds >= ORIENTATION_REST) {
        o->resting = true;
        learn(o);
    }
    if (!still || o->window.seconds >= ORIENTATION_REST)
        o->window = (RestWindow){0};
}

/* Integrates with the mean of the rates at both ends of the step. */
static void integrate(Orientation *o, double dt, const double rate[3])
{
    double rotation[3], unbiased[3];
    for (int k = 0; k < 3; k++) {
        unbiased[k] = rate[k] - o->bias[k];
        rotation[k] = 0.5 * (o->rate[k] + unbiased[k]) * dt;
    }
    turn_by(rotation, o->pose);
    memcpy(o->rate, unbiased, sizeof unbiased);
}

/* After a gap the turn is lost; the accelerometer gives the new tilt at once. */
static void bridge(Orientation *o)
{
    o->levelled_s = 0;
    o->window = (RestWindow){0};
    o->resting = false;
}

/* Handles the first report, or a time that does not advance: no integration. */
static void restart(Orientation *o, const double rate[3], const double specific_force[3])
{
    if (!o->begun)
        begin(o, specific_force);
    for (int k = 0; k < 3; k++)
        o->rate[k] = rate[k] - o->bias[k];
}

bool orientation_update(Orientation *o, double time, const double rate[3], const double specific_force[3])
{
    const double absurd = 1e6;
    if (!isfinite(time) || !(length(rate) < absurd) || !(length(specific_force) < absurd)) /* false for NaN */
        return false;
    const double dt = time - o->time, step = fmin(dt, ORIENTATION_GAP);
    o->time = time;
    if (!o->begun || !(dt > 0)) {
        restart(o, rate, specific_force);
        return true;
    }
    if (dt > ORIENTATION_GAP)
        bridge(o);
    integrate(o, step, rate);
    level_pose(o, step, specific_force);
    watch_for_rest(o, step, rate, specific_force);
    return true;
}

void orientation_neutral(Orientation *o)
{
    memcpy(o->neutral, o->pose, sizeof o->neutral);
}

/* Turn as seen by a user looking along the neutral pose: heading^-1 pose neutral^-1 heading */
void orientation_turned(const Orientation *o, double out[4])
{
    double heading[4], back[4], turn[4];
    heading_of(o->neutral, heading);
    inverse(o->neutral, back);
    quat_multiply(o->pose, back, turn);
    quat_multiply(turn, heading, back);
    inverse(heading, turn);
    quat_multiply(turn, back, out);
}

void orientation_down(const Orientation *o, double out[3])
{
    quat_rotate_inverse(o->pose, (const double[]){0, -1, 0}, out);
}
