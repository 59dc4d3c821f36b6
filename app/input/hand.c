#include "app/input/input.h"

#include <math.h>
#include <string.h>

static const double radians = M_PI / 180;

Hand hand_at_rest(void)
{
    Hand hand = {.held = {.orientation = {0, 0, 0, 1}}};
    hand.sent = hand.held;
    return hand;
}

/* NaN stays NaN, and is found at the end. */
static double clamp_symmetric(double value, double most)
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
    const double dt = input->dt < 0 ? 0 : clamp_symmetric(input->dt, HAND_DT_MOST), reach = HAND_REACH * side;
    double way[3], drag[2], rotation[3] = {0};
    for (int k = 0; k < 3; k++)
        way[k] = clamp_symmetric(input->move_rate[k], 1) * HAND_SPEED * side * dt;
    move(input, way, held->position);
    for (int k = 0; k < 2; k++)
        drag[k] = clamp_symmetric(input->move_drag[k], 2 * reach); /* from end to end of the reach */
    for (int k = 0; k < 3; k++)
        held->position[k] += input->right[k] * drag[0] + input->up[k] * drag[1];
    stay_within(held->position, reach);

    /* The near face moves to the right by turning around `up`, and up by turning around the left. */
    for (int k = 0; k < 3; k++)
        rotation[k] = input->up[k] * clamp_symmetric(input->turn_drag[0], M_PI) -
                      input->right[k] * clamp_symmetric(input->turn_drag[1], M_PI);
    const double angle = HAND_TURN_SPEED * radians * dt;
    lean(input, clamp_symmetric(input->tilt_rate[0], 1) * angle,
         clamp_symmetric(input->tilt_rate[1], 1) * angle, rotation);
    spin(clamp_symmetric(input->spin_rate, 1) * angle, rotation);
    turn(rotation, held->orientation);
}

/* Rotation vector of the offsets. */
static void sway_turn(const HandInput *input, double rotation[3])
{
    const double angle = HAND_LEAN * radians;
    memset(rotation, 0, 3 * sizeof *rotation);
    lean(input, clamp_symmetric(input->tilt_offset[0], 1) * angle,
         clamp_symmetric(input->tilt_offset[1], 1) * angle, rotation);
    spin(clamp_symmetric(input->spin_offset, 1) * angle, rotation);
}

/* Displacement of the offsets: `sign` 1, or -1 for the reverse. */
static void sway_move(const HandInput *input, double side, double sign, double position[3])
{
    double way[3];
    for (int k = 0; k < 3; k++)
        way[k] = sign * clamp_symmetric(input->move_offset[k], 1) * HAND_SWAY * side;
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
    *target = hand->sent;
    if (!is_finite(&wanted))
        return false;
    hand->held = held;
    if (!differs(&wanted, &hand->sent, side))
        return false;
    *target = hand->sent = wanted;
    return true;
}

void hand_release(Hand *hand, const BoxTarget *now, const HandInput *still, const double box_size[3])
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
        const double u = clamp_symmetric((way - HAND_DEAD_ZONE) / (1 - HAND_DEAD_ZONE), 1);
        scale = u * (0.4 + 0.6 * u * u) / way; /* slope 0.4 in the middle: small deflections stay small */
    }
    for (int k = 0; k < 2; k++)
        out[k] = scale > 0 ? scale * axes[k] : 0;
}

/* Short of the poles, where right and left swap, by a degree: nearer to a pole render/frame/camera.c uses
   another up direction. */
static const double steepest = 89 * M_PI / 180;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double least, double most)
{
    return value < least ? least : value > most ? most : value;
}

/* back: from the seen point to the eye */
static void picture_axes(const Orbit *orbit, double right[3], double up[3], double back[3])
{
    const double cy = cos(orbit->yaw), sy = sin(orbit->yaw), cp = cos(orbit->pitch), sp = sin(orbit->pitch);
    right[0] = cy, right[1] = 0, right[2] = -sy;
    up[0] = -sp * sy, up[1] = cp, up[2] = -sp * cy;
    back[0] = cp * sy, back[1] = sp, back[2] = cp * cy;
}

static void box_centre(const double box_size[3], const BoxState *box, double centre[3])
{
    const double above[3] = {0, box_size[1] / 2, 0};
    box_to_world(box, above, NULL, centre, NULL);
}

Orbit orbit_begin(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                  CoveredParts covered)
{
    Camera camera;
    Orbit orbit = {0};
    double right[3], up[3], back[3], from_pivot[3];
    const double diagonal = sqrt(dot(box_size, box_size));
    camera_make(def, box_size, box, aspect, covered, &camera);
    /* Rows of the view matrix are the picture's axes. The yaw comes from `right`, horizontal even if the
       camera looks straight down. */
    const double right_x = camera.view[0], right_z = camera.view[8], up_y = camera.view[5],
                 back_y = camera.view[6];
    const double tangent = camera.tangent[1];
    orbit.yaw = atan2(-right_z, right_x);
    orbit.pitch = atan2(back_y, up_y);
    orbit.fov_deg = 2 * atan(tangent) * 180 / M_PI;
    picture_axes(&orbit, right, up, back);

    box_centre(box_size, box, orbit.pivot);
    for (int k = 0; k < 3; k++) {
        if (!def->camera_auto)
            orbit.pivot[k] = def->camera.to[k];
        from_pivot[k] = camera.eye[k] - orbit.pivot[k];
    }
    orbit.distance = fmax(dot(from_pivot, back), 1e-3 * diagonal);
    orbit.shift[0] = dot(from_pivot, right) / orbit.distance;
    orbit.shift[1] = dot(from_pivot, up) / orbit.distance;
    /* From inside the box to where the box is a speck; a scene's own camera may be farther out. */
    orbit.nearest = fmin(0.05 * diagonal, orbit.distance);
    orbit.farthest = fmax(50 * diagonal, orbit.distance);
    return orbit;
}

