/* Motion devices: products and their state as data, recordings of reports, and the plugged in devices with
   their threads. */
#ifndef APP_INPUT_DEVICE_DEVICE_H
#define APP_INPUT_DEVICE_DEVICE_H

#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Motion devices as data: state (DeviceState), known products (DeviceRow), the clock and the orientation of
   their sensors. */

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
   report.h; hardware access: below. */

typedef enum DeviceFamily {
    DEVICE_SPACEMOUSE,
    DEVICE_DUALSHOCK4,
    DEVICE_DUALSENSE,
    DEVICE_FAMILY_COUNT
} DeviceFamily;

/* All devices use one frame: +x to the user's right, +y up, +z towards the user, with the device held in
   front of the user in its normal position. Turns are right-handed around these axes. */
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
   matters. The bias is measured whenever the device lies still, and the pose's drift during the rest is
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
    double rate_sum[3], rate_low[3], rate_high[3], acceleration_sum, acceleration_low[3],
        acceleration_high[3];
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
bool orientation_update(Orientation *orientation, double time, const double rate[3],
                        const double specific_force[3]);

/* Makes the present pose the neutral pose, with the present heading away from the user. */
void orientation_neutral(Orientation *orientation);

/* Fills in the turn from the neutral to the present pose, a unit quaternion x y z w, in the user's frame:
   x to the right, y up, z towards the user. */
void orientation_turned(const Orientation *orientation, double out[4]);

/* Fills in the direction of gravity in the device's frame: a unit vector. */
void orientation_down(const Orientation *orientation, double out[3]);

/* Raw reports of motion devices with their times, in a file for replays (`--device file:PATH`), tests and bug
   reports. Text, one event per line, in the order of time:

     slosh device recording 1
     program 0.1
     0.000000 1 plugged dualsense 054c:0ce6 usb DualSense
     0.000000 1 calibration 05ff...            the feature report, id first; left out: nominal
     0.004012 1 report 017f80...               id first, in hexadecimal digits
     9.250000 1 unplugged

   A line begins with the time since the start, s, and the device's number: 1, 2, ... in the order of plugging
   in; a device plugged in again gets a new number. The name at the end of a line is for people. If a killed
   writer left an incomplete last line, the complete lines are read. */

enum {
    REPORT_LOG_DEVICES_MAX = 64,
    REPORT_LOG_REPORT_MAX = 1024,    /* bytes of one report */
    REPORT_LOG_BYTES_MAX = 256 << 20 /* of a file: an hour of a DualSense over Bluetooth */
};

typedef enum ReportLogKind {
    REPORT_LOG_PLUGGED,
    REPORT_LOG_CALIBRATION,
    REPORT_LOG_REPORT,
    REPORT_LOG_UNPLUGGED
} ReportLogKind;

typedef struct ReportLogEntry {
    double time; /* s, never less than in the entry before */
    size_t offset;
    uint16_t size;  /* the report is bytes[offset], ...; 0: none */
    uint8_t kind;   /* ReportLogKind */
    uint8_t device; /* index into devices: number in the file less 1 */
} ReportLogEntry;

typedef struct ReportLogDevice {
    const DeviceRow *row;
    bool bluetooth;
    bool plugged; /* at the end */
} ReportLogDevice;

typedef struct ReportLog {
    ReportLogDevice devices[REPORT_LOG_DEVICES_MAX];
    int device_count;
    ReportLogEntry *entries;
    uint8_t *bytes;
    size_t count, capacity, byte_count, byte_capacity;
} ReportLog;

/* Parses the bytes of a file; pure. Returns false, with nothing to destroy, and "path:line: problem;
   advice". */
bool report_log_parse(const char *path, const char *bytes, size_t size, ReportLog *out, Error *error);
bool report_log_read(const char *path, ReportLog *out, Error *error);
void report_log_destroy(ReportLog *log); /* a zeroed one is allowed */

typedef struct ReportLogWriter ReportLogWriter;

/* Creates a new file; fails if the file exists, as nobody can repeat the recorded motion. Each line is
   written to the system at once, so that a killed program loses nothing. Returns NULL with the reason. */
ReportLogWriter *report_log_create(const char *path, Error *error);

