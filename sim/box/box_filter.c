#include "sim/box/box_filter.h"

#include <math.h>
#include <string.h>

BoxLimits box_limits_default(void)
{
    return (BoxLimits){
        .response = 0.08,             /* a hand feels a delay from about 0.1 s on */
        .speed = 2,                   /* an arm's */
        .acceleration = 20,           /* twice g: fluid sloshes, and hits walls no faster than dt allows */
        .turn_speed_deg = 180,        /* a wrist's */
        .turn_acceleration_deg = 1800 /* full turning speed within 0.1 s */
    };
}

BoxFilter box_filter_at_rest(void)
{
    return (BoxFilter){.orientation = {0, 0, 0, 1}};
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void limit(double v[3], double most)
{
    const double l = length(v);
    for (int k = 0; k < 3 && l > most; k++)
        v[k] *= most / l;
}

/* x'' = (error - 2 response x') / response^2 by an implicit step, stable for every dt. The change of
   velocity and the velocity are cut at the limits. `moved`: distance with the mean of both velocities,
   since the acceleration is constant over the step. */
static void follow(const double error[3], double response, double speed, double acceleration, double dt,
                   double velocity[3], double moved[3])
{
    const double u = dt / response, damping = 1 / ((1 + u) * (1 + u));
    double change[3], after[3];
    for (int k = 0; k < 3; k++)
        change[k] = (velocity[k] + u * error[k] / response) * damping - velocity[k];
    limit(change, acceleration * dt);
    for (int k = 0; k < 3; k++)
        after[k] = velocity[k] + change[k];
    limit(after, speed);
    for (int k = 0; k < 3; k++) {
        moved[k] = 0.5 * (velocity[k] + after[k]) * dt;
        velocity[k] = after[k];
    }
}

/* Rotation vector of a * conj(b), the short way round. */
static void rotation_between(const double a[4], const double b[4], double out[3])
{
    const double inverse[4] = {-b[0], -b[1], -b[2], b[3]};
    double d[4];
    quat_multiply(a, inverse, d);
    const double sine = length(d), sign = d[3] < 0 ? -1 : 1;
    const double scale = sine > 0 ? sign * 2 * atan2(sine, sign * d[3]) / sine : 0;
    for (int k = 0; k < 3; k++)
        out[k] = scale * d[k];
}

void box_filter_step(BoxFilter *filter, const BoxTarget *target, const BoxLimits *limits, double dt)
{
    const double radians = M_PI / 180;
    double error[3], moved[3];
    for (int k = 0; k < 3; k++)
        error[k] = target->position[k] - filter->position[k];
    follow(error, limits->response, limits->speed, limits->acceleration, dt, filter->velocity, moved);
    for (int k = 0; k < 3; k++)
        filter->position[k] += moved[k];

    rotation_between(target->orientation, filter->orientation, error);
    follow(error, limits->response, limits->turn_speed_deg * radians, limits->turn_acceleration_deg * radians,
           dt, filter->angular_velocity, moved);
    quat_turn(moved, filter->orientation);
}

/* The hand moves and turns the centre's frame; the prescribed pose is relative to this frame. */
void box_filter_apply(const BoxFilter *filter, double box_height, BoxState *state)
{
    const double centre[3] = {0, 0.5 * box_height, 0}; /* of the box at home: the hand's centre of rotation */
    double arm[3], arm_velocity[3], turned[3], swirl[3], angular[3];
    for (int k = 0; k < 3; k++)
        arm[k] = state->position[k] - centre[k];
    quat_rotate(filter->orientation, arm, turned);
    quat_rotate(filter->orientation, state->velocity, arm_velocity);
    cross_product(filter->angular_velocity, turned, swirl);
    quat_rotate(filter->orientation, state->angular_velocity, angular);
    for (int k = 0; k < 3; k++) {
        state->position[k] = centre[k] + filter->position[k] + turned[k];
        state->velocity[k] = filter->velocity[k] + swirl[k] + arm_velocity[k];
        state->angular_velocity[k] = filter->angular_velocity[k] + angular[k];
    }
    quat_multiply(filter->orientation, state->orientation, state->orientation);
}
