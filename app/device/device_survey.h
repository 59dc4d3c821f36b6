/* Lists the plugged in devices, and tests if they may be opened: a single look, without threads. */
#ifndef SLOSH_DEVICE_SURVEY_H
#define SLOSH_DEVICE_SURVEY_H

#include "app/device/device_trouble.h"

enum { DEVICE_SURVEY_MAX = 64 };

typedef struct DeviceFound {
    HidInfo info;
    const DeviceRow *row;
    char problem[DEVICE_PROBLEM_SIZE]; /* "": may be opened */
} DeviceFound;

/* Opens and closes each known device. Returns the count of devices, at most DEVICE_SURVEY_MAX; -1 if
   enumeration fails. */
int device_survey(const HidPort *port, DeviceFound out[DEVICE_SURVEY_MAX]);

#endif
