/* When a device's sensors were read. Reports of a busy machine come late and then many at once; the device's
   own clock, which its reports carry, tells how far apart they were measured. Pure. */
#ifndef SLOSH_SENSOR_CLOCK_H
#define SLOSH_SENSOR_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

/* Begins all zero. */
typedef struct SensorClock {
    bool runs;
    uint32_t ticks; /* of the last report */
    double time;    /* s, when the last report came */
    double own;     /* s, on the device's clock, wherever that begins */
    double ahead;   /* s, time - own of the reports that came quickest */
} SensorClock;

#define SENSOR_CLOCK_LATEST                                                                                  \
    0.25 /* s: a report that seems later than this is of a clock that cannot be trusted */
#define SENSOR_CLOCK_DRIFT 1e-3 /* by so much at most the two clocks run apart */

/* How late a report is that came at `time` (s) and whose clock of `bits` bits, `tick` seconds each, says
   `ticks`: s from its measurement, as against the quickest reports; 0 .. SENSOR_CLOCK_LATEST. 0 where it
   cannot be told: the clock stands, or no report came for half the time in which it starts over. */
double sensor_clock_late(SensorClock *clock, double time, uint32_t ticks, int bits, double tick);

#endif
