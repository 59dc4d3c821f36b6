/* Internals of the mapping file, shared by reader and writer. */
#ifndef SLOSH_MAPPING_KEYS_H
#define SLOSH_MAPPING_KEYS_H

#include "app/device/mapping.h"
#include "app/scene/keys.h"

/* The keys of a device, of an axis, and of a pose; each ended by a row without a path. */
extern const Key mapping_device_keys[], mapping_axis_keys[], mapping_pose_keys[];

const char *mapping_command_name(int command); /* command of a press; "" for remaining commands, NULL after
                                                  the last */
const char *mapping_to_words(int to);          /* "moves the box to the right" */

#endif
