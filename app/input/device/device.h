/* Motion devices as data: state (DeviceState), known products (DeviceRow), the clock and the orientation of
   their sensors. */
#ifndef APP_INPUT_DEVICE_DEVICE_H
#define APP_INPUT_DEVICE_DEVICE_H

#include <stdbool.h>
#include <stdint.h>

/* Measurement times of a device's sensors. On a busy machine reports come late and then many at once; the
   device's own clock, sent in its reports, gives the true intervals. Pure functions. */

/* Zero-initialise before use. */
typedef struct SensorClock {
    bool runs;
    uint32_t ticks; /* of the last report */
    double time;    /* s, arrival of the last report */
    double own;     /* s, on the device's clock, with arbitrary zero */
    double ahead;   /* s, time - own of the quickest reports */
} SensorClock;

#define SENSOR_CLOCK_LATEST                                                                                  \
    0.25 /* s: a report with a greater apparent delay shows that the device's clock cannot be trusted */
#define SENSOR_CLOCK_DRIFT 1e-3 /* greatest relative drift between both clocks */

/* Returns a report's delay since its measurement, s, relative to the quickest reports; 0 ..
   SENSOR_CLOCK_LATEST. The report arrived at `time` (s); its clock of `bits` bits, `tick` seconds each,
   reads `ticks`. Returns 0 if unknown: the clock stands still, or no report came for half of the clock's
   period. */
double sensor_clock_late(SensorClock *clock, double time, uint32_t ticks, int bits, double tick);

/* State of a motion device for the rest of the program, from its last valid report. Pure data. Parser:
   report.h; hardware access: devices.h. */

typedef enum DeviceFamily {
    DEVICE_SPACEMOUSE,
    DEVICE_DUALSHOCK4,
    DEVICE_DUALSENSE,
    DEVICE_FAMILY_COUNT
} DeviceFamily;

/* All devices use one frame: +x to the user's right, +y up, +z towards the user, with the device held in
   front of the user in its normal position; turns are right-handed around these axes. */
typedef struct DeviceState {
    uint64_t reports; /* count of valid reports */
    uint64_t refused; /* count of reports of wrong length, id or checksum; ignored */
    double time;      /* s, of the last valid report, on the clock of wall_ms (in a replay: as recorded) */
    double cap[6];    /* SpaceMouse: x y z, turns around x y z; -1 .. 1; 0 for other families */
    double left[2], right[2];   /* sticks, -1 .. 1: right and down positive, like WindowGamepad */
    double triggers[2];         /* left, right; 0 .. 1 */
    uint32_t buttons;           /* bits in the order of the family's report; names in device_rows */
    bool has_motion;            /* the report had the two values below */
    double angular_velocity[3]; /* rad/s around x y z, calibrated */
    double acceleration[3];     /* m/s2, accelerometer reading: +9.81 on y at rest */
    double late;                /* s from the measurement to `time`, by the device's own clock */
    SensorClock clock;          /* state of the device's clock */
} DeviceState;

/* Table of the known motion devices: product, report layout, orientation of axes. */

/* Layout of reports; report.h has the parsers. */
typedef enum ReportLayout {
    LAYOUT_SPACEMOUSE_W,   /* id 1: translation, id 2: rotation */
    LAYOUT_SPACEMOUSE_S,   /* id 1: both */
    LAYOUT_SPACEMOUSE_ANY, /* W or S: no source is known */
    LAYOUT_DUALSHOCK4_USB,
    LAYOUT_DUALSHOCK4_DONGLE, /* the same, with a bit for an absent controller */
    LAYOUT_DUALSHOCK4_BLUETOOTH,
    LAYOUT_DUALSENSE_USB,
    LAYOUT_DUALSENSE_BLUETOOTH,
    LAYOUT_COUNT
} ReportLayout;

/* An axis of DeviceState's frame is `sign` times the axis `from` of the reports. */
typedef struct DeviceAxis {
    uint8_t from; /* 0 .. 5 */
    int8_t sign;
} DeviceAxis;

typedef struct DeviceRow {
    uint16_t vendor, product;
    const char *name;
    DeviceFamily family;
    ReportLayout usb, bluetooth;
    const DeviceAxis *axes;     /* 6: a SpaceMouse's cap; else x y z of the gyro, then of the accelerometer */
    const char *const *buttons; /* DEVICE_BUTTONS_MAX names, NULL for missing buttons */
} DeviceRow;

enum { DEVICE_BUTTONS_MAX = 32 }; /* bits of DeviceState.buttons */

/* Ended by a row without a name. */
extern const DeviceRow device_rows[];

const DeviceRow *device_row(uint16_t vendor, uint16_t product); /* NULL: no known motion device */

/* device_family_word: "spacemouse", "dualshock4", "dualsense", for files. device_family_title: name for
   people. */
const char *device_family_word(DeviceFamily family);
const char *device_family_title(DeviceFamily family);

/* Orientation of a device with gyro and accelerometer: a complementary filter. Pure functions.

   Turns are integrated from the gyro. The vertical comes from the accelerometer, slowly, and not while the
   device is shaken. The heading (turn around the vertical) is known from the gyro alone, so its bias
   matters: the bias is measured whenever the device lies still, and the pose's drift during the rest is
   undone. Frames as in DeviceState. After: Mahony, Hamel and Pflimlin, "Nonlinear complementary filters
   on the special orthogonal group", 2008, with an explicit rest detector in place of their integral. */

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