void orbit_turn(Orbit *orbit, double right, double up)
{
    if (!isfinite(right) || !isfinite(up))
        return;
    orbit->yaw = remainder(orbit->yaw - right, 2 * M_PI);
    const double pitch = orbit->pitch + orbit->beyond - up;
    orbit->pitch = clamp(pitch, -steepest, steepest);
    orbit->beyond = pitch - orbit->pitch;
}

void orbit_begin_drag(Orbit *orbit)
{
    orbit->beyond = 0;
}

static double picture_height(const Orbit *orbit, double distance)
{
    return 2 * distance * tan(orbit->fov_deg * M_PI / 360);
}

void orbit_pan(Orbit *orbit, double right, double up)
{
    double x[3], y[3], back[3];
    if (!isfinite(right) || !isfinite(up))
        return;
    picture_axes(orbit, x, y, back);
    const double height = picture_height(orbit, orbit->distance);
    for (int k = 0; k < 3; k++)
        orbit->pivot[k] -= height * (right * x[k] + up * y[k]);
}

void orbit_zoom(Orbit *orbit, double steps)
{
    if (isfinite(steps))
        orbit->distance = clamp(orbit->distance * pow(1.1, -steps), orbit->nearest, orbit->farthest);
}

static void eye_at(const Orbit *orbit, double eye[3])
{
    double right[3], up[3], back[3];
    picture_axes(orbit, right, up, back);
    for (int k = 0; k < 3; k++)
        eye[k] = orbit->pivot[k] +
                 orbit->distance * (back[k] + orbit->shift[0] * right[k] + orbit->shift[1] * up[k]);
}

void orbit_apply(const Orbit *orbit, ViewDef *def)
{
    double right[3], up[3], back[3];
    picture_axes(orbit, right, up, back);
    eye_at(orbit, def->camera.from);
    for (int k = 0; k < 3; k++)
        def->camera.to[k] = def->camera.from[k] - orbit->distance * back[k];
    def->camera.fov_deg = orbit->fov_deg;
    def->camera_auto = false;
    camera_stop(def);
}

void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3])
{
    double back[3];
    picture_axes(orbit, right, up, back);
    away[0] = -sin(orbit->yaw), away[1] = 0, away[2] = -cos(orbit->yaw);
}

double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height)
{
    double right[3], up[3], back[3], eye[3], centre[3], to_eye[3];
    picture_axes(orbit, right, up, back);
    eye_at(orbit, eye);
    box_centre(box_size, box, centre);
    for (int k = 0; k < 3; k++)
        to_eye[k] = eye[k] - centre[k];
    /* A box around or behind the eye still moves a little. */
    const double distance = fmax(dot(to_eye, back), orbit->nearest);
    return picture_height(orbit, distance) / (height > 1 ? height : 1);
}

/* Distances to show and hide, in longest sides: some pixels for a box filling the picture; a line's width. */
static const double COMES = 0.02, GOES = 0.004;

void outline_pose(const Motion motions[], int count, double box_height, double time, const BoxTarget *target,
                  BoxState *pose)
{
    BoxFilter there = box_filter_at_rest();
    memcpy(there.position, target->position, sizeof there.position);
    memcpy(there.orientation, target->orientation, sizeof there.orientation);
    box_state_at(motions, count, box_height, time, pose);
    box_filter_apply(&there, box_height, pose);
}

static void corner_of(const double box_size[3], int corner, double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = box_size[k] * ((corner >> k & 1) - (k == 1 ? 0 : 0.5)); /* the floor is at y = 0 */
}

double outline_distance(const BoxState *a, const BoxState *b, const double box_size[3])
{
    double longest = 0;
    for (int corner = 0; corner < 8; corner++) {
        double at[3], x[3], y[3];
        corner_of(box_size, corner, at);
        box_to_world(a, at, NULL, x, NULL);
        box_to_world(b, at, NULL, y, NULL);
        longest = fmax(longest, hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]));
    }
    return longest / fmax(box_size[0], fmax(box_size[1], box_size[2]));
}

bool outline_is_needed(bool shown, bool lags, double apart)
{
    return shown ? apart > GOES : lags && apart > COMES;
}

/* Four edges along each axis. */
void outline_edge(const double box_size[3], int edge, double a[3], double b[3])
{
    const int axis = edge / 4, next = (axis + 1) % 3, other = (axis + 2) % 3;
    const int corner = (edge & 1) << next | (edge >> 1 & 1) << other;
    corner_of(box_size, corner, a);
    corner_of(box_size, corner | 1 << axis, b);
}
