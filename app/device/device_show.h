/* The state of a motion device as text. */
#ifndef SLOSH_DEVICE_SHOW_H
#define SLOSH_DEVICE_SHOW_H

#include "app/device/device_table.h"

#include <stdio.h>

/* Prints one line, without newline: "turn +0.10 -0.02 +0.00 rad/s, ... , buttons cross l1". */
void device_show_line(FILE *file, const DeviceRow *row, const DeviceState *state);

/* Prints one line per group of values, each value with a bar; the count of lines is constant per family. */
void device_show_bars(FILE *file, const DeviceRow *row, const DeviceState *state);

#endif
