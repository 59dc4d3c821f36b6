#include "sim/box/motion_rows.h"
#include "sim/def.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name, *help;
} motions[] = {
#define X(NAME, name, help) {name, help},
    MOTION_LIST(X)
#undef X
};

const char *motion_name(MotionKind kind)
{
    return motions[kind].name;
}

const char *motion_help(MotionKind kind)
{
    return motions[kind].help;
}

void cross_product(const double a[3], const double b[3], double out[3])
{
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    memcpy(out, c, sizeof c);
}

void quat_multiply(const double a[4], const double b[4], double out[4])
{
    const double c[4] = {
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    };
    memcpy(out, c, sizeof c);
}

void quat_turn(const double rotation[3], double q[4])
{
    const double angle =
        sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] + rotation[2] * rotation[2]);
    const double s = angle > 0 ? sin(0.5 * angle) / angle : 0.5;
    const double turn[4] = {s * rotation[0], s * rotation[1], s * rotation[2], cos(0.5 * angle)};
    quat_multiply(turn, q, q);
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++)
        q[k] /= norm;
}

void quat_rotate(const double q[4], const double v[3], double out[3])
{
    /* v + 2 w (u x v) + 2 u x (u x v) with q = (u, w) */
    double t[3], s[3];
    cross_product(q, v, t);
    cross_product(q, t, s);
    for (int k = 0; k < 3; k++)
        out[k] = v[k] + 2 * (q[3] * t[k] + s[k]);
}

void quat_rotate_inverse(const double q[4], const double v[3], double out[3])
{
    const double inverse[4] = {-q[0], -q[1], -q[2], q[3]};
    quat_rotate(inverse, v, out);
}

void box_to_world(const BoxState *box, const double x[3], const double v[3], double x_world[3],
                  double v_world[3])
{
    double arm[3], swirl[3], relative[3];
    quat_rotate(box->orientation, x, arm);
    for (int k = 0; k < 3; k++)
        x_world[k] = box->position[k] + arm[k];
    if (!v)
        return;
    quat_rotate(box->orientation, v, relative);
    cross_product(box->angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++)
        v_world[k] = box->velocity[k] + swirl[k] + relative[k];
}

/* The coordinate of a motion (m along its axis, or radians about it) and its rate. */
typedef struct Phase {
    double value, rate;
} Phase;

/* 6 u^5 - 15 u^4 + 10 u^3: from 0 to 1 with velocity and acceleration zero at both ends. */
static Phase smooth_step(double u, double duration)
{
    const double value = u * u * u * (u * (6 * u - 15) + 10);
    const double slope = 30 * u * u * (u - 1) * (u - 1);
    return (Phase){value, slope / duration};
}

static Phase oscillation(double amplitude, double frequency, double t)
{
    const double omega = 2 * M_PI * frequency;
    return (Phase){amplitude * sin(omega * t), amplitude * omega * cos(omega * t)};
}

static Phase table_phase(const Motion *motion, double time, double unit)
{
    double rate = 0, value = motion->held;
    if (motion->table.rows > 0)
        value = time_table_smooth(&motion->table, time, &rate);
    return (Phase){unit * value, unit * rate};
}

static Phase motion_phase(const Motion *motion, double time)
{
    double t = time - motion->start;
    if (motion->kind == MOTION_PATH || motion->kind == MOTION_TILT)
        return table_phase(motion, time, motion->kind == MOTION_PATH ? 1 : M_PI / 180);
    if (t < 0)
        return (Phase){0, 0};
    const bool over = motion->duration > 0 && t > motion->duration;
    if (over)
        t = motion->duration;

    const double radians = motion->angle_deg * M_PI / 180;
    Phase phase = {0, 0};
    switch (motion->kind) {
    case MOTION_SHAKE:
        phase = oscillation(motion->amplitude, motion->frequency, t);
        break;
    case MOTION_ROCK:
        phase = oscillation(radians, motion->frequency, t);
        break;
    case MOTION_TURN:
        phase = smooth_step(t / motion->duration, motion->duration);
        phase = (Phase){radians * phase.value, radians * phase.rate};
        break;
    case MOTION_SPIN:
        phase = (Phase){motion->rate * t, motion->rate};
        break;
    case MOTION_ACCELERATE:
        phase = (Phase){0.5 * motion->acceleration * t * t, motion->acceleration * t};
        if (over) /* continues with the reached velocity */
            return (Phase){phase.value + phase.rate * (time - motion->start - t), phase.rate};
        break;
    case MOTION_PATH:
    case MOTION_TILT:
    case MOTION_KIND_COUNT:
        break;
    }
    if (over)
        phase.rate = 0;
    return phase;
}