/* Returns the number of the device plugged in; 0 if there are too many: its lines are left out. */
int report_log_plugged(ReportLogWriter *writer, const DeviceRow *row, bool bluetooth);

/* `number`: from report_log_plugged. `time`: of wall_ms, in s. Reports over REPORT_LOG_REPORT_MAX bytes
   are left out. */
void report_log_calibration(ReportLogWriter *writer, int number, const uint8_t *bytes, size_t size);
void report_log_report(ReportLogWriter *writer, int number, double time, const uint8_t *bytes, size_t size);
void report_log_unplugged(ReportLogWriter *writer, int number);

/* Returns true if a line could not be written: the disk is full. */
bool report_log_broken(const ReportLogWriter *writer);

/* Returns false with the reason if a line is missing. NULL is allowed. */
bool report_log_close(ReportLogWriter *writer, Error *error);

/* The plugged in motion devices, or a recording in their place: own threads read reports, notice plugged
   and unplugged devices, and call a listener. A recording is played once, at its recorded speed. At its
   end the remaining devices are unplugged, as if the cable were pulled: the box stays in place. */

typedef enum DeviceEventKind {
    DEVICE_PLUGGED,   /* the state is all zero */
    DEVICE_REPORTED,  /* a valid report has arrived */
    DEVICE_UNPLUGGED, /* or the device no longer answers; also for a refused device */
    DEVICE_REFUSED    /* the device may not be opened: `problem` has the reason and advice; once per plug */
} DeviceEventKind;

/* All pointers are valid only during the call. */
typedef struct DeviceEvent {
    DeviceEventKind kind;
    int number; /* of the device, from 1; a device plugged in again gets a new number */
    DeviceFamily family;
    uint16_t vendor, product;
    const char *name;         /* of device_rows */
    const char *problem;      /* DEVICE_REFUSED; or "" */
    const DeviceState *state; /* after the report */
} DeviceEvent;

/* Called on a thread of the devices, one call at a time. Must not block or call devices_stop. */
typedef void (*DeviceListener)(void *user, const DeviceEvent *event);

struct HidPort; /* below: access to hardware */

typedef struct DevicesSetup {
    const struct HidPort *port; /* NULL: hidapi */
    const char *source;         /* of --device: "file:PATH" replays a recording; NULL: plugged in devices */
    DeviceListener listener;
    void *user;
    ReportLogWriter *record; /* NULL, or gets every raw report, valid or not, until devices_stop */
} DevicesSetup;

typedef struct Devices Devices;

/* Returns true if devices_start could use `source`; call before any other work. Returns false with the
   reason. */
bool devices_check(const char *source, Error *error);

/* Starts the threads. Returns NULL with the reason: source missing or no recording, no memory, no thread.
   Succeeds without any device, and waits for devices. Does not block: the listener is called for each
   device when ready. */
Devices *devices_start(const DevicesSetup *setup, Error *error);

/* Opens the recording named by setup->source, without thread and clock: devices_play_next calls the
   listener. End with devices_stop. Returns NULL with the reason. */
Devices *devices_open(const DevicesSetup *setup, Error *error);

/* Returns the time of a recording's next event, s; INFINITY at the end. The last event, at the time of the
   event before, unplugs the remaining devices. */
double devices_due(const Devices *devices);
void devices_play_next(
    Devices *devices); /* calls the listener for the next event, if any; invalid reports are skipped */
const ReportLog *devices_recording(const Devices *devices);
void devices_rewind(Devices *devices); /* to the start, without calling the listener */

/* Returns true if a recording has been played to its end. Callable from any thread. */
bool devices_ended(const Devices *devices);

/* Stops all threads; the listener is not called afterwards. NULL is allowed. Takes usually 0.1 s, at most
   half a second: a thread blocked by the system in a read is left to end later. */
void devices_stop(Devices *devices);

/* Interface of the device layer to the machine: a table of functions, replaceable in tests. `enumerate`
   and `open` are called by one thread, the rest by one thread per device. */

enum { HID_PATH_SIZE = 256, HID_REASON_SIZE = 256 };

/* A HID interface. */
typedef struct HidInfo {
    char path[HID_PATH_SIZE];
    uint16_t vendor, product;
    bool bluetooth;
    uint16_t usage_page, usage; /* of the HID tables; 0: unknown */
} HidInfo;

