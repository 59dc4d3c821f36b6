/* The box as a frame of reference: pose, motion, and transforms of positions and velocities. The box's
   frame has its origin at the centre of the box's floor, y up, axes parallel to the box's edges. Devices
   and prescribed motions turn the box about its centre. World and box frame coincide until the box moves. */
#ifndef SLOSH_BOX_MOTION_H
#define SLOSH_BOX_MOTION_H

#include <stdbool.h>

enum { MOTIONS_MAX = 8 };

/* The pose of the box and its rate, in the world's frame. */
typedef struct BoxState {
    double position[3];         /* of the box's origin, m */
    double orientation[4];      /* unit quaternion x y z w: world = orientation * box */
    double velocity[3];         /* of the box's origin, m/s */
    double angular_velocity[3]; /* rad/s */
} BoxState;

/* X(ENUM, name, help): kinds of prescribed motion. Motions of a list act together, rotations from the first
   (outermost) to the last (innermost). */
#define MOTION_LIST(X)                                                                                       \
    X(SHAKE, "shake", "moves to and fro along `axis`: amplitude (m) * sin(2 pi frequency (Hz) t)")           \
    X(ROCK, "rock", "turns to and fro about `axis`: angle (degrees) * sin(2 pi frequency (Hz) t)")           \
    X(TURN, "turn", "turns about `axis` by `angle` (degrees) within `duration` (s), smoothly, and stays")    \
    X(SPIN, "spin", "turns about `axis` at the constant `rate` (rad/s)")                                     \
    X(ACCELERATE, "accelerate", "moves along `axis` with the constant `acceleration` (m/s2)")

typedef enum MotionKind {
#define X(NAME, name, help) MOTION_##NAME,
    MOTION_LIST(X)
#undef X
        MOTION_KIND_COUNT
} MotionKind;

/* Fields not named in a kind's help are unused. */
typedef struct Motion {
    MotionKind kind;
    double axis[3];      /* direction, non-zero; in the world's frame for translations and for the outermost
                            rotation, for inner rotations in the frame after the outer rotations */
    double amplitude;    /* m */
    double angle_deg;    /* degrees */
    double frequency;    /* Hz */
    double rate;         /* rad/s */
    double acceleration; /* m/s2 */
    double start;        /* s; no motion before */
    double duration;     /* s; 0: unlimited (turn: must be > 0). Afterwards shake and rock rest at their start
                            if the duration is a whole number of half periods */
} Motion;

const char *motion_name(MotionKind kind);
const char *motion_help(MotionKind kind);

/* The box at `time` (s) under `count` motions; exact, with exact rates. `box_height` (m) gives the centre
   of rotation. */
void box_state_at(const Motion list[], int count, double box_height, double time, BoxState *state);

/* a x b; `out` may be a or b. */
void cross_product(const double a[3], const double b[3], double out[3]);

/* a * b; `out` may be a or b. */
void quat_multiply(const double a[4], const double b[4], double out[4]);

/* Turns q further by a rotation vector (radians, along the axis, both in the world), to a unit quaternion. */
void quat_turn(const double rotation[3], double q[4]);

/* Rotates v by the quaternion q, or by its inverse. `out` may be `v`. */
void quat_rotate(const double q[4], const double v[3], double out[3]);
void quat_rotate_inverse(const double q[4], const double v[3], double out[3]);

/* Box frame to world frame, for a point and its velocity in the box's frame (NULL: not wanted). */
void box_to_world(const BoxState *box, const double x[3], const double v[3], double x_world[3],
                  double v_world[3]);

/* True for a motion without rotation. */
bool motion_translates(const Motion *motion);

/* True if the motion keeps the plane z = 0. */
bool motion_in_plane(const Motion *motion);

#endif