bool motion_translates(const Motion *motion)
{
    return motion->kind == MOTION_SHAKE || motion->kind == MOTION_ACCELERATE || motion->kind == MOTION_PATH;
}

static void unit(const double v[3], double out[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        out[k] = v[k] / length;
}

/* q <- q * turn(axis, angle); adds the rate about the axis, in the world's frame, to the angular velocity. */
static void turn_further(BoxState *state, const double axis[3], Phase phase)
{
    double axis_world[3];
    quat_rotate(state->orientation, axis, axis_world);
    const double half = 0.5 * phase.value, s = sin(half);
    const double turn[4] = {s * axis[0], s * axis[1], s * axis[2], cos(half)};
    quat_multiply(state->orientation, turn, state->orientation);
    for (int k = 0; k < 3; k++)
        state->angular_velocity[k] += phase.rate * axis_world[k];
}

void box_state_at(const Motion list[], int count, double box_height, double time, BoxState *state)
{
    *state = (BoxState){.orientation = {0, 0, 0, 1}};
    double centre[3] = {0, 0.5 * box_height, 0}, centre_velocity[3] = {0};

    for (int i = 0; i < count; i++) {
        const Phase phase = motion_phase(&list[i], time);
        double axis[3];
        unit(list[i].axis, axis);
        if (!motion_translates(&list[i])) {
            turn_further(state, axis, phase);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            centre[k] += phase.value * axis[k];
            centre_velocity[k] += phase.rate * axis[k];
        }
    }

    /* The origin is half the height below the centre of rotation. */
    const double below[3] = {0, -0.5 * box_height, 0};
    double arm[3], swirl[3];
    quat_rotate(state->orientation, below, arm);
    cross_product(state->angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++) {
        state->position[k] = centre[k] + arm[k];
        state->velocity[k] = centre_velocity[k] + swirl[k];
    }
}

double motion_farthest(const Motion *motion)
{
    double most = fabs(motion->held);
    for (int k = 0; k < (int)motion->table.rows; k++)
        most = fmax(most, 1.6 * fabs(motion->table.value[k]));
    return most;
}

bool motion_in_plane(const Motion *motion)
{
    const double *a = motion->axis;
    return !motion_translates(motion) ? a[0] == 0 && a[1] == 0 : a[2] == 0;
}

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

/* Keys for motions of the box and of solids, and for the box in the hand. */

#define AT(field) offsetof(BoxLimits, field)

#define BOX_ROWS(KIND, NAME, HELP)   MOTION_ROWS("motion[]", KIND, NAME, HELP)
#define SOLID_ROWS(KIND, NAME, HELP) MOTION_ROWS("solids[].motion[]", KIND, NAME, HELP)

/* clang-format off */
const Key motion_keys[] = {
    MOTION_LIST(BOX_ROWS)
    KEYS_END,
};

const Key solid_motion_keys[] = {
    MOTION_LIST(SOLID_ROWS)
    KEYS_END,
};

const Key hand_keys[] = {
    MAPPING("hand", "what the box may do when a hand moves it, by mouse, keys or gamepad"),
    NUMBER("hand.response", L, "s", 0.001, 10, AT(response), "time in which the box follows the hand"),
    NUMBER("hand.speed", L, "m/s", 0.001, 1000, AT(speed), "greatest speed"),
    NUMBER("hand.acceleration", L, "m/s2", 0.001, 1e4, AT(acceleration), "greatest acceleration"),
    NUMBER("hand.turn_speed", L, "degrees/s", 0.1, 1e4, AT(turn_speed_deg), "greatest speed of turning"),
    NUMBER("hand.turn_acceleration", L, "degrees/s2", 0.1, 1e6, AT(turn_acceleration_deg),
           "greatest acceleration of turning"),
    KEYS_END,
};
/* clang-format on */