/* Why a device was not opened. */
typedef enum HidRefusal {
    HID_DENIED, /* no permission */
    HID_BUSY,   /* used exclusively by another program */
    HID_FAILED  /* see `reason` */
} HidRefusal;

typedef struct HidPort {
    void *self;  /* the first argument of `enumerate` and `open` */
    int look_ms; /* interval of `enumerate`, the delay in noticing a new device */

    /* Lists at most `max` plugged in interfaces; a path may occur more than once. Returns the count, or -1
       on failure. */
    int (*enumerate)(void *self, HidInfo *out, int max);

    /* Returns a handle, or NULL with *why and `reason` set. */
    void *(*open)(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE]);

    /* Waits for a report, id first. Returns its length, 0 after the timeout, less than 0 if the device is
       gone. */
    int (*read)(void *handle, uint8_t *bytes, size_t size, int timeout_ms);

    /* Reads the feature report with the id bytes[0] into `bytes`, id first. Returns its length, or less
       than 0. */
    int (*get_feature)(void *handle, uint8_t *bytes, size_t size);

    void (*close)(void *handle);
} HidPort;

/* hidapi over hidraw, which leaves the kernel's driver in place. Needs read and write access to the device
   files: device_problem. */
extern const HidPort hid_port_hidapi;

/* Explains why a device may not be opened, with advice. */

enum { DEVICE_PROBLEM_SIZE = 512, DEVICE_COMMAND_SIZE = 384 };

/* Makes the one command that lets users of this machine open the devices: installs tools/70-slosh.rules,
   or applies an installed rule to plugged in devices. Returns false if the rule did not come with the
   program. */
bool device_rules_command(char command[DEVICE_COMMAND_SIZE]);

/* Returns the row of a found device; NULL if not a motion device. A controller may have several HID
   interfaces: a mouse or keyboard inside is not a motion device. */
const DeviceRow *device_match(const HidInfo *info);

/* Describes why a device was not opened. `reason`: text from the port. */
void device_problem(const DeviceRow *row, HidRefusal why, const char *reason,
                    char problem[DEVICE_PROBLEM_SIZE]);

/* Adds a note for a device that may be opened: spacenavd also reads the device. Usually "". */
void device_note(const DeviceRow *row, char note[DEVICE_PROBLEM_SIZE]);

/* Returns the id of a process by name in `folder` ("/proc"); 0: none. */
long device_process(const char *folder, const char *name);

/* Lists the plugged in devices, and tests if they may be opened: a single look, without threads. */

enum { DEVICE_LIST_MAX = 64 };

typedef struct DeviceListing {
    HidInfo info;
    const DeviceRow *row;
    char problem[DEVICE_PROBLEM_SIZE]; /* "": may be opened */
} DeviceListing;

/* Opens and closes each known device. Returns the count of devices, at most DEVICE_LIST_MAX; -1 if
   enumeration fails. */
int device_list(const HidPort *port, DeviceListing out[DEVICE_LIST_MAX]);

/* Shows the values of motion devices: bars on a terminal, else one line per change. */

enum { WATCH_DEVICES_MAX = 32 };

/* A present or past device. */
typedef struct WatchedDevice {
    int number;
    const DeviceRow *row;
    DeviceState state; /* the last */
    bool plugged;
    char problem[512]; /* why the device may not be opened; or "" */
} WatchedDevice;

typedef struct DevicesWatch {
    const char *source;      /* of --device, or NULL */
    ReportLogWriter *record; /* or NULL */
    FILE *out;               /* for values; NULL: not shown */
    FILE *messages;          /* for plugged and unplugged devices; NULL: not shown */
    bool bars;               /* out is a terminal */
    /* set at the end */
    int out_error; /* errno of a failed write to out; or 0 */
    int count;
    WatchedDevice devices[WATCH_DEVICES_MAX];
} DevicesWatch;

/* Runs until a signal (app/base/program.h), the end of the recording, a failure of `record`, or a failed
   write to `out`. Returns false with the reason if it could not begin. */
bool devices_watch(DevicesWatch *watch, Error *error);

#endif
