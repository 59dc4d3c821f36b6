/* Why a device that is there may not be opened, in words, and what would help. */
#ifndef SLOSH_DEVICE_TROUBLE_H
#define SLOSH_DEVICE_TROUBLE_H

#include "app/device/device_table.h"
#include "app/device/hid_port.h"

enum { DEVICE_PROBLEM_SIZE = 512, DEVICE_COMMAND_SIZE = 384 };

/* The one command that lets the users of this machine open the devices: it installs tools/70-slosh.rules, or
   applies it to what is plugged in where it is installed. False: the rule did not come with the program. */
bool device_rules_command(char command[DEVICE_COMMAND_SIZE]);

/* The row of what was found; NULL where it is no motion device. A controller may have several places where
   reports come from: a mouse or a keyboard in it is none. */
const DeviceRow *device_match(const HidInfo *info);

/* The words for a device that was not opened. `reason`: the port's. */
void device_trouble(const DeviceRow *row, HidRefusal why, const char *reason,
                    char problem[DEVICE_PROBLEM_SIZE]);

/* What else a user should know of a device that may be opened: that spacenavd reads it too. "" as a rule. */
void device_note(const DeviceRow *row, char note[DEVICE_PROBLEM_SIZE]);

/* The number of a process with that name in `folder` ("/proc"); 0: there is none. */
long device_process(const char *folder, const char *name);

#endif
