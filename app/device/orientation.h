/* Orientation of a device with gyro and accelerometer: a complementary filter. Pure functions.

   Turns are integrated from the gyro. The vertical comes from the accelerometer, slowly, and not while the
   device is shaken. The heading (turn around the vertical) is known from the gyro alone, so its bias
   matters: the bias is measured whenever the device lies still, and the pose's drift during the rest is
   undone. Frames as in device_state.h. After: Mahony, Hamel and Pflimlin, "Nonlinear complementary filters
   on the special orthogonal group", 2008, with an explicit rest detector in place of their integral. */
#ifndef SLOSH_ORIENTATION_H
#define SLOSH_ORIENTATION_H

#include <stdbool.h>

#define ORIENTATION_LEVELS    2.0  /* s: time constant of the accelerometer's correction */
#define ORIENTATION_GAP       0.1  /* s: longer gaps are not integrated: the motion is unknown */
#define ORIENTATION_REST      0.5  /* s: duration of a rest */
#define ORIENTATION_BIAS_MOST 2.0  /* degrees/s: a faster steady turn is not a bias */
#define ORIENTATION_STEADY    1.5  /* degrees/s, range of readings at rest; a hand trembles more */
#define ORIENTATION_STILL     0.05 /* g, the same for the accelerometer */

/* Statistics over a window of ORIENTATION_REST, to detect a rest. */
typedef struct RestWindow {
    double seconds;
    int reports;
    double rate_sum[3], rate_low[3], rate_high[3], felt_sum, felt_low[3], felt_high[3];
} RestWindow;

typedef struct Orientation {
    double pose[4];    /* unit quaternion x y z w: from the device's frame to a frame with y up */
    double neutral[4]; /* the pose counted as not turned */
    double bias[3];    /* rad/s, measured at rests */
    double gravity;    /* m/s2, as read by the device's accelerometer */
    bool begun;
    bool resting;      /* at rest during the last ORIENTATION_REST */
    double time;       /* s, of the last report */
    double rate[3];    /* rad/s, at the last report, without the bias */
    double levelled_s; /* total time of accelerometer corrections, s */
    int rests;         /* count of rests so far */
    RestWindow window;
} Orientation;

/* Returns the state before the first report: level and neutral. */
Orientation orientation_start(void);

/* Processes a report: time (s), angular velocity (rad/s), accelerometer reading (m/s2). The first report
   sets the tilt at once; the heading then counts as away from the user. Returns false, with nothing
   changed, if a number is not finite. If time does not advance, nothing turns. */
bool orientation_update(Orientation *orientation, double time, const double rate[3], const double felt[3]);

/* Makes the present pose the neutral pose, with the present heading away from the user. */
void orientation_neutral(Orientation *orientation);

/* Fills in the turn from the neutral to the present pose, a unit quaternion x y z w, in the user's frame:
   x to the right, y up, z towards the user. */
void orientation_turned(const Orientation *orientation, double out[4]);

/* Fills in the direction of gravity in the device's frame: a unit vector. */
void orientation_down(const Orientation *orientation, double out[3]);

#endif
