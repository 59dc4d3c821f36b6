#include "app/hand/hand.h"

#include <math.h>
#include <string.h>

static const double radians = M_PI / 180;

Hand hand_at_rest(void)
{
    Hand hand = {.held = {.orientation = {0, 0, 0, 1}}};
    hand.told = hand.held;
    return hand;
}

/* NaN stays NaN, and is found at the end. */
static double clamp(double value, double most)
{
    return value < -most ? -most : value > most ? most : value;
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double longest_side(const double size[3])
{
    return fmax(size[0], fmax(size[1], size[2]));
}

static bool is_finite(const BoxTarget *target)
{
    bool finite = true;
    for (int k = 0; k < 3; k++)
        finite = finite && isfinite(target->position[k]);
    for (int k = 0; k < 4; k++)
        finite = finite && isfinite(target->orientation[k]);
    return finite;
}

/* position += right a + y b + away c */
static void move(const HandInput *input, const double way[3], double position[3])
{
    for (int k = 0; k < 3; k++)
        position[k] += input->right[k] * way[0] + input->away[k] * way[2];
    position[1] += way[1];
}

/* rotation += the rotation vector leaning the top to the right and away by the given angles. The top moves
   to the right by turning around `away`, and away by turning around the left. */
static void lean(const HandInput *input, double to_right, double off, double rotation[3])
{
    for (int k = 0; k < 3; k++)
        rotation[k] += input->away[k] * to_right - input->right[k] * off;
}

static void stay_within(double position[3], double reach)
{
    const double way = length(position);
    for (int k = 0; k < 3 && way > reach; k++)
        position[k] *= reach / way;
}

static void turn(const double rotation[3], double orientation[4])
{
    if (length(rotation) != 0) /* keeps the bits of an unturned box; NaN passes */
        quat_turn(rotation, orientation);
}

/* rotation += the rotation vector moving the near face to the right by the given angle */
static void spin(double to_right, double rotation[3])
{
    rotation[1] += to_right;
}

/* Adds the permanent part of the input: drags, and rates over time. */
static void hold(const HandInput *input, double side, BoxTarget *held)
{
    const double dt = input->dt < 0 ? 0 : clamp(input->dt, HAND_DT_MOST), reach = HAND_REACH * side;
    double way[3], drag[2], rotation[3] = {0};
    for (int k = 0; k < 3; k++)
        way[k] = clamp(input->move_rate[k], 1) * HAND_SPEED * side * dt;
    move(input, way, held->position);
    for (int k = 0; k < 2; k++)
        drag[k] = clamp(input->move_drag[k], 2 * reach); /* from end to end of the reach */
    for (int k = 0; k < 3; k++)
        held->position[k] += input->right[k] * drag[0] + input->up[k] * drag[1];
    stay_within(held->position, reach);

    /* The near face moves to the right by turning around `up`, and up by turning around the left. */
    for (int k = 0; k < 3; k++)
        rotation[k] = input->up[k] * clamp(input->turn_drag[0], M_PI) -
                      input->right[k] * clamp(input->turn_drag[1], M_PI);
    const double angle = HAND_TURN_SPEED * radians * dt;
    lean(input, clamp(input->tilt_rate[0], 1) * angle, clamp(input->tilt_rate[1], 1) * angle, rotation);
    spin(clamp(input->spin_rate, 1) * angle, rotation);
    turn(rotation, held->orientation);
}

/* Rotation vector of the offsets. */
static void sway_turn(const HandInput *input, double rotation[3])
{
    const double angle = HAND_LEAN * radians;
    memset(rotation, 0, 3 * sizeof *rotation);
    lean(input, clamp(input->tilt_offset[0], 1) * angle, clamp(input->tilt_offset[1], 1) * angle, rotation);
    spin(clamp(input->spin_offset, 1) * angle, rotation);
}

/* Displacement of the offsets: `sign` 1, or -1 for the reverse. */
static void sway_move(const HandInput *input, double side, double sign, double position[3])
{
    double way[3];
    for (int k = 0; k < 3; k++)
        way[k] = sign * clamp(input->move_offset[k], 1) * HAND_SWAY * side;
    move(input, way, position);
}

/* Turn of the device in the world: its axes are right, up and out of the picture. Returns false if there
   is none. */
static bool device_turn(const HandInput *input, double out[4])
{
    const double *q = input->turned;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (norm == 0)
        return false;
    for (int k = 0; k < 3; k++)
        out[k] = (input->right[k] * q[0] - input->away[k] * q[2]) / norm;
    out[1] += q[1] / norm;
    out[3] = q[3] / norm;
    return true;
}

/* Adds the temporary part of the input to the target. The turn of a device is outermost: the box turns
   like the device. */
static void sway(const HandInput *input, double side, BoxTarget *target)
{
    double rotation[3], device[4];
    sway_move(input, side, 1, target->position);
    stay_within(target->position, HAND_REACH * side);
    sway_turn(input, rotation);
    turn(rotation, target->orientation);
    if (device_turn(input, device))
        quat_multiply(device, target->orientation, target->orientation);
}

/* Inverse of sway: computes the held target that sways to `target`. */
static void unsway(const HandInput *input, double side, BoxTarget *target)
{
    double rotation[3], device[4];
    sway_move(input, side, -1, target->position);
    if (device_turn(input, device)) {
        const double back[4] = {-device[0], -device[1], -device[2], device[3]};
        quat_multiply(back, target->orientation, target->orientation);
    }
    sway_turn(input, rotation);
    for (int k = 0; k < 3; k++)
        rotation[k] = -rotation[k];
    turn(rotation, target->orientation);
}

/* True if the step from a to b is visible; smaller steps add up in `held`. */
static bool differs(const BoxTarget *a, const BoxTarget *b, double side)
{
    const double least = 1e-6;
    bool differ = false;
    for (int k = 0; k < 3; k++)
        differ = differ || fabs(a->position[k] - b->position[k]) > least * side;
    for (int k = 0; k < 4; k++)
        differ = differ || fabs(a->orientation[k] - b->orientation[k]) > least;
    return differ;
}

bool hand_update(Hand *hand, const HandInput *input, const double box_size[3], BoxTarget *target)
{
    const double side = longest_side(box_size);
    BoxTarget held = hand->held, wanted;
    hold(input, side, &held);
    wanted = held;
    sway(input, side, &wanted);
    *target = hand->told;
    if (!is_finite(&wanted))
        return false;
    hand->held = held;
    if (!differs(&wanted, &hand->told, side))
        return false;
    *target = hand->told = wanted;
    return true;
}

void hand_let_go(Hand *hand, const BoxTarget *now, const HandInput *still, const double box_size[3])
{
    BoxTarget held = *now;
    if (still)
        unsway(still, longest_side(box_size), &held);
    if (is_finite(&held))
        hand->held = held;
}

void hand_home(Hand *hand)
{
    hand->held = hand_at_rest().held;
}

void hand_stick(const double axes[2], double out[2])
{
    const double way = hypot(axes[0], axes[1]);
    double scale = 0;
    if (way > HAND_DEAD_ZONE && way < INFINITY) {
        const double u = clamp((way - HAND_DEAD_ZONE) / (1 - HAND_DEAD_ZONE), 1);
        scale = u * (0.4 + 0.6 * u * u) / way; /* slope 0.4 in the middle: small deflections stay small */
    }
    for (int k = 0; k < 2; k++)
        out[k] = scale > 0 ? scale * axes[k] : 0;
}
