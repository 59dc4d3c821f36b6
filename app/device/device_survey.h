/* What is plugged in right now, and whether it may be opened: one look, without threads. */
#ifndef SLOSH_DEVICE_SURVEY_H
#define SLOSH_DEVICE_SURVEY_H

#include "app/device/device_trouble.h"

enum { DEVICE_SURVEY_MAX = 64 };

typedef struct DeviceFound {
    HidInfo info;
    const DeviceRow *row;
    char problem[DEVICE_PROBLEM_SIZE]; /* "": it may be opened */
} DeviceFound;

/* Opens and closes each known device. Returns how many there are, at most DEVICE_SURVEY_MAX; -1 when the
   machine does not tell. */
int device_survey(const HidPort *port, DeviceFound out[DEVICE_SURVEY_MAX]);

#endif
