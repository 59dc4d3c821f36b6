/* Measurement times of a device's sensors. On a busy machine reports come late and then many at once; the
   device's own clock, sent in its reports, gives the true intervals. Pure functions. */
#ifndef SLOSH_SENSOR_CLOCK_H
#define SLOSH_SENSOR_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

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

#endif
