/* Explains why a device may not be opened, with advice. */
#ifndef SLOSH_DEVICE_TROUBLE_H
#define SLOSH_DEVICE_TROUBLE_H

#include "app/device/device_table.h"
#include "app/device/hid_port.h"

enum { DEVICE_PROBLEM_SIZE = 512, DEVICE_COMMAND_SIZE = 384 };

/* Makes the one command that lets users of this machine open the devices: installs tools/70-slosh.rules,
   or applies an installed rule to plugged in devices. Returns false if the rule did not come with the
   program. */
bool device_rules_command(char command[DEVICE_COMMAND_SIZE]);

/* Returns the row of a found device; NULL if not a motion device. A controller may have several HID
   interfaces: a mouse or keyboard inside is not a motion device. */
const DeviceRow *device_match(const HidInfo *info);

/* Describes why a device was not opened. `reason`: text from the port. */
void device_trouble(const DeviceRow *row, HidRefusal why, const char *reason,
                    char problem[DEVICE_PROBLEM_SIZE]);

/* Adds a note for a device that may be opened: spacenavd also reads the device. Usually "". */
void device_note(const DeviceRow *row, char note[DEVICE_PROBLEM_SIZE]);

/* Returns the id of a process by name in `folder` ("/proc"); 0: none. */
long device_process(const char *folder, const char *name);

#endif
