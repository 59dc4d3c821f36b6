/* How a device with gyro and accelerometer is turned: a complementary filter. Pure: numbers in, numbers out.

   Turns are the gyro's, integrated; which way is up comes from the accelerometer, slowly, and not at all
   while the device is shaken. Which way the device looks (its turn about the vertical) nothing but the gyro
   tells, so its bias matters: it is learned whenever the device lies still, and what it had turned the pose
   by meanwhile is taken back. Frames as in device_state.h. After: Mahony, Hamel and Pflimlin, "Nonlinear
   complementary filters on the special orthogonal group", 2008, with an explicit rest detector in place of
   their integral. */
#ifndef SLOSH_ORIENTATION_H
#define SLOSH_ORIENTATION_H

#include <stdbool.h>

#define ORIENTATION_LEVELS    2.0 /* s: time constant by which the accelerometer's up prevails */
#define ORIENTATION_GAP       0.1 /* s: longer ones are not integrated over: nobody knows what was in them */
#define ORIENTATION_REST      0.5 /* s: so long it must lie still */
#define ORIENTATION_BIAS_MOST 2.0 /* degrees/s: a steady turn faster than this is no bias */
#define ORIENTATION_STEADY    1.5 /* degrees/s, least to greatest while it lies still; a hand trembles more */
#define ORIENTATION_STILL     0.05 /* g, the same of the accelerometer */

/* What a rest of ORIENTATION_REST is judged by. */
typedef struct RestWindow {
    double seconds;
    int reports;
    double rate_sum[3], rate_low[3], rate_high[3], felt_sum, felt_low[3], felt_high[3];
} RestWindow;

typedef struct Orientation {
    double pose[4];    /* unit quaternion x y z w: from the device's frame to one whose y is up */
    double neutral[4]; /* the pose that counts as not turned */
    double bias[3];    /* rad/s, learned */
    double gravity;    /* m/s2, as this accelerometer has it */
    bool begun;
    bool resting;      /* it lay still in the last ORIENTATION_REST */
    double time;       /* s, of the last report */
    double rate[3];    /* rad/s, of it, without the bias */
    double levelled_s; /* how long the accelerometer has been heard */
    int rests;         /* windows of rest so far */
    RestWindow window;
} Orientation;

/* Before the first report: level, and that is the neutral pose. */
Orientation orientation_start(void);

/* Takes a report in: time (s), angular velocity (rad/s), what the accelerometer feels (m/s2). The first one
   gives the tilt at once, and which way the device looks then counts as away from the user. False: a number
   was not finite, and nothing has changed. A time that does not go on turns nothing. */
bool orientation_update(Orientation *orientation, double time, const double rate[3], const double felt[3]);

/* The present pose becomes the neutral one, and the way it looks now is away from the user. */
void orientation_neutral(Orientation *orientation);

/* The turn from the neutral pose to the present one, unit quaternion x y z w, in the user's frame: x to the
   right, y up, z towards him. */
void orientation_turned(const Orientation *orientation, double out[4]);

/* Which way gravity points in the device's frame: a unit vector. */
void orientation_down(const Orientation *orientation, double out[3]);

#endif
