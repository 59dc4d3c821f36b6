/* A recording of motion devices moves the box of a world that is stepped without a window (`render`, `run`,
   `bench`), in simulated time: what was reported t seconds after the recording's start is in the hand at time
   t, by the way of app/held/held_devices.h, mapping and all. Where the box shall be depends on the recording
   and on the time alone, and not on steps, threads or clocks: so two runs give the same bits, and a run that
   is resumed gives those of one without a break. */
#ifndef SLOSH_HAND_REPLAY_H
#define SLOSH_HAND_REPLAY_H

#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/world/world.h"

typedef struct HandReplay HandReplay;

/* `source` is that of --device, `mapping` that of --mapping, or NULL (mapping_load). Right, left and away are
   those of the scene's camera. NULL with the reason: the recording or the mapping is missing or wrong. */
HandReplay *hand_replay_open(const char *source, const char *mapping, const Scene *scene, Error *error);
void hand_replay_close(HandReplay *replay); /* NULL is allowed */

/* 16 digits that tell this recording, its mapping and the camera from others: app/held/hand_mark.h. NULL: "".
 */
const char *hand_replay_mark(const HandReplay *replay);

/* Where a box of that size (m) shall be at `time` (s). Before the first report it is at home, after the
   recording's end it stays where it is. A time before that of the last call begins again from the start. */
BoxTarget hand_replay_at(HandReplay *replay, const double box_size[3], double time);

/* world_set_target of that, before a step of the world. NULL: nothing. */
void hand_replay_move(HandReplay *replay, World *world);

#endif
